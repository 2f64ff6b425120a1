#include "app/window/run/run_sounds.h"

#include <algorithm>
#include <utility>

#include "scenarios/kinds/kind.h"

namespace trocar {

namespace {

constexpr double kBuzz = 0.7;        // level
constexpr double kArmedAgain = 0.9;  // of the band's upper end, below which the next crossing warns again

bool by_grip(const Scene& scene, const DirectorStatus& status) {
  return watched_now(scene.setup.exercise, status) == WatchedForce::kGrip;
}

/// Of what is asked for now: the tip's or the grip's.
double felt_force_n(const Scene& scene, const RunMoment& moment) {
  return by_grip(scene, moment.status) ? moment.record.stylus.grip_force_n : moment.record.stylus.F_I_T.force.norm();
}

}  // namespace

double force_tone(const Scene& scene, const RunMoment& moment) {
  const DirectorStatus& status = moment.status;
  if (status.phase != Phase::kRun || !status.force_shown || scene.level.force_display == "after") return 0;
  const JudgedForces limits = judged_forces(scene.setup.exercise, scene.level, scene.board, status);
  const double limit = (by_grip(scene, status) ? limits.grip_n : limits.tip_n).value_or(0);
  const double high = status.demand.band.high_n;
  if (high <= 0 || limit <= high) return 0;
  return std::clamp((felt_force_n(scene, moment) - high) / (limit - high), 0.0, 1.0);
}

/// Once each time, not again while a force plays about its band's end.
bool RunSounds::warns(const Scene& scene, const RunMoment& moment, double over) {
  const bool was_over = over_, was_held = held_;
  const int timeouts = std::exchange(timeouts_, moment.status.timeouts);
  over_ = over > 0 || (over_ && felt_force_n(scene, moment) > kArmedAgain * moment.status.demand.band.high_n);
  held_ = moment.record.stylus.port_held;
  return (over_ && !was_over) || (held_ && !was_held) || timeouts_ > timeouts;
}

void RunSounds::hear(const Scene& scene, const RunMoment& moment, Sound& sound) {
  const DirectorStatus& status = moment.status;
  const bool contact = moment.record.stylus.contact;
  const int errors = status.excess_forces + status.wrong_places;
  const bool fault = moment.record.stylus.loop == LoopState::kFault;
  const bool ended = status.phase == Phase::kDone || status.phase == Phase::kTimeout;
  const double over = force_tone(scene, moment);
  const bool warned = warns(scene, moment, over);
  if (any_) {
    if (contact != contact_) sound.play(contact ? Tone::kTouch : Tone::kRelease);
    if (status.targets_done > done_) sound.play(Tone::kGood);
    if (errors > errors_)
      sound.play(Tone::kTooMuch);
    else if (warned && !ended)
      sound.play(Tone::kWarning);
    if (fault && !fault_) sound.play(Tone::kFault);
    if (ended && !ended_) sound.play(Tone::kDone);
  }
  sound.hold_force(over);
  sound.hold_cautery(moment.record.stylus.pedal && moment.tissue.surgery.contact_c > 0 ? kBuzz : 0);
  any_ = true;
  contact_ = contact;
  done_ = status.targets_done;
  errors_ = errors;
  fault_ = fault;
  ended_ = ended;
}

}  // namespace trocar
