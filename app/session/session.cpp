#include "app/session/session.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "app/session/grading/device_words.h"
#include "app/session/grading/realtime_report.h"
#include "app/session/grading/recorded_result.h"
#include "app/session/lanes/clock_witness.h"
#include "app/session/lanes/force_sensor_task.h"
#include "app/session/lanes/hand_task.h"
#include "app/session/lanes/haptic_task.h"
#include "app/session/lanes/lockstep_executor.h"
#include "app/session/lanes/real_time.h"
#include "app/session/lanes/recorder_task.h"
#include "app/session/lanes/replay_executor.h"
#include "app/session/lanes/threaded_executor.h"
#include "app/session/lanes/tissue_task.h"
#include "app/session/recording/safety_file.h"
#include "app/session/setup/true_plant.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/input_error.h"
#include "scenarios/director/event_peaks.h"
#include "scenarios/director/scoring_context.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/hands/make_hand.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/kinds/needle/needle_layout.h"
#include "scenarios/scoring/score.h"

namespace trocar {
namespace {

constexpr std::uint64_t kPatchDelay = 5;  // ticks from the tissue task to the haptic task
constexpr double kPictureRateHz = 50;     // live; frames that come too late are dropped
constexpr int kHapticPriority = 80, kTissuePriority = 60, kSensorPriority = 50;
constexpr std::uint64_t kSensorSeed = 0xf0ece5;  // the sensor's noise, apart from the hand's
constexpr double kMotorsTold_s = 5;
constexpr double kTissueOffset = 0.5;          // loop periods: a tissue step sees the tick of its own period
constexpr double kLongestBeyondLimits_s = 60;  // homing and reading, beyond the run's time and the director's patience

/// Channels, models and tasks of one run, whatever drives them and whatever back-end is behind.
struct Rig {
  Rig(const Scene& scene_in, DataAcquisition& daq, Timing timing, std::unique_ptr<Channel<ContactPatch>> patches,
      RecorderRings* recorder, const KeyframeRule& keyframes = {})
      : scene(scene_in),
        state(make_channel<HapticState>(timing)),
        patch(std::move(patches)),
        hand_frames(make_channel<ExerciseFrame>(timing)),
        observer_frames(make_channel<ExerciseFrame>(timing)),
        records(make_channel<TickRecord>(timing)),
        motors(make_channel<MotorStates>(timing)),
        loop(scene.loop),
        director(scene.setup.exercise, scene.level, scene.board,
                 scene.loop.daq.motors ? Unbegun::kTimeout : Unbegun::kVoid),
        haptic(daq, loop, {*patch, *state, records.get(), recorder ? &recorder->ticks : nullptr, motors.get()},
               2 * scene.level.time_limit_s + kLongestBeyondLimits_s),
        tissue(scene, director,
               {*state, *patch, hand_frames.get(), observer_frames.get(), recorder ? &recorder->steps : nullptr,
                recorder ? &recorder->events : nullptr, recorder ? &recorder->tissue : nullptr, keyframes}) {}

  SessionOutcome outcome(const char* backend) {
    const TickRecord& record = haptic.record();
    SessionOutcome out;
    out.status = record.stylus.fault ? AttemptStatus::kFault : director.outcome();
    out.events = director.events();
    out.device.backend = backend;
    out.device.rate_hz = scene.loop.daq.rate_hz;
    out.device.kappa = scene.loop.map.force_scale;
    haptic.account().fill(out.device);
    tell_stop(record, out);
    StateHash hash;
    hash.add(haptic.hash().value());
    hash.add(tissue.hash().value());
    out.state_hash = hash.value();
    out.state_hash_hex = hash.hex();
    out.patch_triangles_dropped = tissue.world().dropped();
    ScoringContext context =
        scoring_context(scene.setup.exercise, scene.level, director.board(), out.events, out.status);
    context.room_share = scene.room_share;
    out.scoring_json = scoring_context_json(context);
    return out;
  }

  /// Why it ended, if not by the exercise, and what the loop remembers when its torque went off on the way.
  void tell_stop(const TickRecord& record, SessionOutcome& out) const {
    const bool reached_run = director.status().run_time_s > 0;
    out.device.reason = end_words(out.status, out.device, record.stylus.loop, reached_run, record.stylus.homing);
    bool stopped = false;
    for (const SafetyTransition& t : loop.safety_log().transitions()) {
      const double t_s = static_cast<double>(t.period) / scene.loop.daq.rate_hz;
      out.device.transitions.push_back({t_s, loop_state_name(t.from), loop_state_name(t.to)});
      stopped = stopped || t.to == LoopState::kFault || t.from == LoopState::kActive;
    }
    if (stopped) {
      out.safety_csv = safety_csv(loop.safety_log().transitions(), loop.safety_log().rows(), scene.loop.daq.rate_hz);
    }
  }

