#include "app/window/lessons/lesson_picture.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "app/picture/attempt/attempt_scene.h"
#include "app/session/playback/recorded_run.h"
#include "app/session/run_moment.h"
#include "haptics/kinematics/device_geometry.h"
#include "scenarios/layout/board_numbers.h"

namespace trocar {
namespace {

constexpr double kRest_s = 1.0;  // the choice must stand so long before the expert is asked

double lesson_wave(double t_s, double period_s) { return std::sin(2 * std::numbers::pi * t_s / period_s); }

template <class T>
bool lesson_ready(const std::future<T>& future, double wait_s = 0) {
  return future.valid() && future.wait_for(std::chrono::duration<double>(wait_s)) == std::future_status::ready;
}

/// Null: the organ is missing or does not fit; the card does without a picture.
std::shared_ptr<const Scene> load(const AttemptSetup& setup, const AssetRoots& assets) {
  try {
    return std::make_shared<const Scene>(build_scene(setup, assets, {"simulated", setup.rate_hz, 16}));
  } catch (const std::exception&) {
    return nullptr;
  }
}

std::shared_ptr<const RecordedRun> load_film(const std::filesystem::path& file, const AssetRoots& assets,
                                             const std::atomic<bool>& stop) {
  try {
    return std::make_shared<const RecordedRun>(file, assets, "", [&stop](double) { return !stop.load(); });
  } catch (const std::exception&) {
    return nullptr;
  }
}

}  // namespace

struct LessonPicture::State {
  std::atomic<bool> stop{false};  ///< before the futures, which end first
  std::string key;                ///< of what is shown or being made
  double rested_s = 0, t_s = 0;
  std::future<std::shared_ptr<const Scene>> making;
  std::string making_key;
  std::shared_ptr<const Scene> scene;
  std::future<std::shared_ptr<const RecordedRun>> filming;
  std::string filming_key;
  std::shared_ptr<const RecordedRun> film;

  void take_up(PracticeModel& model);
  void ask_film(PracticeModel& model);
  void advance_scene(PracticeModel& model, double wait_s);
};

void LessonPicture::State::take_up(PracticeModel& model) {
  const std::string now = model.exercise_id + "/" + model.level + "/" + model.organ;
  if (now == key) return;
  key = now;
  rested_s = t_s = 0;
  scene = nullptr;
  film = nullptr;
  if (!filming.valid()) filming_key.clear();  // a choice that comes back gets its film again
}

void LessonPicture::State::advance_scene(PracticeModel& model, double wait_s) {
  if (scene) return;
  if (lesson_ready(making, making_key == key ? wait_s : 0)) {
    auto made = making.get();
    if (making_key == key && made) {
      scene = made;
      return;
    }
    if (making_key == key) return;
  }
  if (making.valid() || making_key == key) return;  // one at a time; one that failed is not tried again
  AttemptSetup setup;
  setup.exercise = model.exercise();
  setup.level = model.level;
  setup.organ = model.organ;
  setup.tissue = model.tissue();
  setup.board = drawn_board(setup.seed, false);
  making_key = key;
  making = std::async(std::launch::async, load, setup, model.assets());
}

void LessonPicture::State::ask_film(PracticeModel& model) {
  if (film || !scene || rested_s < kRest_s) return;
  if (lesson_ready(filming)) {
    auto made = filming.get();
    if (filming_key == key) film = made;
    t_s = 0;
    return;
  }
  if (filming.valid() || filming_key == key) return;
  const std::filesystem::path file = model.expert_recording();
  if (file.empty()) return;
  filming_key = key;
  filming = std::async(std::launch::async, load_film, file, model.assets(), std::cref(stop));
}

LessonPicture::LessonPicture() : state_(std::make_unique<State>()) {}
LessonPicture::~LessonPicture() { state_->stop = true; }

std::optional<SceneView> LessonPicture::view(PracticeModel& model, double dt_s) {
  State& s = *state_;
  s.take_up(model);
  s.rested_s += dt_s;
  s.t_s += dt_s;
  s.advance_scene(model, 0);
  s.ask_film(model);
  if (!s.scene) return std::nullopt;
  if (s.film) {
    const double length = std::max(1.0, s.film->end_s() - s.film->begin_s());
    SceneView view = attempt_scene(view_of(s.film->scene(), s.film->at(s.film->begin_s() + std::fmod(s.t_s, length))));
    view.hud = {};
    return view;
  }
  return lesson_view(*s.scene, s.t_s);
}

std::string LessonPicture::caption(const Translator& w) const {
  if (!state_->scene) return "";
  return state_->film ? w("Replay of the scripted expert") : w("Still scene");
}

void LessonPicture::settle(PracticeModel& model, double wait_s) {
  state_->take_up(model);
  state_->advance_scene(model, 0);
  state_->advance_scene(model, wait_s);
}

SceneView lesson_view(const Scene& scene, double t_s) {
  RunMoment moment;
  moment.t_s = t_s;
  StylusState& stylus = moment.record.stylus;
  stylus.X_TI.R = scene.loop.map.instrument_pose(home_pose()).R;
  const double x = scene.setup.exercise.layout.region_x_m, y = scene.setup.exercise.layout.region_y_m;
  stylus.X_TI.p = scene.board.centre_T + Vec3(0.22 * x * lesson_wave(t_s, 11), 0.2 * y * lesson_wave(t_s + 2, 8),
                                              0.03 + 0.006 * lesson_wave(t_s, 5));
  stylus.jaw_opening_m = scene.loop.tool.jaw_length_m > 0 ? 0.012 + 0.006 * lesson_wave(t_s, 4) : 0.0;
  moment.status.phase = Phase::kRun;
  moment.status.target_index =
      scene.board.targets.empty() ? -1 : static_cast<int>(t_s / 3) % static_cast<int>(scene.board.targets.size());
  SceneView view = attempt_scene(view_of(scene, moment));
  view.hud = {};
  view.hud.elapsed_s = t_s;
  return view;
}

}  // namespace trocar
