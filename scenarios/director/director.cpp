#include "scenarios/director/director.h"

#include <algorithm>

#include "scenarios/director/exercise_task.h"
#include "scenarios/director/homing_words.h"
#include "scenarios/director/safety_watch.h"
#include "scenarios/director/surgery_watch.h"
#include "scenarios/kinds/kind.h"

namespace trocar {
namespace {

constexpr double kLongestStep = 0.1;  // s: a gap in the states never counts as more

}  // namespace

struct Director::State {
  State(const Exercise& exercise_in, const ExerciseLevel& level, Board board_in, Unbegun unbegun_in)
      : exercise(exercise_in),
        unbegun(unbegun_in),
        time_limit_s(level.time_limit_s),
        display(level.force_display),
        board(std::move(board_in)),
        watch(exercise),
        tasks(kind_of(exercise).tasks(exercise, level, board)) {
    status.cue = Cue::kWait;
    status.demand.centre_T = board.start_T;
    status.demand.radius_m = exercise.start_sphere_m;
    status.force_shown = force_shown(display, false);
  }

  void wait_for_start(const StylusState& state, double dt_s);
  void run(const StylusState& state, const TissueFrame* tissue, double dt_s);
  void end(Phase phase, EventType type, Severity severity, double value, const char* unit);
  void describe_start(const StylusState& state);
  void describe_run(const TaskInput& input);
  bool all_done() const { return current >= tasks.size(); }

  Exercise exercise;
  Unbegun unbegun;
  double time_limit_s;
  std::string display;
  Board board;
  DirectorStatus status;
  EventLog log;
  SafetyWatch watch;
  SurgeryWatch surgery;
  std::vector<std::unique_ptr<ExerciseTask>> tasks;
  std::size_t current = 0;
  double last_s = -1, waiting_s = 0, in_start_s = 0, start_s = 0;
  AttemptStatus outcome = AttemptStatus::kAborted;
};

void Director::State::end(Phase phase, EventType type, Severity severity, double value, const char* unit) {
  log.add(type, severity, -1, value, unit);
  status.phase = phase;
  status.cue = Cue::kFinished;
  status.target_index = -1;
  status.grip = {};
  status.force_shown = display != "after";
  switch (phase) {
    case Phase::kDone:
      outcome = AttemptStatus::kCompleted;
      return say(status, "Done", "Your result follows.");
    case Phase::kTimeout:
      outcome = AttemptStatus::kTimeout;
      return say(status, "Time is up", "Your result follows.", true);
    case Phase::kVoid:
      outcome = AttemptStatus::kVoid;
      return say(status, "Device switched off", "A graded attempt cannot be paused: it is void.", true);
    default:
      outcome = AttemptStatus::kFault;
      return say(status, "Device fault", "This attempt is not graded.", true);
  }
}

void Director::State::describe_start(const StylusState& state) {
  if (state.loop != LoopState::kActive) {
    const HomingWords words = homing_words(state.loop, state.homing);
    return say(status, words.title, words.hint, words.warning);
  }
  if (status.phase == Phase::kArmed)
    return say(status, "Hold still in the start ball", "The clock starts in a moment.");
  say(status, "Move the tip into the start ball",
      kind_of(exercise).on_organ ? "It floats above the organ." : "It floats above the board.");
}

void Director::State::wait_for_start(const StylusState& state, double dt_s) {
  const bool active = state.loop == LoopState::kActive;
  if (active) {
    waiting_s += dt_s;
    const bool inside = !frozen(state) && (state.X_TI.p - board.start_T).norm() <= exercise.start_sphere_m;
    in_start_s = inside && status.phase == Phase::kArmed ? in_start_s + dt_s : 0;
    status.phase = inside ? Phase::kArmed : Phase::kReady;
    if (inside && in_start_s >= exercise.start_hold_s - 1e-9) {
      start_s = log.t_s;
      status.phase = Phase::kRun;
      log.add(event_type::kStart, Severity::kInfo);
      tasks.front()->begin(log);
      return describe_run({state, nullptr, 0, false});
    }
    if (waiting_s >= time_limit_s) {
      if (unbegun == Unbegun::kTimeout)
        return end(Phase::kTimeout, event_type::kTimeout, Severity::kMajor, time_limit_s, "s");
      end(Phase::kVoid, event_type::kTimeout, Severity::kInfo, time_limit_s, "s");
      return say(status, "Not begun", "The tip did not rest in the start ball. Nothing is graded.", true);
    }
  }
  describe_start(state);
}

void Director::State::describe_run(const TaskInput& input) {
  status.excess_forces = watch.excess_count();
  status.peak_force_n = watch.peak_n();
  for (std::size_t i = 0; i <= current && i < tasks.size(); ++i) tasks[i]->describe(input, status);
}

void Director::State::run(const StylusState& state, const TissueFrame* tissue, double dt_s) {
  status.run_time_s = log.t_s - start_s;
  watch.update(state, dt_s, tasks[current]->object(), log);
  if (tissue) {
    surgery.update(tissue->surgery, dt_s, log);
    surgery.update(tissue->suture, log);
  }
  const TaskInput input{state, tissue, dt_s, watch.too_hard()};
  for (std::size_t i = 0; i < current; ++i) tasks[i]->keep_watch(input, log);
  tasks[current]->update(input, log);
  describe_run(input);
  if (tasks[current]->finished()) {
    ++current;
    if (all_done()) return end(Phase::kDone, event_type::kDone, Severity::kInfo, status.run_time_s, "s");
    tasks[current]->begin(log);
    describe_run(input);
  }
  if (status.run_time_s >= time_limit_s)
    end(Phase::kTimeout, event_type::kTimeout, Severity::kMajor, time_limit_s, "s");
}

Director::Director(const Exercise& exercise, const ExerciseLevel& level, Board board, Unbegun unbegun)
    : state_(std::make_unique<State>(exercise, level, std::move(board), unbegun)) {}
Director::~Director() = default;
Director::Director(Director&&) noexcept = default;
Director& Director::operator=(Director&&) noexcept = default;

void Director::update(const StylusState& state, const TissueFrame* tissue) {
  State& s = *state_;
  if (finished()) return;
  const double dt_s = s.last_s < 0 ? 0 : std::clamp(state.t_s - s.last_s, 0.0, kLongestStep);
  s.last_s = state.t_s;
  s.log.t_s = state.t_s;
  s.log.tip_T = state.X_TI.p;
  if (state.loop == LoopState::kFault)
    return s.end(Phase::kFault, event_type::kDeviceFault, Severity::kMajor, state.fault.value, "");
  if (s.status.phase == Phase::kRun && state.loop != LoopState::kActive)
    return s.end(Phase::kVoid, event_type::kDeadmanOpen, Severity::kMajor, s.status.run_time_s, "s");
  if (s.status.phase == Phase::kRun) {
    s.run(state, tissue, dt_s);
  } else {
    if (tissue) s.surgery.skip(*tissue);
    s.wait_for_start(state, dt_s);
  }
}

const DirectorStatus& Director::status() const { return state_->status; }
const Board& Director::board() const { return state_->board; }
const std::vector<Event>& Director::events() const { return state_->log.events; }
bool Director::finished() const {
  const Phase phase = state_->status.phase;
  return phase == Phase::kDone || phase == Phase::kTimeout || phase == Phase::kFault || phase == Phase::kVoid;
}
AttemptStatus Director::outcome() const { return state_->outcome; }

}  // namespace trocar
