// Minimum-jerk reaching (Flash and Hogan, J Neurosci 5:1688, 1985) and the reach of a surgeon: withdraw, cross, come
// down, each a minimum-jerk movement, overlapping in time. Frame T, m, s.
#pragma once

#include "haptics/quantities.h"
#include "scenarios/hands/hand_random.h"
#include "scenarios/hands/hand_script.h"

namespace trocar {

/// 10 s^3 - 15 s^4 + 6 s^5, 0 before s = 0, 1 after s = 1.
double minimum_jerk(double s);

/// Movement time of a reach: k (0.12 + 0.11 log2(2 D / W + 1)) s, finite where nothing is asked for (D = W = 0).
double reach_time_s(double distance_m, double width_m, double speed_factor);

class ReachPlan {
 public:
  struct Shape {
    double lift_m = 0;          ///< withdrawal along +z, undone at the end
    Vec3 bulge = Vec3::Zero();  ///< sideways deviation at half way, m
    double lift_time_s = 0;     ///< up, and again down; 0 with lift_m = 0
    double travel_time_s = 0.1;
    double sunk_m = 0;  ///< how deep the start lies under the surface: given up while withdrawing
  };
  ReachPlan() = default;
  ReachPlan(const Vec3& from, const Vec3& to, const Shape& shape);
  Vec3 at(double t_s) const;
  double duration_s() const { return duration_s_; }

 private:
  Vec3 from_ = Vec3::Zero(), to_ = Vec3::Zero();
  Shape shape_;
  double travel_start_s_ = 0, descent_start_s_ = 0, duration_s_ = 0;
};

/// A reach as a person makes it: on a bow, and to about where it should end. @param way that the seen tip has to go
/// @param width_m of what is reached for. @param least_s that it takes at least.
ReachPlan aimed_reach(const Vec3& from_T, const Vec3& way, double width_m, double least_s, const HandSkill& skill,
                      HandRandom& random);

}  // namespace trocar
