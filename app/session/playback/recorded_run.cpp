#include "app/session/playback/recorded_run.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "app/session/playback/moment_store.h"
#include "app/session/playback/recorded_moments.h"
#include "app/session/recording/recording_reader.h"
#include "app/session/setup/recorded_scene.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

/// Thrown through the replay by its observer: somebody wants no more of it.
struct Stopped {};

/// Rows of the loop as two numbers each.
struct LoopForces {
  std::vector<double> t_s;
  std::vector<float> force_n, grip_n;
};

double norm_n(const std::array<std::int32_t, 3>& quanta) {
  if (std::find(quanta.begin(), quanta.end(), kNotRepresentable) != quanta.end()) return 0;
  return kForceQuantum * std::hypot(double(quanta[0]), double(quanta[1]), double(quanta[2]));
}

LoopForces loop_forces(const Recording& recording) {
  LoopForces trace;
  for (const RecordedTick& row : recording.ticks) {
    trace.t_s.push_back(static_cast<double>(row.tick) / recording.rate_hz);
    trace.force_n.push_back(static_cast<float>(norm_n(row.force)));
    trace.grip_n.push_back(static_cast<float>(row.grip == kNotRepresentable ? 0 : kForceQuantum * row.grip));
  }
  return trace;
}

std::vector<RecordedRun::Column> columns_of(const LoopForces& trace, const std::vector<float>& value, int columns,
                                            double from_s, double to_s) {
  std::vector<RecordedRun::Column> out(static_cast<std::size_t>(std::max(0, columns)));
  const auto row_at = [&trace](double t) {
    return static_cast<std::size_t>(std::lower_bound(trace.t_s.begin(), trace.t_s.end(), t - 1e-9) - trace.t_s.begin());
  };
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double width = (to_s - from_s) / columns;
    const std::size_t first = row_at(from_s + width * static_cast<double>(i)),
                      last = row_at(from_s + width * static_cast<double>(i + 1));
    if (first >= value.size()) break;
    // A column narrower than a tick shows the tick that it lies in.
    const auto [low, high] =
        std::minmax_element(value.begin() + static_cast<std::ptrdiff_t>(first),
                            value.begin() + static_cast<std::ptrdiff_t>(std::max(last, first + 1)));
    out[i] = {*low, *high};
  }
  return out;
}

}  // namespace

struct RecordedRun::State {
  std::filesystem::path file;
  AssetRoots assets;
  std::string organ;

  std::atomic<Stage> stage = Stage::kLoading;
  std::atomic<bool> stop = false;
  std::thread thread;
  mutable std::mutex mutex;  // failure, torn
  std::string failure, torn;

  std::optional<Scene> scene;  // from here on: written before kReplaying, read after it
  LoopForces trace;
  std::vector<Event> events;
  Grade grade;
  double begin_s = 0, end_s = 0;
  std::optional<RecordedMoments> recorded;  ///< with keyframes; else:
  MomentStore moments;
  SessionOutcome outcome;  // written before kWhole

  void make(const std::function<bool(double)>& progress);
  void load(const Recording& recording);
  void fail(const std::string& why);
};

void RecordedRun::State::load(const Recording& recording) {
  {
    const std::lock_guard lock(mutex);
    torn = recording.torn;
  }
  scene.emplace(recorded_scene(recording, file, assets, organ));
  trace = loop_forces(recording);
  GradedRecording graded = grade_recording(recording, file.string());
  events = std::move(graded.events);
  grade = std::move(graded.grade);
  const auto run = std::find_if(recording.ticks.begin(), recording.ticks.end(), [](const RecordedTick& row) {
    return row.phase == static_cast<std::uint8_t>(Phase::kRun);
  });
  if (run != recording.ticks.end()) begin_s = static_cast<double>(run->tick) / recording.rate_hz;
  if (!trace.t_s.empty()) end_s = trace.t_s.back();
  if (!recording.tissue.empty() && !recording.ticks.empty()) recorded.emplace(*scene, recording);
}

