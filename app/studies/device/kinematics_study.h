// `trocar study kinematics`: section 3.5 of the thesis done again, and what its single arm-plane sign leaves out.
//
// Samples S1 to S3 of table 3.6, a smooth joint trajectory home - S2 - S3 - home (figures 3.32 to 3.34), inverse along
// it, poses on both sides of the surface Z6 parallel to AO, all eight forward solutions, and the device in the three
// configurations (figure 3.35). The oracle of the forward model is the plant's own kinematics, which share no code with
// the controller's. Thread: any.
#pragma once

#include <vector>

#include "app/studies/study.h"
#include "haptics/quantities.h"

namespace trocar {

/// Joint angles of the trajectory at time t, rad: minimum jerk home (0 s) - S2 (1.5 s) - S3 (2.5 s) - home (4 s).
JointVector kinematic_trajectory(double t_s);
inline constexpr double kTrajectoryS = 4.0;

/// Poses drawn inside the limits, and how many of them lie beyond the surface Z6 parallel to AO.
struct BranchCount {
  int drawn = 0, beyond = 0;
  int ours_all = 0, ours_beyond = 0;      ///< recovered to 1e-9 rad, inside the limits
  int thesis_all = 0, thesis_beyond = 0;  ///< the same by the printed sign, on exact frames
};
BranchCount count_branches(int poses, std::uint64_t seed);

StudyResult kinematics_study(const StudyRequest& request);

}  // namespace trocar
