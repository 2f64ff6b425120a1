#include "app/picture/films/film_loop.h"

#include <algorithm>

#include "app/picture/attempt/attempt_scene.h"
#include "app/picture/films/film.h"

namespace trocar {

FilmLoop::FilmLoop(const AttemptSetup& what, const AssetRoots& assets) : setup_(expert_setup(what)), assets_(assets) {}
FilmLoop::~FilmLoop() = default;

void FilmLoop::advance(double dt_s) {
  waited_s_ += dt_s;
  if (waited_s_ < kPatience_s) return;
  if (!run_) {
    if (const std::filesystem::path file = expert_.ask(setup_, assets_); !file.empty())
      run_ = RecordedRun::in_background(file, assets_);
    return;
  }
  if (!run_->has_pictures() || run_->available_until() < run_->begin_s()) return;
  if (!ready_) {
    ready_ = true;
    return;
  }
  clock_s_ += dt_s;
  if (clock_s_ > film_length(*run_) + kRest_s) clock_s_ = 0;
  // What has not been run again yet cannot be shown: it waits there.
  const double known_s = run_->available_until() - run_->begin_s();
  if (run_->stage() == RecordedRun::Stage::kReplaying) clock_s_ = std::min(clock_s_, known_s);
}

bool FilmLoop::ready() const { return ready_; }
const Scene& FilmLoop::scene() const { return run_->scene(); }

SceneView FilmLoop::view() const {
  const RunMoment moment = run_->at(loop_time(*run_, clock_s_));
  return attempt_scene(view_of(run_->scene(), moment));
}

std::string FilmLoop::refusal() const { return run_ ? run_->failure() : expert_.refusal(); }

}  // namespace trocar
