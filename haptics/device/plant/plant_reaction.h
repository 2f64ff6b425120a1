// What the simulated person does of itself once the stylus meets something: reflex, then the voluntary grip.
//
//   touch        the grip force differs by notice_n from its mean over the last notice_s (first-order mean)
//   reflex       from reflex_s after the touch the arm stiffens: share 0 to 1 within 30 ms
//   reaction     from reaction_s on the fingers close, firm at firm_s: share 0 to 1 ("the operator stabilises it")
//   relaxation   after relax_s of quiet (force below notice_n) both shares go back to 0 within 0.2 s
// Shares rise as minimum-jerk curves, so no stiffness leaps; before its delay a share is exactly 0.
// Marks as in plant_parameters.h. SI. Thread: value type, one owner.
#pragma once

#include <cstdint>

#include "haptics/quantities.h"

namespace trocar {

struct HandReaction {
  bool on = false;
  double notice_n = 0.3;      ///< N: assumption
  double notice_s = 0.03;     ///< s, what counts as sudden: assumption
  double reflex_s = 0.040;    ///< 30 to 50 ms [M]
  double reflex_gain = 1.5;   ///< on stiffness and damping of the arm: assumption
  double reaction_s = 0.175;  ///< 150 to 200 ms [M]
  double firm_s = 0.45;       ///< [T] read from its figures: the operator ends the oscillation
  double relax_s = 0.5;       ///< assumption
};

/// Reflex uniform in 30 to 50 ms, reaction in 150 to 200 ms, the rest log-normal: notice 0.3, reflex gain (of its
/// excess) 0.3, firm 0.15 (at least 50 ms after the reaction). From a stream of its own. Switched on.
HandReaction draw_hand_reaction(std::uint64_t seed);

class PlantReaction {
 public:
  explicit PlantReaction(const HandReaction& parameters) : p_(parameters) {}

  void set_parameters(const HandReaction& parameters) noexcept { p_ = parameters; }
  void reset() noexcept { *this = PlantReaction(p_); }
  /// The fingers feel `force` (N) for dt.
  void feel(const Vec3& force, double dt) noexcept;

  bool touched() const noexcept { return touched_; }
  double reflex() const noexcept { return reflex_; }      ///< share
  double firmness() const noexcept { return firmness_; }  ///< share

 private:
  HandReaction p_;
  bool began_ = false, touched_ = false;
  Vec3 usual_ = Vec3::Zero();  ///< N, slow mean
  double since_touch_ = 0, quiet_ = 0;
  double reflex_ = 0, firmness_ = 0;
};

}  // namespace trocar
