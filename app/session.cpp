#include "app/session.h"

#include <algorithm>
#include <optional>

#include <nlohmann/json.hpp>

#include "app/executor/hand_task.h"
#include "app/executor/haptic_task.h"
#include "app/executor/lockstep_executor.h"
#include "app/executor/recorder_task.h"
#include "app/executor/tissue_task.h"
#include "haptics/device/replay_daq.h"
#include "haptics/input_error.h"
#include "scenarios/exercise_loader.h"
#include "scenarios/hands/make_hand.h"
#include "scenarios/scoring/score.h"
#include "scenarios/scoring_context.h"

namespace trocar {
namespace {

constexpr std::uint64_t kPatchDelay = 5;       // ticks from the tissue task to the haptic task
constexpr double kAfterFault_s = 0.1;          // the loop is watched this long after a fault, then the attempt ends
constexpr double kLongestBeyondLimit_s = 60;   // homing, start and reading, on top of the exercise's limit

/// Everything that one lockstep run owns, whatever the back-end.
struct Bench {
  Bench(const Scene& scene_in, DataAcquisition& daq)
      : scene(scene_in),
        patch(kPatchDelay),
        loop(scene.loop),
        director(scene.setup.exercise, scene.level, scene.board),
        haptic(daq, loop, patch, hash),
        tissue(scene, haptic, patch, director, hash) {}

  /// The run ends when the exercise has, a fault has been seen for a moment, or far beyond the limit.
  bool finished() {
    const TickRecord& record = haptic.record();
    if (record.stylus.loop == LoopState::kFault) return ++fault_ticks > kAfterFault_s * scene.loop.daq.rate_hz;
    if (director.finished()) return true;
    return record.stylus.t_s > scene.setup.exercise.time_limit_s + kLongestBeyondLimit_s;
  }

  void account() {
    const TickRecord& record = haptic.record();
    ++device.ticks;
    device.overruns += record.in.elapsed_periods - 1;
    device.min_energy_j = record.min_energy_j;
  }

  SessionOutcome outcome(const char* backend) {
    const Fault& fault = haptic.record().stylus.fault;
    device.backend = backend;
    device.rate_hz = scene.loop.daq.rate_hz;
    device.kappa = scene.loop.map.force_scale;
    device.fault = fault ? fault_name(fault.code) : "";
    SessionOutcome out;
    out.status = fault ? AttemptStatus::kFault : director.outcome();
    out.events = director.events();
    out.device = device;
    out.state_hash = hash.value();
    out.state_hash_hex = hash.hex();
    out.patch_triangles_dropped = tissue.world().dropped();
    out.scoring_json = scoring_context_json(
        scoring_context(scene.setup.exercise, scene.level, director.board(), out.events, out.status));
    return out;
  }

  const Scene& scene;
  StateHash hash;
  DelayedChannel<ContactPatch> patch;
  HapticLoop loop;
  Director director;
  HapticTask haptic;
  TissueTask tissue;
  DeviceReceipt device;
  int fault_ticks = 0;
};

/// Shows the run to an observer at the tissue rate.
class ObserverTask final : public Task {
 public:
  ObserverTask(const Bench& bench, const SessionObserver& observe) : bench_(bench), observe_(observe) {}
  std::uint32_t period() const override { return bench_.tissue.period(); }
  void run(std::uint64_t) override {
    const TickRecord& record = bench_.haptic.record();
    if (observe_) observe_({bench_.scene, record, bench_.director, record.stylus.t_s});
  }

 private:
  const Bench& bench_;
  const SessionObserver& observe_;
};

/// Counts what the receipt needs, each tick.
class ReceiptTask final : public Task {
 public:
  explicit ReceiptTask(Bench& bench) : bench_(bench) {}
  std::uint32_t period() const override { return 1; }
  void run(std::uint64_t) override { bench_.account(); }

