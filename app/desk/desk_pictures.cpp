#include "app/desk/desk_pictures.h"

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

#include "app/picture/attempt/attempt_picture.h"
#include "app/picture/maps/heat_painter.h"
#include "app/session/keeping/recording_check.h"
#include "app/session/playback/recorded_run.h"
#include "app/session/recording/recording_reader.h"
#include "haptics/input_error.h"
#include "trainees/records/attempt_store.h"

namespace trocar {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience{8},
    kHurry{2};                       ///< that a page waits for its picture, alone and with others behind it
constexpr int kPerSecond = 10;       ///< pictures are told apart at tenths of a second
constexpr int kShape = 9, kOf = 16;  ///< height of width

struct Wanted {
  std::string uuid;
  long tenth = 0;
  int width = 0;
  enum class What : std::uint8_t { kMoment, kHeat } what = What::kMoment;
  HeatOf of = HeatOf::kTime;
  bool overview = false;
  bool operator==(const Wanted&) const = default;
};

/// A run that is replayed, and what paints it.
struct Loaded {
  std::string uuid, trainee;
  std::filesystem::path file;
  RecordedRun run;
  std::unique_ptr<AttemptPainter> painter = {};  // goes before its run
  int painter_width = 0;
};

std::string bytes_of(const Image& image) {
  const std::vector<std::uint8_t> png = encode_png(image);
  return {png.begin(), png.end()};
}

}  // namespace

struct DeskPictures::State {
  State(AssetRoots roots, std::function<Database()> opener)
      : assets(std::move(roots)), open(std::move(opener)), thread([this] { work(); }) {}

  void work();
  std::string made(const Wanted& wanted);
  Loaded& load(const std::string& wanted_uuid);
  void wait_until(const Loaded& loaded, double t_s);
  AttemptPainter& painter_of(Loaded& loaded, int width) const;
  std::string moment(Loaded& loaded, const Wanted& wanted);
  std::string map(Loaded& loaded, const Wanted& wanted);
  std::optional<std::string> kept(const Wanted& wanted);
  std::string ask(const Wanted& wanted);
  bool others_wait() {
    const std::scoped_lock lock(mutex);
    return !jobs.empty() || ends;
  }

  AssetRoots assets;
  std::function<Database()> open;
  std::mutex mutex;
  std::condition_variable come;
  bool ends = false;
  std::deque<std::packaged_task<std::string()>> jobs;
  std::size_t asked = 0;                               ///< jobs that wait or run
  std::list<std::pair<Wanted, std::string>> pictures;  ///< newest first
  std::list<Loaded> loaded;                            ///< of the thread alone; newest first
  std::thread thread;                                  // last: it uses all of these
};

void DeskPictures::State::work() {
  while (true) {
    std::unique_lock lock(mutex);
    come.wait(lock, [&] { return ends || !jobs.empty(); });
    if (ends) break;
    std::packaged_task<std::string()> now = std::move(jobs.front());
    jobs.pop_front();
    lock.unlock();
    now();
  }
  loaded.clear();  // in the thread that made the painters
}

Loaded& DeskPictures::State::load(const std::string& wanted_uuid) {
  const auto there =
      std::find_if(loaded.begin(), loaded.end(), [&](const Loaded& one) { return one.uuid == wanted_uuid; });
  if (there != loaded.end() && there->run.stage() != RecordedRun::Stage::kFailed) {
    loaded.splice(loaded.begin(), loaded, there);
    return loaded.front();
  }
  if (there != loaded.end()) loaded.erase(there);
  Database database = open();
  const AttemptStore store(database);
  const AttemptSummary found = store.find(wanted_uuid);
  if (found.uuid != wanted_uuid) throw InputError("attempt " + wanted_uuid + ": there is none");
  const AttemptResult stored = store.load(found.row);
  const std::string& file = stored.recording_path;
  if (file.empty()) throw InputError("attempt " + wanted_uuid + ": was not recorded, so there are no pictures of it");
  if (const std::string foreign = foreign_recording(database, stored); !foreign.empty())
    throw InputError("attempt " + wanted_uuid + ": " + foreign);
  if (loaded.size() >= kRuns) loaded.pop_back();
  loaded.push_front({wanted_uuid, found.trainee, file, RecordedRun::in_background(file, assets)});
  return loaded.front();
}

