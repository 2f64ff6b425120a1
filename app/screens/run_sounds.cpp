#include "app/screens/run_sounds.h"

#include <algorithm>

namespace trocar {

double force_tone(const Scene& scene, const RunMoment& moment) {
  const DirectorStatus& status = moment.status;
  if (status.phase != Phase::kRun || !status.force_shown || scene.level.force_display == "after") return 0;
  const bool grip = status.cue == Cue::kGrip || scene.setup.exercise.kind == ExerciseKind::kGrasp;
  const double force = grip ? moment.record.stylus.grip_force_n : moment.record.stylus.F_I_T.force.norm();
  const double limit = grip ? scene.setup.exercise.grip.excess_n : scene.setup.exercise.hard_force_n;
  const double high = status.demand.band.high_n;
  if (high <= 0 || limit <= high) return 0;
  return std::clamp((force - high) / (limit - high), 0.0, 1.0);
}

void RunSounds::hear(const Scene& scene, const RunMoment& moment, Sound& sound) {
  const DirectorStatus& status = moment.status;
  const bool contact = moment.record.stylus.contact;
  const int errors = status.excess_forces + status.wrong_places;
  const bool fault = moment.record.stylus.loop == LoopState::kFault;
  const bool ended = status.phase == Phase::kDone || status.phase == Phase::kTimeout;
  if (any_) {
    if (contact != contact_) sound.play(contact ? Tone::kTouch : Tone::kRelease);
    if (status.targets_done > done_) sound.play(Tone::kGood);
    if (errors > errors_) sound.play(Tone::kTooMuch);
    if (fault && !fault_) sound.play(Tone::kFault);
    if (ended && !ended_) sound.play(Tone::kDone);
  }
  sound.hold_force(force_tone(scene, moment));
  any_ = true;
  contact_ = contact;
  done_ = status.targets_done;
  errors_ = errors;
  fault_ = fault;
  ended_ = ended;
}

}  // namespace trocar