void RecordedRun::State::make(const std::function<bool(double)>& progress) {
  const Recording recording = read_recording(file);
  load(recording);
  if (recorded) {
    stage = Stage::kWhole;
    if (progress) progress(1);
    return;
  }
  stage = Stage::kReplaying;
  int percent = -1;
  const auto keep = [&](const SessionView& view) {
    moments.add({view.record, view.director.status(), view.tissue ? *view.tissue : TissueFrame{}, view.t_s, true, 0,
                 view.organ_T, view.thin_T});
    const double share = end_s > 0 ? std::min(1.0, view.t_s / end_s) : 1;
    const bool told = static_cast<int>(100 * share) == percent;
    percent = static_cast<int>(100 * share);
    if (stop || (progress && !told && !progress(share))) throw Stopped();
  };
  try {
    outcome = replay_session(*scene, recording, keep);
    stage = Stage::kWhole;
  } catch (const Stopped&) {
    stage = Stage::kStopped;
  }
}

void RecordedRun::State::fail(const std::string& why) {
  {
    const std::lock_guard lock(mutex);
    failure = why;
  }
  stage = Stage::kFailed;
}

RecordedRun::RecordedRun(std::unique_ptr<State> state) : state_(std::move(state)) {}
RecordedRun::RecordedRun(RecordedRun&&) noexcept = default;

RecordedRun::RecordedRun(const std::filesystem::path& recording, const AssetRoots& assets, const std::string& organ,
                         const std::function<bool(double)>& progress)
    : state_(std::make_unique<State>()) {
  state_->file = recording;
  state_->assets = assets;
  state_->organ = organ;
  state_->make(progress);
}

RecordedRun RecordedRun::in_background(const std::filesystem::path& recording, const AssetRoots& assets,
                                       const std::string& organ) {
  auto state = std::make_unique<State>();
  state->file = recording;
  state->assets = assets;
  state->organ = organ;
  State& s = *state;
  s.thread = std::thread([&s] {
    try {
      s.make({});
    } catch (const std::exception& error) {
      s.fail(error.what());
    }
  });
  return RecordedRun(std::move(state));
}

RecordedRun::~RecordedRun() {
  if (!state_) return;
  state_->stop = true;
  if (state_->thread.joinable()) state_->thread.join();
}

RecordedRun& RecordedRun::operator=(RecordedRun&& other) noexcept {
  std::swap(state_, other.state_);
  return *this;
}

RecordedRun::Stage RecordedRun::stage() const { return state_->stage; }
bool RecordedRun::has_pictures() const { return plays_keyframes() || state_->moments.size() > 0; }
bool RecordedRun::plays_keyframes() const { return stage() != Stage::kLoading && state_->recorded; }

std::string RecordedRun::failure() const {
  const std::lock_guard lock(state_->mutex);
  return state_->failure;
}

std::string RecordedRun::torn() const {
  const std::lock_guard lock(state_->mutex);
  return state_->torn;
}

const Scene& RecordedRun::scene() const {
  if (stage() == Stage::kLoading || !state_->scene) throw std::logic_error("the recording is still being loaded");
  return *state_->scene;
}

double RecordedRun::begin_s() const { return state_->begin_s; }
double RecordedRun::end_s() const { return state_->end_s; }
double RecordedRun::available_until() const {
  return plays_keyframes() || stage() == Stage::kWhole ? state_->end_s : state_->moments.last_s();
}

RunMoment RecordedRun::at(double t_s) const {
  if (!plays_keyframes()) return state_->moments.at(t_s);
  try {
    return state_->recorded->at(t_s);
  } catch (const InputError& error) {
    state_->fail(error.what());
    return state_->recorded->bare(t_s);
  }
}

const std::vector<Event>& RecordedRun::events() const { return state_->events; }
const Grade& RecordedRun::grade() const { return state_->grade; }

const SessionOutcome& RecordedRun::outcome() const {
  if (stage() != Stage::kWhole || plays_keyframes())
    throw std::logic_error("the recording has not been run to its end");
  return state_->outcome;
}

std::vector<RecordedRun::Column> RecordedRun::force_columns(int columns, double from_s, double to_s) const {
  return columns_of(state_->trace, state_->trace.force_n, columns, from_s, to_s);
}

std::vector<RecordedRun::Column> RecordedRun::grip_columns(int columns, double from_s, double to_s) const {
  return columns_of(state_->trace, state_->trace.grip_n, columns, from_s, to_s);
}

std::size_t RecordedRun::bytes() const {
  return (state_->recorded ? state_->recorded->bytes() : state_->moments.bytes()) +
         state_->trace.t_s.size() * (sizeof(double) + 2 * sizeof(float));
}

}  // namespace trocar