  const Scene& scene;
  std::unique_ptr<Channel<HapticState>> state;
  std::unique_ptr<Channel<ContactPatch>> patch;
  std::unique_ptr<Channel<ExerciseFrame>> hand_frames, observer_frames;
  std::unique_ptr<Channel<TickRecord>> records;
  std::unique_ptr<Channel<MotorStates>> motors;
  HapticLoop loop;
  Director director;
  HapticTask haptic;
  TissueTask tissue;
};

/// Shows the run to an observer.
class ObserverTask final : public Task {
 public:
  /// @param period loop ticks between two views.
  ObserverTask(Rig& rig, const SessionObserver& observe, std::uint32_t period)
      : rig_(rig), observe_(observe), period_(period) {}
  std::uint32_t period() const override { return period_; }
  void run(std::uint64_t tick) override {
    if (!observe_) return;
    const TickRecord& record = rig_.records->newest(tick);
    const ExerciseFrame& frame = rig_.observer_frames->newest(tick);
    observe_({rig_.scene,
              record,
              {frame.status, rig_.scene.board},
              record.stylus.t_s,
              &frame.tissue,
              frame.organ_T,
              frame.thin_T});
  }

 private:
  Rig& rig_;
  const SessionObserver& observe_;
  std::uint32_t period_;
};

/// Writes down the moments that the trainee marks, or those of messages: in the tissue task's thread, whose ring of
/// events it shares.
class MarkTask final : public Task {
 public:
  MarkTask(Rig& rig, EventRing& events, const MarkCount& marks, EventType type)
      : rig_(rig), events_(events), marks_(marks), type_(type) {}
  std::uint32_t period() const override { return rig_.tissue.period(); }
  void run(std::uint64_t tick) override {
    const StylusState& seen = rig_.state->newest(tick).stylus;
    for (const std::uint32_t asked = marks_.load(); taken_ != asked; ++taken_) {
      Event event;
      event.type = type_.name;
      const std::vector<Event>& told = rig_.director.events();
      event.t_s = told.empty() ? seen.t_s : std::max(seen.t_s, told.back().t_s);  // events stand in their order
      event.tip_T = seen.X_TI.p;
      events_.push(event);
    }
  }

 private:
  Rig& rig_;
  EventRing& events_;
  const MarkCount& marks_;
  EventType type_;
  std::uint32_t taken_ = 0;
};

/// Tells now and then how warm the motors are.
class MotorTask final : public Task {
 public:
  MotorTask(Rig& rig, const std::function<void(const MotorStates&)>& tell)
      : rig_(rig),
        tell_(tell),
        period_(static_cast<std::uint32_t>(std::lround(kMotorsTold_s * rig.scene.loop.daq.rate_hz))) {}
  std::uint32_t period() const override { return period_; }
  void run(std::uint64_t tick) override {
    if (tick > 0) tell_(rig_.motors->newest(tick));
  }

 private:
  Rig& rig_;
  const std::function<void(const MotorStates&)>& tell_;
  std::uint32_t period_;
};

WrenchSensorConfig sensor_of(const AttemptSetup& setup) {
  return setup.plant ? setup.plant->sensor.value_or(WrenchSensorConfig{}) : WrenchSensorConfig{};
}
std::optional<SensorMount> mount_of(const AttemptSetup& setup) {
  return setup.force_sensor.empty() ? std::nullopt : device_model(setup.device).sensor;
}
std::uint64_t seed_of(const AttemptSetup& setup) { return static_cast<std::uint64_t>(setup.seed); }

/// A whole attempt: back-end and rig, the simulated person and the sensor where the back-end has them, and what keeps
/// books.
struct Attempt {
  Attempt(const Scene& scene, std::unique_ptr<Hand> person, RecordingWriter& writer, Timing timing,
          const KeyframeRule& keyframes)
      : backend(setup_backend(scene.setup)),
        rig(scene, *backend.daq, timing, make_channel<ContactPatch>(timing, kPatchDelay), rings.get(), keyframes),
        forces(make_channel<StylusForces>(timing)),
        tap(backend.world, rig.haptic, scene.loop.map.X_TW.R, *forces,
            sensor_of(scene.setup).fixture_kg * sensor_of(scene.setup).gravity),
        recorder(*rings, scene.loop.daq.rate_hz, writer) {
    if (backend.world) hand.emplace(scene, rig.haptic, *rig.hand_frames, std::move(person), *backend.world);
    std::optional<RealSensorPlace> real;
    if (backend.stream) real = {scene.loop.device.sensor, scene.loop.map.X_TW.R};
    if (backend.sensor) sensor.emplace(*forces, *backend.sensor, scene.loop.daq.rate_hz, real);
  }