void DeskPictures::State::wait_until(const Loaded& one, double t_s) {
  const auto begin = Clock::now();
  while (true) {
    const RecordedRun::Stage stage = one.run.stage();
    if (stage == RecordedRun::Stage::kFailed) throw InputError("attempt " + one.uuid + ": " + one.run.failure());
    if (stage == RecordedRun::Stage::kWhole || stage == RecordedRun::Stage::kStopped) return;
    const bool replaying = stage == RecordedRun::Stage::kReplaying;
    if (replaying && one.run.has_pictures() && one.run.available_until() >= t_s) return;
    if (Clock::now() > begin + (others_wait() ? kHurry : kPatience)) {
      const int done = replaying ? static_cast<int>(std::max(0.0, one.run.available_until())) : 0;
      throw EnvironmentError("the attempt is being replayed (" + std::to_string(done) +
                             " s of it are there): ask for the picture again in a moment");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

AttemptPainter& DeskPictures::State::painter_of(Loaded& one, int width) const {
  if (!one.painter || one.painter_width != width) {
    one.painter.reset();
    one.painter = std::make_unique<AttemptPainter>(assets, one.trainee, width, width * kShape / kOf);
    one.painter_width = width;
  }
  return *one.painter;
}

std::string DeskPictures::State::moment(Loaded& one, const Wanted& wanted) {
  const double t_s = static_cast<double>(wanted.tenth) / kPerSecond;
  wait_until(one, t_s);
  return bytes_of(
      painter_of(one, wanted.width).paint(view_of(one.run.scene(), one.run.at(std::min(t_s, one.run.end_s())))));
}

/// On the scene as it was at the beginning.
std::string DeskPictures::State::map(Loaded& one, const Wanted& wanted) {
  wait_until(one, 0);
  const Recording recording = read_recording(one.file, Reading::kTolerant);
  const HeatFields fields(rebuild_trace(recording.ticks, recording.rate_hz), wanted.of);
  AttemptPainter& painter = painter_of(one, wanted.width);
  const RunMoment begin = one.run.at(0);
  SceneView view = bare_scene(painter.scene(view_of(one.run.scene(), begin)));
  const Camera scope = view.camera, overview = overview_camera(view);
  const double top = heat_top(fields, view, {scope, overview});
  view.camera = wanted.overview ? overview : scope;
  Image picture = painter.paint(view);
  paint_heat(picture, view, fields, top);
  return bytes_of(picture);
}

std::string DeskPictures::State::made(const Wanted& wanted) {
  Loaded& one = load(wanted.uuid);
  std::string bytes = wanted.what == Wanted::What::kMoment ? moment(one, wanted) : map(one, wanted);
  const std::scoped_lock lock(mutex);
  pictures.emplace_front(wanted, bytes);
  if (pictures.size() > kKept) pictures.pop_back();
  return bytes;
}

std::optional<std::string> DeskPictures::State::kept(const Wanted& wanted) {
  const std::scoped_lock lock(mutex);
  const auto at =
      std::find_if(pictures.begin(), pictures.end(), [&](const auto& entry) { return entry.first == wanted; });
  if (at == pictures.end()) return {};
  pictures.splice(pictures.begin(), pictures, at);
  return pictures.front().second;
}

std::string DeskPictures::State::ask(const Wanted& wanted) {
  if (auto picture = kept(wanted)) return std::move(*picture);
  std::packaged_task<std::string()> job([this, wanted] { return made(wanted); });
  std::future<std::string> result = job.get_future();
  {
    const std::scoped_lock lock(mutex);
    if (asked >= kMostWaiting)
      throw EnvironmentError("other pictures are being made: ask for this one again in a moment");
    ++asked;
    jobs.push_back(std::move(job));
  }
  come.notify_all();
  const auto leave = [this](void*) {
    const std::scoped_lock lock(mutex);
    --asked;
  };
  const std::unique_ptr<State, decltype(leave)> left(this, leave);
  return result.get();
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
  Wanted wanted{attempt_uuid};
  wanted.tenth = std::lround(inside_s * kPerSecond);
  wanted.width = std::clamp(width, kNarrowest, kWidest);
  return state_->ask(wanted);
}

std::string DeskPictures::heat(const std::string& attempt_uuid, HeatOf of, bool overview, int width) {
  Wanted wanted{attempt_uuid};
  wanted.width = std::clamp(width, kNarrowest, kWidest);
  wanted.what = Wanted::What::kHeat;
  wanted.of = of;
  wanted.overview = overview;
  return state_->ask(wanted);
}

}  // namespace trocar
