// A ring through which a rod slides: a hole in tissue, a knot.
//
// A place of the rod is held in the ring by three springs of the rod's step. It slides along when the tensions on both
// sides differ by more than friction: T+ - T- of what pulls on the ring, whatever corner the rod makes there, since
// f = T+ t+ - T- t- gives f . (t+ + t-) = (T+ - T-)(1 + t+ . t-). Friction is a limit of the ring's own, and mu times
// what presses across. T, SI. Thread: tissue task; pure.
#pragma once

#include <span>
#include <vector>

#include "tissue/solid/soft_solid.h"
#include "tissue/thin/elastic_rod.h"

namespace trocar {

struct RodRing {
  double arc_m = 0;             ///< of the rod, in the ring
  double foreseen_m = 0;        ///< how far that has gone ahead of what friction allows
  Vec3 force_T = Vec3::Zero();  ///< of the rod on the ring in the last step, N
  double slid_m = 0;            ///< in the last step, towards greater arcs

  /// Before the rod's step. @param at_T where the ring is
  void add_springs(const ElasticRod& rod, const Vec3& at_T, double stiffness_n_per_m, std::vector<RodSpring>& springs);
  /// After it: the force. @param springs the three that it added
  void take(std::span<const RodSpring> springs);
  /// The same on the solid that has the ring, for the solid's step: the force where the ring is, and its stiffness
  /// within the step. Neither foresees where the other goes: two rings on one taut rod would shake each other loose.
  void add_loads(const ElasticRod& rod, const NodeShares& place, double stiffness_n_per_m,
                 std::vector<SoftSpring>& springs) const;
  /// Last: it slides. @param from_m, to_m between which its arc stays
  void settle(const ElasticRod& rod, double stiffness_n_per_m, double limit_n, double mu, double from_m, double to_m);
};

}  // namespace trocar