  /// What runs in the haptic thread, in this order.
  std::vector<Task*> haptic_lane() {
    std::vector<Task*> tasks;
    if (hand) tasks.push_back(&*hand);
    tasks.insert(tasks.end(), {&rig.haptic, &tap});
    return tasks;
  }
  SessionOutcome outcome() {
    SessionOutcome out = rig.outcome(backend.daq->capabilities().name);
    const AttemptSetup& setup = rig.scene.setup;
    std::optional<RealSensorLine> line;
    if (backend.stream) line = {setup.force_sensor, backend.stream->link()};
    if (sensor) out.device.force_sensor = force_sensor_json(*sensor, line);
    if (sensor && line) out.notes = force_sensor_notes(*sensor, *line);
    if (backend.world && backend.daq->capabilities().motors)
      out.device.plant = plant_json(setup.plant.get(), setup.seed, setup.device);
    return out;
  }

  std::unique_ptr<RecorderRings> rings = std::make_unique<RecorderRings>();
  Backend backend;
  Rig rig;
  std::optional<HandTask> hand;
  std::unique_ptr<Channel<StylusForces>> forces;
  ForceTapTask tap;
  std::optional<ForceSensorTask> sensor;
  RecorderTask recorder;
};

SessionOutcome run_lockstep(Attempt& attempt, const SessionHooks& hooks) {
  Rig& rig = attempt.rig;
  ObserverTask observer(rig, hooks.observe, rig.tissue.period());
  LockstepExecutor executor;
  for (Task* task : attempt.haptic_lane()) executor.add(*task);
  executor.add(rig.tissue);
  if (attempt.sensor) executor.add(*attempt.sensor);
  executor.add(attempt.recorder);
  executor.add(observer);
  executor.run(hooks.interrupted);
  return attempt.outcome();
}

/// Lanes of their own for what must be on time; pictures in this thread, to which their context belongs, or wherever an
/// observer of each step takes them.
SessionOutcome run_live(Attempt& attempt, const SessionHooks& hooks) {
  Rig& rig = attempt.rig;
  const double rate_hz = rig.scene.loop.daq.rate_hz;
  const bool each_step = hooks.observe && hooks.observe_each_step;
  ObserverTask observer(rig, hooks.observe,
                        each_step ? rig.tissue.period() : static_cast<std::uint32_t>(rate_hz / kPictureRateHz));
  ThreadedExecutor executor(rate_hz, attempt.backend.can.pause ? hooks.pause : nullptr);
  std::vector<Task*> tissue{&rig.tissue};
  if (each_step) tissue.push_back(&observer);
  std::optional<MarkTask> marks, messages;
  if (hooks.marks) tissue.push_back(&marks.emplace(rig, attempt.rings->events, *hooks.marks, event_type::kMarked));
  if (hooks.messages)
    tissue.push_back(&messages.emplace(rig, attempt.rings->events, *hooks.messages, event_type::kMessage));
  executor.add_lane("haptic", attempt.haptic_lane(), kHapticPriority);
  if (hooks.board_answers) executor.await(hooks.board_answers);
  executor.pace_by(attempt.backend.await_sync);
  executor.pin(isolated_processor());
  if (attempt.backend.daq->capabilities().motors) executor.keep_awake();
  executor.add_lane("tissue", tissue, kTissuePriority, kTissueOffset);
  if (attempt.sensor) executor.add_lane("force-sensor", {&*attempt.sensor}, kSensorPriority, kTissueOffset);
  std::vector<Task*> kept{&attempt.recorder};
  std::optional<MotorTask> motors;
  if (hooks.motors) kept.push_back(&motors.emplace(rig, hooks.motors));
  executor.add_lane("recorder", kept, 0);
  if (hooks.observe && !each_step) executor.add_own_lane("pictures", {&observer});
  ClockWitness witness;
  executor.run([&] {
    witness.look();
    return hooks.interrupted && hooks.interrupted();
  });
  if (hooks.paced) hooks.paced(executor);
  if (hooks.motors) hooks.motors(rig.loop.motors());
  SessionOutcome out = attempt.outcome();
  out.device.realtime = realtime_json(executor, attempt.recorder.lost(), witness.seen());
  for (std::string& note : realtime_notes(executor, attempt.recorder.lost())) out.notes.push_back(std::move(note));
  return out;
}

SessionHooks hooks_of(const SessionObserver& observe, const std::function<bool()>& interrupted) {
  SessionHooks hooks;
  hooks.observe = observe;
  hooks.interrupted = interrupted;
  return hooks;
}

}  // namespace

SimulatedDaqConfig simulated_device(const AttemptSetup& setup) {
  SimulatedDaqConfig config;
  config.rate_hz = setup.rate_hz;
  config.seed = static_cast<std::uint64_t>(setup.seed);
  config.hand = hand_parameters(GripPreset::kNormal);
  if (setup.plant) {
    config.plant = setup.plant->parameters;
    config.hand = setup.plant->hand.value_or(config.hand);
  }
  config.faults = setup.faults;
  // The board's watchdog is as patient as the loop's own limits: live on a busy machine both are wide.
  if (setup.pace != PaceLimits{}) config.watchdog_s = setup.pace.missed_in_a_row / setup.rate_hz;
  return config;
}

void require_scripted(const AttemptSetup& setup) {
  if (!backend_capabilities(setup.backend, setup.rate_hz).motors)
    throw InputError("--backend " + setup.backend + ": a person's mouse, keys or pad; a script needs a device");
  if (is_real_device(setup.backend))
    throw InputError("--backend " + setup.backend + ": a person holds that arm, no script moves it: trocar practice");
}

Backend setup_backend(const AttemptSetup& setup) {
  return make_backend(setup.backend, {.simulated = simulated_device(setup),
                                      .sensor = sensor_of(setup).force,
                                      .sensor_seed = seed_of(setup) ^ kSensorSeed,
                                      .card = setup.card,
                                      .force_sensor = setup.force_sensor,
                                      .sensor_mount = mount_of(setup)});
}

SessionOutcome run_session(const Scene& scene, const AssetRoots& assets, const SessionHooks& hooks,
                           RecordingWriter& writer) {
  const Timing timing = scene.setup.realtime ? Timing::kLive : Timing::kLockstep;
  if (scene.setup.tissue == kStillTissue &&
      (judges_pull(scene.setup.exercise) || !scene.board.nodules.empty() || !scene.board.ducts_T.empty() ||
       needle_stand(scene.setup.exercise, scene.board) ||
       std::any_of(scene.setup.exercise.sheets.begin(), scene.setup.exercise.sheets.end(),
                   [](const SheetPlan& sheet) { return sheet.organ.empty(); })))
    throw InputError("exercise '" + scene.setup.exercise.id + "' is about tissue that must give way: '" + kStillTissue +
                     "' does not, choose another");
  if (judges_pull(scene.setup.exercise) && !scene.setup.exercise.sheets.empty() && scene.sheets.empty())
    throw InputError("exercise '" + scene.setup.exercise.id + "' is about a sheet that '" + scene.organ.name +
                     "' has not: choose another organ");
  if (!hooks.hand) require_scripted(scene.setup);
  auto hand =
      hooks.hand ? hooks.hand() : make_hand(scene.setup.hand, seed_of(scene.setup), assets.hands, scene.setup.attempt);
  const auto attempt = std::make_unique<Attempt>(scene, std::move(hand), writer, timing, hooks.keyframes);
  if (timing == Timing::kLockstep && !attempt->backend.can.pace) {
    throw InputError("--backend " + scene.setup.backend + ": runs by its own clock; add --realtime");
  }
  SessionOutcome out = timing == Timing::kLive ? run_live(*attempt, hooks) : run_lockstep(*attempt, hooks);
  if (out.status == AttemptStatus::kAborted && hooks.interrupted && hooks.interrupted()) {
    out.device.reason = "interrupted before its end";
  }
  RecordingEnd end;
  end.state_hash = out.state_hash;
  end.status = out.status;
  end.summary_json = out.scoring_json;
  writer.close(end, run_report_json(out.device));
  return out;
}

SessionOutcome run_session(const Scene& scene, const AssetRoots& assets, RecordingWriter& writer,
                           const SessionObserver& observe, const std::function<bool()>& interrupted) {
  return run_session(scene, assets, hooks_of(observe, interrupted), writer);
}

std::pair<SessionOutcome, Recording> record_session(const Scene& scene, const AssetRoots& assets,
                                                    const std::filesystem::path& file, const SessionObserver& observe,
                                                    const std::function<bool()>& interrupted) {
  return record_session(scene, assets, hooks_of(observe, interrupted), file);
}

std::pair<SessionOutcome, Recording> record_session(const Scene& scene, const AssetRoots& assets,
                                                    const SessionHooks& hooks, const std::filesystem::path& file) {
  const std::string header = scene_json(scene);
  if (file.empty()) {
    MemorySink memory;
    RecordingWriter writer(memory, header, scene.loop.daq.rate_hz, hooks.seal);
    SessionOutcome outcome = run_session(scene, assets, hooks, writer);
    return {std::move(outcome), parse_recording(memory.bytes(), "recording in memory")};
  }
  RecordingWriter writer(file, header, scene.loop.daq.rate_hz, hooks.seal);
  SessionOutcome outcome = run_session(scene, assets, hooks, writer);
  Recording kept = read_recording(file);
  if (kept.attempt != hooks.seal.attempt || (hooks.seal.key && kept.signed_by != hooks.seal.key->public_key()))
    throw EnvironmentError(file.string() + ": another recording was put in its place while the attempt ran");
  return {std::move(outcome), std::move(kept)};
}

SessionOutcome replay_session(const Scene& scene, const Recording& recording, const SessionObserver& observe) {
  const double rate_hz = scene.loop.daq.rate_hz;
  const ReplayExecutor executor(
      recording.ticks,
      recording.version > 1
          ? recording.schedule
          : declared_schedule(recording.ticks, static_cast<std::uint64_t>(rate_hz / kTissueRateHz), kPatchDelay));
  std::vector<DaqSample> samples;
  samples.reserve(recording.ticks.size());
  for (const RecordedTick& row : recording.ticks) samples.push_back(device_input(row));
  const Backend backend = replay_backend(std::move(samples), scene.loop.daq);
  const auto rig = std::make_unique<Rig>(scene, *backend.daq, Timing::kLockstep,
                                         std::make_unique<RecordedPatches>(executor.stamps()), nullptr);
  ObserverTask observer(*rig, observe, rig->tissue.period());
  executor.run(rig->haptic, {&rig->tissue, &observer});
  return rig->outcome(backend.daq->capabilities().name);
}

GradedRecording grade_recording(const Recording& recording, const std::string& name, const Exercise* rubric_of) {
  const RecordedSetup recorded = parse_scene_json(recording.session, name);
  const Exercise& own = recorded.setup.exercise;
  const ExerciseLevel& judged = find_level(rubric_of ? *rubric_of : own, recorded.setup.level);
  const Rubric& rubric = rubric_for(judged, recorded.daq);
  ScoringContext context;
  if (recording.end && !recording.end->summary_json.empty()) {
    context = parse_scoring_context(recording.end->summary_json, name);
    if (context.counted_hold_s == 0) context.counted_hold_s = (rubric_of ? *rubric_of : own).counted_hold_s;
    if (rubric_of) context.rise_s = rubric_of->rise_s;  // its anchors were set with it
  } else {
    context.outcome = AttemptStatus::kAborted;  // cut off: no number, but the metrics of what is there
    const ExerciseLevel& level = find_level(own, recorded.setup.level);
    context = scoring_context(own, level, Board{}, recording.events, AttemptStatus::kAborted);
  }
  const Trace trace = rebuild_trace(recording.ticks, recording.rate_hz);
  GradedRecording out{score_attempt(trace, recording.events, rubric, context), recording.events};
  raise_to_peaks(out.events, trace, context);
  if (!out.grade.score || recording.run_report_json.empty()) return out;
  const std::string fault = pacing_fault(parse_run_report(recording.run_report_json, name).realtime, recording.events);
  if (!fault.empty()) out.grade = void_grade(fault);
  return out;
}

void fill_shares(const Recording& recording, RunReport& device) {
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
