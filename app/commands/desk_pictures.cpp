#include "app/commands/desk_pictures.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <future>
#include <list>
#include <mutex>
#include <optional>
#include <thread>

#include "app/playback/film.h"
#include "app/playback/recorded_run.h"
#include "haptics/input_error.h"
#include "trainees/attempt_store.h"

namespace trocar {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{8};   ///< that a page waits for its picture
constexpr int kPerSecond = 10;                 ///< pictures are told apart at tenths of a second

struct Wanted {
  std::string uuid;
  long tenth = 0;
  int width = 0;
  bool operator==(const Wanted&) const = default;
};

}  // namespace

struct DeskPictures::State {
  State(AssetRoots roots, std::function<Database()> opener)
      : assets(std::move(roots)), open(std::move(opener)), thread([this] { work(); }) {}

  void work();
  std::string painted(const Wanted& wanted);
  void load(const std::string& wanted_uuid);
  void wait_until(double t_s) const;
  std::optional<std::string> kept(const Wanted& wanted);

  AssetRoots assets;
  std::function<Database()> open;
  std::mutex mutex;
  std::condition_variable come;
  bool ends = false;
  std::optional<std::packaged_task<std::string()>> job;
  std::atomic<bool> busy{false};
  std::list<std::pair<Wanted, std::string>> pictures;   ///< newest first
  // Of the thread alone:
  std::string uuid, trainee;
  std::unique_ptr<AttemptPainter> painter;   // goes before its run
  int painter_width = 0;
  std::optional<RecordedRun> run;
  std::thread thread;                        // last: it uses all of these
};

void DeskPictures::State::work() {
  while (true) {
    std::unique_lock lock(mutex);
    come.wait(lock, [&] { return ends || job; });
    if (ends) break;
    std::packaged_task<std::string()> now = std::move(*job);
    job.reset();
    lock.unlock();
    now();
  }
  painter.reset();  // in the thread that made it
  run.reset();
}

void DeskPictures::State::load(const std::string& wanted_uuid) {
  if (uuid == wanted_uuid && run && run->stage() != RecordedRun::Stage::kFailed) return;
  painter.reset();
  run.reset();
  uuid.clear();
  Database database = open();
  const AttemptStore store(database);
  const AttemptSummary found = store.find(wanted_uuid);
  if (found.uuid != wanted_uuid) throw InputError("attempt " + wanted_uuid + ": there is none");
  const std::string file = store.load(found.row).recording_path;
  if (file.empty()) throw InputError("attempt " + wanted_uuid + ": was not recorded, so there are no pictures of it");
  run.emplace(RecordedRun::in_background(file, assets));
  uuid = wanted_uuid;
  trainee = found.trainee;
}

void DeskPictures::State::wait_until(double t_s) const {
  const auto until = Clock::now() + kPatience;
  while (true) {
    const RecordedRun::Stage stage = run->stage();
    if (stage == RecordedRun::Stage::kFailed) throw InputError("attempt " + uuid + ": " + run->failure());
    if (stage == RecordedRun::Stage::kWhole || stage == RecordedRun::Stage::kStopped) return;
    const bool replaying = stage == RecordedRun::Stage::kReplaying;
    if (replaying && run->has_pictures() && run->available_until() >= loop_time(*run, t_s)) return;
    if (Clock::now() > until) {
      const int done = replaying ? static_cast<int>(std::max(0.0, run->available_until() - run->begin_s())) : 0;
      throw EnvironmentError("the attempt is being replayed (" + std::to_string(done) +
                             " s of it are there): ask for the picture again in a moment");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

std::string DeskPictures::State::painted(const Wanted& wanted) {
  load(wanted.uuid);
  const double t_s = static_cast<double>(wanted.tenth) / kPerSecond;
  wait_until(t_s);
  if (!painter || painter_width != wanted.width) {
    painter.reset();
    painter = std::make_unique<AttemptPainter>(run->scene(), assets, trainee, wanted.width, wanted.width * 9 / 16);
    painter_width = wanted.width;
  }
  const double clock = std::clamp(loop_time(*run, t_s), run->begin_s(), std::max(run->begin_s(), run->end_s()));
  const std::vector<std::uint8_t> png = encode_png(painter->paint(view_of(run->scene(), run->at(clock))));
  std::string bytes(png.begin(), png.end());
  const std::scoped_lock lock(mutex);
  pictures.emplace_front(wanted, bytes);
  if (pictures.size() > kKept) pictures.pop_back();
  return bytes;
}

std::optional<std::string> DeskPictures::State::kept(const Wanted& wanted) {
  const std::scoped_lock lock(mutex);
  const auto at = std::find_if(pictures.begin(), pictures.end(), [&](const auto& entry) { return entry.first == wanted; });
  if (at == pictures.end()) return {};
  pictures.splice(pictures.begin(), pictures, at);
  return pictures.front().second;
}

DeskPictures::DeskPictures(AssetRoots assets, std::function<Database()> open)
    : state_(std::make_unique<State>(std::move(assets), std::move(open))) {}

DeskPictures::~DeskPictures() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->ends = true;
  }
  state_->come.notify_all();
  state_->thread.join();
}

std::string DeskPictures::png(const std::string& attempt_uuid, double t_s, int width) {
  constexpr double kLongest_s = 86400;
  const double inside_s = std::isfinite(t_s) ? std::clamp(t_s, 0.0, kLongest_s) : 0;
  const Wanted wanted{attempt_uuid, std::lround(inside_s * kPerSecond), std::clamp(width, kNarrowest, kWidest)};
  if (auto picture = state_->kept(wanted)) return std::move(*picture);
  if (state_->busy.exchange(true)) throw EnvironmentError("another picture is being made: ask for this one again in a moment");
  std::packaged_task<std::string()> job([this, wanted] { return state_->painted(wanted); });
  std::future<std::string> made = job.get_future();
  {
    const std::scoped_lock lock(state_->mutex);
    state_->job = std::move(job);
  }
  state_->come.notify_all();
  try {
    std::string out = made.get();
    state_->busy = false;
    return out;
  } catch (...) {
    state_->busy = false;
    throw;
  }
}

}  // namespace trocar
