#include "app/session/keeping/live_attempt.h"

#include <algorithm>

#include "scenarios/kinds/kind.h"

namespace trocar {
namespace {

constexpr double kRateOver_s = 1;

const char* phase_words(Phase phase) {
  switch (phase) {
    case Phase::kReady:
      return "ready";
    case Phase::kArmed:
      return "rests at the start";
    case Phase::kRun:
      return "running";
    case Phase::kDone:
      return "done";
    case Phase::kTimeout:
      return "time over";
    case Phase::kFault:
      return "device stopped";
    case Phase::kVoid:
      return "void";
  }
  return "";
}

/// The one force that the live view follows.
bool of_grip(const Scene& scene) { return kind_of(scene.setup.exercise).watched == WatchedForce::kGrip; }

/// Its hard limit, where one is judged.
std::optional<double> limit_of(const Scene& scene) {
  const JudgedForces limits = judged_forces(scene.setup.exercise, scene.level, scene.board);
  return of_grip(scene) ? limits.grip_n : limits.tip_n;
}

}  // namespace

LiveMoment live_beginning(const Scene& scene, const std::string& program, const std::string& trainee,
                          const std::string& attempt) {
  const Exercise& exercise = scene.setup.exercise;
  LiveMoment out;
  out.program = program;
  out.trainee = trainee;
  out.exercise_id = exercise.id;
  out.exercise = exercise.number + " " + exercise.title;
  out.level = scene.level.name;
  out.hand = scene.setup.hand;
  out.attempt = attempt;
  out.phase = phase_words(Phase::kReady);
  if (scene.level.time_limit_s > 0) out.limit_s = scene.level.time_limit_s;
  if (const auto limit_n = limit_of(scene); limit_n > 0.0) out.limit_n = *limit_n;
  out.count = static_cast<int>(scene.board.targets.size());
  out.device = scene.loop.daq.motors ? scene.setup.backend : "none";
  out.setup =
      "board " + std::to_string(scene.setup.board) +
      (kind_of(exercise).on_organ ? ", organ " + scene.organ.name + (scene.organ.synthetic ? " (synthetic)" : "") : "");
  return out;
}

void LiveAttempt::add(double t_s, const char* what, bool grave) {
  std::vector<LiveEvent>& events = moment_.events;
  if (events.size() == kLiveEvents) events.erase(events.begin());
  events.push_back({t_s, what, grave});
}

/// What the counts say has happened since the moment before.
void LiveAttempt::see_events(const DirectorStatus& status) {
  const double t_s = status.run_time_s;
  if (status.targets_done > counts_.done) add(t_s, "Target done", false);
  if (status.wrong_places > counts_.wrong) add(t_s, "Wrong place", false);
  if (status.excess_forces > counts_.excess) add(t_s, "Too much force", true);
  if (status.timeouts > counts_.timeouts) add(t_s, "Time for this target over", false);
  counts_ = {status.targets_done, status.wrong_places, status.excess_forces, status.timeouts};
  if (status.phase != phase_) {
    if (status.phase == Phase::kRun) add(t_s, "The clock began", false);
    if (status.phase == Phase::kFault) add(t_s, "Device stopped", true);
    if (status.phase == Phase::kTimeout) add(t_s, "Time over", false);
  }
  phase_ = status.phase;
}

void LiveAttempt::see_rate(const StylusState& stylus, bool paused, Clock::time_point now) {
  const double passed_s = std::chrono::duration<double>(now - rate_at_).count();
  const bool begins = rate_at_ == Clock::time_point{} || paused || stylus.period < rate_period_;
  if (!begins && passed_s < kRateOver_s) return;
  if (begins)
    moment_.rate_hz.reset();
  else
    moment_.rate_hz = static_cast<double>(stylus.period - rate_period_) / passed_s;
  rate_period_ = stylus.period;
  rate_at_ = now;
}

void LiveAttempt::see(const SessionView& view, bool paused, Clock::time_point now) {
  const DirectorStatus& status = view.director.status();
  const StylusState& stylus = view.record.stylus;
  see_events(status);
  see_rate(stylus, paused, now);
  const double force_n = stylus.F_I_T.force.norm(), grip_n = stylus.grip_force_n;
  if (status.phase == Phase::kRun) {
    peak_n_ = std::max({peak_n_, force_n, status.peak_force_n});
    peak_grip_n_ = std::max(peak_grip_n_, grip_n);
  }
  moment_.phase = paused ? "paused" : phase_words(status.phase);
  moment_.elapsed_s = status.run_time_s;
  moment_.force_n = of_grip(view.scene) ? grip_n : force_n;
  moment_.peak_force_n = of_grip(view.scene) ? peak_grip_n_ : peak_n_;
  moment_.done = status.targets_done;
  moment_.device_state = loop_state_name(stylus.loop);
  moment_.missed = stylus.period > stylus.tick ? static_cast<double>(stylus.period - stylus.tick) : 0;
  moment_.at_limit = stylus.saturated;
}

SessionObserver told_live(LivePublisher& publisher, LiveAttempt& attempt, SessionObserver next) {
  publisher.tell(attempt.moment());
  return
      [&publisher, &attempt, next = std::move(next), phase = attempt.moment().phase](const SessionView& view) mutable {
        attempt.see(view, false, LiveAttempt::Clock::now());
        if (attempt.moment().phase != phase || publisher.wanted()) publisher.tell(attempt.moment());
        phase = attempt.moment().phase;
        if (next) next(view);
      };
}

}  // namespace trocar
