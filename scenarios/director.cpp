#include "scenarios/director.h"

#include <algorithm>
#include <cstdio>

#include "scenarios/director_tasks.h"

namespace trocar {
namespace {

constexpr double kToastTime = 1.5;     // s for which a wrong place is shown
constexpr double kLongestStep = 0.1;   // s: a gap in the states never counts as more

std::string band_text(double low, double high) {
  char text[64];
  std::snprintf(text, sizeof text, "%.1f to %.1f N", low, high);
  return text;
}

}  // namespace

struct Director::State {
  State(const Exercise& exercise_in, const ExerciseLevel& level_in, Board board_in)
      : exercise(exercise_in),
        level(level_in),
        board(std::move(board_in)),
        watch(exercise),
        discs(exercise, level, board.targets),
        squeeze(exercise.grip, static_cast<std::int32_t>(board.targets.size())) {
    status.cue = Cue::kWait;
  }

  void wait_for_start(const StylusState& state, double dt_s);
  void run(const StylusState& state, double dt_s);
  void end(Phase phase, const char* type, Severity severity, double value, const char* unit);
  void say(const std::string& message, const std::string& hint, bool warning = false);
  void describe_start(bool active);
  void describe_discs(double force_n);
  void describe_squeeze(double grip_n);

  Exercise exercise;
  ExerciseLevel level;
  Board board;
  DirectorStatus status;
  EventLog log;
  SafetyWatch watch;
  DiscTask discs;
  SqueezeTask squeeze;
  double last_s = -1, waiting_s = 0, in_start_s = 0, start_s = 0;
  AttemptStatus outcome = AttemptStatus::kAborted;
};

void Director::State::say(const std::string& message, const std::string& hint, bool warning) {
  status.message = message;
  status.hint = hint;
  status.warning = warning;
}

void Director::State::end(Phase phase, const char* type, Severity severity, double value, const char* unit) {
  log.add(type, severity, -1, value, unit);
  status.phase = phase;
  status.cue = Cue::kFinished;
  status.target_index = -1;
  status.grip = {};
  switch (phase) {
    case Phase::kDone: outcome = AttemptStatus::kCompleted; return say("Done", "Your result follows.");
    case Phase::kTimeout: outcome = AttemptStatus::kTimeout; return say("Time is up", "Your result follows.", true);
    default: outcome = AttemptStatus::kFault; return say("Device fault", "This attempt is not graded.", true);
  }
}

void Director::State::describe_start(bool active) {
  if (!active) return say("Waiting for the device", "It starts when homing is complete.");
  if (status.phase == Phase::kArmed) return say("Hold still in the start ball", "The clock starts in a moment.");
  say("Move the tip into the start ball", "It floats above the organ.");
}

void Director::State::wait_for_start(const StylusState& state, double dt_s) {
  const bool active = state.loop == LoopState::kActive;
  if (active) {
    waiting_s += dt_s;
    const bool inside = (state.X_TI.p - board.start_T).norm() <= exercise.start_sphere_m;
    in_start_s = inside && status.phase == Phase::kArmed ? in_start_s + dt_s : 0;
    status.phase = inside ? Phase::kArmed : Phase::kReady;
    if (inside && in_start_s >= exercise.start_hold_s - 1e-9) {
      start_s = log.t_s;
      status.phase = Phase::kRun;
      log.add("START", Severity::kInfo);
      discs.begin(log);
      return describe_discs(0);
    }
    if (waiting_s >= exercise.time_limit_s)
      return end(Phase::kTimeout, "TIMEOUT", Severity::kMajor, exercise.time_limit_s, "s");
  }
  describe_start(active);
}

void Director::State::describe_discs(double force_n) {
  status.target_index = discs.index();
  status.targets_done = discs.index();
  status.hold_progress = discs.progress();
  status.cue = discs.on_disc() ? Cue::kPress : Cue::kReach;
  const std::string band = band_text(level.band_low_n, level.band_high_n);
  if (watch.too_hard()) {
    status.cue = Cue::kRelease;
    return say("Too hard - ease off", "Stay between " + band + ".", true);
  }
  if (discs.since_wrong_place_s() < kToastTime)
    return say("Wrong place", "Lift off and touch inside the lit disc.", true);
  if (!discs.touching()) {
    const std::string count = std::to_string(discs.index() + 1) + " of " + std::to_string(board.targets.size());
    return say("Touch the lit disc", "Disc " + count + ".");
  }
  if (!discs.on_disc()) return say("Move onto the lit disc", "The tip is beside it.");
  if (force_n > level.band_high_n) return say("A little softer", "Stay between " + band + ".");
  if (force_n < level.band_low_n) return say("Press gently", "Reach " + band + " and hold.");
  say("Good - hold", "Keep the force steady.");
}

void Director::State::describe_squeeze(double grip_n) {
  status.cue = Cue::kGrip;
  status.target_index = -1;
  status.targets_done = static_cast<int>(board.targets.size());
  status.grip = squeeze.block();
  status.hold_progress = squeeze.progress();
  const std::string band = band_text(exercise.grip.low_n, exercise.grip.high_n);
  if (!squeeze.offered()) return say("Open the jaws", "A block will be placed between them.");
  if (squeeze.too_hard()) return say("Too tight - ease off", "Squeeze with " + band + ".", true);
  if (grip_n > exercise.grip.high_n) return say("A little softer", "Squeeze with " + band + ".");
  if (grip_n < exercise.grip.low_n) return say("Squeeze the block", "Reach " + band + " and hold.");
  say("Good - hold", "Keep the squeeze steady.");
}

void Director::State::run(const StylusState& state, double dt_s) {
  status.run_time_s = log.t_s - start_s;
  watch.update(state, dt_s, discs.finished() ? -1 : discs.index(), log);
  if (discs.finished()) {
    squeeze.update(state, dt_s, log);
  } else {
    discs.update(state, dt_s, log);
  }
  status.wrong_places = discs.wrong_places();
  status.excess_forces = watch.excess_count() + squeeze.excess_count();
  status.peak_force_n = watch.peak_n();
  if (discs.finished()) {
    describe_squeeze(state.grip_force_n);
  } else {
    describe_discs(state.F_I_T.force.norm());
  }
  if (squeeze.finished()) return end(Phase::kDone, "DONE", Severity::kInfo, status.run_time_s, "s");
  if (status.run_time_s >= exercise.time_limit_s)
    end(Phase::kTimeout, "TIMEOUT", Severity::kMajor, exercise.time_limit_s, "s");
}

Director::Director(const Exercise& exercise, const ExerciseLevel& level, Board board)
    : state_(std::make_unique<State>(exercise, level, std::move(board))) {}
Director::~Director() = default;
Director::Director(Director&&) noexcept = default;

void Director::update(const StylusState& state) {
  State& s = *state_;
  if (finished()) return;
  const double dt_s = s.last_s < 0 ? 0 : std::clamp(state.t_s - s.last_s, 0.0, kLongestStep);
  s.last_s = state.t_s;
  s.log.t_s = state.t_s;
  s.log.tip_T = state.X_TI.p;
  if (state.loop == LoopState::kFault)
    return s.end(Phase::kFault, "DEVICE_FAULT", Severity::kMajor, state.fault.value, "");
  if (s.status.phase == Phase::kRun) {
    s.run(state, dt_s);
  } else {
    s.wait_for_start(state, dt_s);
  }
}

const DirectorStatus& Director::status() const { return state_->status; }
const Board& Director::board() const { return state_->board; }
const std::vector<Event>& Director::events() const { return state_->log.events; }
bool Director::finished() const {
  const Phase phase = state_->status.phase;
  return phase == Phase::kDone || phase == Phase::kTimeout || phase == Phase::kFault;
}
AttemptStatus Director::outcome() const { return state_->outcome; }

}  // namespace trocar