 private:
  Bench& bench_;
};

}  // namespace

SimulatedDaqConfig simulated_device(const AttemptSetup& setup) {
  SimulatedDaqConfig config;
  config.rate_hz = setup.rate_hz;
  config.seed = static_cast<std::uint64_t>(setup.seed);
  config.hand = hand_parameters(GripPreset::kNormal);
  config.faults = setup.faults;
  return config;
}

SessionOutcome run_session(const Scene& scene, const AssetRoots& assets, RecordingWriter& writer,
                           const SessionObserver& observe) {
  SimulatedDaq daq(simulated_device(scene.setup));
  Bench bench(scene, daq);
  HandTask hand(scene, bench.haptic, bench.director,
                make_hand(scene.setup.hand, static_cast<std::uint64_t>(scene.setup.seed), assets.hands), daq);
  RecorderTask recorder(bench.haptic, bench.director, writer);
  ReceiptTask receipt(bench);
  ObserverTask observer(bench, observe);
  LockstepExecutor executor;
  for (Task* task : std::initializer_list<Task*>{&hand, &bench.haptic, &bench.tissue, &recorder, &receipt, &observer}) {
    executor.add(*task);
  }
  executor.run([&] { return bench.finished(); });
  recorder.append_new_events();

  const SessionOutcome out = bench.outcome(daq.capabilities().name);
  RecordingEnd end;
  end.state_hash = out.state_hash;
  end.status = out.status;
  end.summary_json = out.scoring_json;
  writer.close(end);
  return out;
}

SessionOutcome replay_session(const Scene& scene, const Recording& recording, const SessionObserver& observe) {
  if (recording.ticks.empty()) throw InputError("the recording holds no tick to replay");
  std::vector<DaqSample> samples;
  samples.reserve(recording.ticks.size());
  for (const RecordedTick& row : recording.ticks) samples.push_back(device_input(row));
  ReplayDaq daq(std::move(samples), scene.loop.daq);
  Bench bench(scene, daq);
  ReceiptTask receipt(bench);
  ObserverTask observer(bench, observe);
  LockstepExecutor executor;
  for (Task* task : std::initializer_list<Task*>{&bench.haptic, &bench.tissue, &receipt, &observer}) executor.add(*task);
  executor.run([&] { return daq.finished(); });
  return bench.outcome(daq.capabilities().name);
}

Grade grade_recording(const Recording& recording, const std::string& name, const Exercise* rubric_of) {
  const RecordedSetup recorded = parse_scene_json(recording.session, name);
  const Exercise& own = recorded.setup.exercise;
  const Rubric& rubric = find_level(rubric_of ? *rubric_of : own, recorded.setup.level).rubric;
  ScoringContext context;
  if (recording.end && !recording.end->summary_json.empty()) {
    context = parse_scoring_context(recording.end->summary_json, name);
  } else {
    context.outcome = AttemptStatus::kAborted;  // cut off: no number, but the metrics of what is there
    const ExerciseLevel& level = find_level(own, recorded.setup.level);
    context = scoring_context(own, level, Board{}, recording.events, AttemptStatus::kAborted);
  }
  const Trace trace = rebuild_trace(recording.ticks, recording.rate_hz);
  return score_attempt(trace, recording.events, rubric, context);
}

void fill_shares(const Recording& recording, DeviceReceipt& device) {
  std::uint64_t contact = 0, saturated = 0, passivity = 0;
  for (const RecordedTick& row : recording.ticks) {
    if (!(row.flags & kFlagContact)) continue;
    ++contact;
    saturated += row.flags & kFlagSaturated ? 1 : 0;
    passivity += row.flags & kFlagPassivityActive ? 1 : 0;
  }
  if (contact == 0) return;
  device.saturated_contact_share = static_cast<double>(saturated) / static_cast<double>(contact);
  device.passivity_active_share = static_cast<double>(passivity) / static_cast<double>(contact);
}

}  // namespace trocar
