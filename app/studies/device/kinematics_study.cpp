#include "app/studies/device/kinematics_study.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/device_bench/thesis_kinematics.h"
#include "app/studies/device/kinematics_drawings.h"
#include "haptics/device/device_model.h"
#include "haptics/device/plant/plant_kinematics.h"
#include "haptics/device/plant/plant_random.h"
#include "haptics/device/transmission.h"
#include "haptics/kinematics/forward_solutions.h"
#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "scenarios/hands/minimum_jerk.h"

namespace trocar {
namespace {

constexpr double kToS2 = 1.5, kToS3 = 2.5;  // s: samples 1500 and 2500 at 1 kHz, as in the thesis
constexpr double kSame = 1e-9;              // rad: the requirement on the round trip
constexpr double kOnSurface = 0.02;         // |AO x Z6| of unit vectors under which a pose counts as on the surface

Pose by_the_plant(const JointVector& q) {
  return stylus_pose(evaluate_kinematics(configuration_at(q), kLink1, kLink2));
}

/// Angle of the rotation nearest to Ra^T Rb; printed matrices are no exact rotations, the arctangent bears that.
double turn_deg(const Mat3& a, const Mat3& b) {
  const Mat3 T = a.transpose() * b;
  const Vec3 axis(T(2, 1) - T(1, 2), T(0, 2) - T(2, 0), T(1, 0) - T(0, 1));
  return std::atan2(axis.norm(), T.trace() - 1) / kDegree;
}

double largest_difference(const JointVector& a, const JointVector& b) {
  double largest = 0;
  for (int i = 0; i < kArmJoints; ++i) {
    largest = std::max(largest, std::abs(std::remainder(a[i] - b[i], 2 * std::numbers::pi)));
  }
  return largest;
}

void add_samples(StudyResult& study) {
  const auto& all = thesis::samples();
  for (const thesis::Sample& s : {all[1], all[2]}) {
    const double ours = 1e3 * (arm_state(s.q).X_WS.p - s.exact).norm();
    study.cases.push_back({std::string(s.name) + ": position off the exact one", "mm", ours,
                           1e3 * (s.printed.p - s.exact).norm(), "<= 0.0001", ours <= 1e-4,
                           "Stylus of table 3.6 against the position with exact constants, published to 0.0001 mm."});
  }
  double turned = 0, printed_turned = 0, table37 = 0, ours = 0;
  for (const thesis::Sample& s : all) {
    const Pose truth = by_the_plant(s.q);
    turned = std::max(turned, turn_deg(arm_state(s.q).X_WS.R, truth.R));
    printed_turned = std::max(printed_turned, turn_deg(s.printed.R, truth.R));
    table37 = std::max(table37, largest_difference(s.inverse, s.q));
    const auto found = inverse_within_limits(arm_state(s.q).X_WS, s.q);
    ours = std::max(ours, found ? largest_difference(*found, s.q) : 1e9);
  }
  study.cases.push_back({"S1 to S3: orientation off the plant's", "deg", turned, printed_turned, "<= 1e-9",
                         turned <= 1e-9,
                         "Largest turn between forward model and the plant's own kinematics; thesis: "
                         "the printed matrices of section 3.5."});
  study.cases.push_back({"S1 to S3: inverse against the angles put in", "deg", ours / kDegree, table37 / kDegree,
                         "<= 6e-8 (1e-9 rad)", ours <= kSame,
                         "Largest joint difference; thesis: table 3.7 against table 3.6."});
  const double jig = 1e3 * (arm_state(all[0].q).X_WS.p - home_pose().p).norm();
  study.cases.push_back({"S1: table 3.3's rounding at the tip",
                         "mm",
                         jig,
                         {},
                         "0.2 to 0.4 (reference: 0.3)",
                         jig > 0.2 && jig < 0.4,
                         "Home angles printed to two digits, against the jig's position."});
}

/// What running along the trajectory measures, at 1 kHz.
struct Along {
  double inverse = 0, thesis_printed = 0, plant_m = 0, residual = 0, counted_m = 0, roll_step = 0;
  int lost = 0;
};

Along run_along(double step_s) {
  const DeviceModel device;
  const double count = count_size(device.transmission[0]);
  const thesis::Frames printed = thesis::printed_frames();
  Along out;
  JointVector last = home_angles();
  for (int k = 0; k * step_s <= kTrajectoryS + 1e-9; ++k) {
    const JointVector q = kinematic_trajectory(k * step_s);
    const Pose X = arm_state(q).X_WS;
    out.plant_m = std::max(out.plant_m, (X.p - by_the_plant(q).p).norm());
    for (const ForwardSolution& s : forward_solutions(q)) out.residual = std::max(out.residual, s.residual);
    const auto found = inverse_within_limits(X, last);
    if (!found) {
      ++out.lost;
      continue;
    }
    out.inverse = std::max(out.inverse, (*found - q).cwiseAbs().maxCoeff());  // theta6 unwrapped: no remainder
    out.roll_step = std::max(out.roll_step, std::abs((*found)[5] - last[5]));
    last = *found;
    const JointVector theirs = thesis::inverse(thesis::forward(q, printed), printed);
    out.thesis_printed = std::max(out.thesis_printed, largest_difference(theirs, q));
    const JointVector counted = ((q - home_angles()) / count).array().floor().matrix() * count + home_angles();
    out.counted_m = std::max(out.counted_m, (arm_state(counted).X_WS.p - X.p).norm());
  }
  return out;
}

void add_trajectory(StudyResult& study, bool quick) {
  const Along along = run_along(quick ? 0.01 : 0.001);
  study.cases.push_back({"trajectory: inverse of forward", "deg", along.inverse / kDegree,
                         along.thesis_printed / kDegree, "<= 6e-8 (1e-9 rad), none lost",
                         along.inverse <= kSame && along.lost == 0,
                         "Largest joint difference along home - S2 - S3 - home, theta6 unwrapped; thesis: algorithm 1 "
                         "with its two-digit matrices both ways."});
  study.cases.push_back({"trajectory: position off the plant's",
                         "mm",
                         1e3 * along.plant_m,
                         {},
                         "<= 1e-9",
                         along.plant_m <= 1e-12,
                         "Forward model against the plant's own kinematics."});
  study.cases.push_back({"trajectory: tip as the encoders see it", "mm", 1e3 * along.counted_m, 0.02,
                         "<= 0.73 (a count in each of joints 1 to 4 at home)", along.counted_m <= 0.73e-3,
                         "Largest distance between the tip and the tip at whole counts; thesis: the linear precision "
                         "it claims."});
  study.cases.push_back({"trajectory: largest step of theta6",
                         "deg",
                         along.roll_step / kDegree,
                         {},
                         "< 5 (unwrapped: no jump by a turn)",
                         along.roll_step < 5 * kDegree,
                         "Between neighbouring samples, through 0 and down to -95 deg."});
  study.cases.push_back({"loop residual of all eight solutions",
                         "1",
                         along.residual,
                         {},
                         "<= 1e-14",
                         along.residual <= 1e-14,
                         "Largest |W_i . V_i| along the trajectory."});
}

void add_branches(StudyResult& study, const StudyRequest& request) {
  const BranchCount n = count_branches(request.quick ? 1000 : 20000, request.seed);
  const double share = double(n.ours_all) / n.drawn;
  study.cases.push_back({"poses recovered, of all", "share", share, double(n.thesis_all) / n.drawn, "1", share == 1,
                         std::to_string(n.drawn) + " poses drawn inside the limits; thesis: its single sign on exact "
                                                   "frames."});
  study.cases.push_back({"poses recovered beyond Z6 parallel to AO", "poses", double(n.ours_beyond),
                         double(n.thesis_beyond), ">= 30, and all of " + std::to_string(n.beyond),
                         n.ours_beyond >= 30 && n.ours_beyond == n.beyond,
                         "Poses whose arm plane has the other sign; inside the limits, to 1e-9 rad."});
}

void add_solutions(StudyResult& study) {
  const auto all = forward_solutions(thesis::example());
  const auto& printed = thesis::example_positions_W();
  int inside = 0, follow = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].trivial && all[i].ring_room_m > 0) ++inside;
    if ((rotation_W_Wprime() * all[i].X_WS.p - printed[i]).norm() < 5e-3) ++follow;
  }
  study.cases.push_back({"assembly modes that hang inside the base ring", "modes", double(inside), 1, "1 (figure 2.12)",
                         inside == 1 && all[0].ring_room_m > 0,
                         "Non-trivial solutions at (30, 20, 25) deg whose l1 does not cross the ring."});
  study.cases.push_back(
      {"forward solutions that close the loops", "of 8",
       double(std::count_if(all.begin(), all.end(), [](const ForwardSolution& s) { return s.residual < 1e-14; })),
       double(follow), "8", std::all_of(all.begin(), all.end(), [](const auto& s) { return s.residual < 1e-14; }),
       "At the example of section 2.5; thesis: printed positions within 5 mm of what its own R_i "
       "give."});
}

void add_kinematic_curves(StudyResult& study) {
  StudyCurves angles{
      "joint_angles", "Joint angles along the trajectory (figure 3.32)", "time, s", "angle, deg", {}, {}};
  StudyCurves tip{"tip_position",
                  "Stylus in W' along the trajectory (figure 3.33)",
                  "time, s",
                  "position, mm",
                  {},
                  {{"x'", {}}, {"y'", {}}, {"z'", {}}}};
  for (int i = 1; i <= kArmJoints; ++i) angles.series.push_back({"theta" + std::to_string(i), {}});
  for (int k = 0; k <= 400; ++k) {
    const double t = k * kTrajectoryS / 400;
    const JointVector q = kinematic_trajectory(t);
    const Vec3 p = arm_state(q).X_WS.p;
    angles.x.push_back(t);
    tip.x.push_back(t);
    for (int i = 0; i < kArmJoints; ++i) angles.series[static_cast<std::size_t>(i)].y.push_back(q[i] / kDegree);
    for (int i = 0; i < 3; ++i) tip.series[static_cast<std::size_t>(i)].y.push_back(1e3 * p[i]);
  }
  study.curves.push_back(angles);
  study.curves.push_back(tip);
}

}  // namespace

JointVector kinematic_trajectory(double t_s) {
  const auto& s = thesis::samples();
  const JointVector home = home_angles();
  if (t_s <= kToS2) return home + minimum_jerk(t_s / kToS2) * (s[1].q - home);
  if (t_s <= kToS3) return s[1].q + minimum_jerk((t_s - kToS2) / (kToS3 - kToS2)) * (s[2].q - s[1].q);
  return s[2].q + minimum_jerk((t_s - kToS3) / (kTrajectoryS - kToS3)) * (home - s[2].q);
}

BranchCount count_branches(int poses, std::uint64_t seed) {
  PlantRandom random(seed);
  BranchCount n;
  while (n.drawn < poses) {
    JointVector q;
    for (int i = 0; i < kArmJoints; ++i) {
      q[i] = kJointRange[i].low + random.unit() * (kJointRange[i].high - kJointRange[i].low);
    }
    const ArmState arm = arm_state(q);
    const Vec3 normal = (-arm.X_WS.p.normalized()).cross(arm.X_WS.R.col(2));
    if (arm.det_a < 0.05 || normal.norm() < kOnSurface || std::sin(-q[3]) < 0.03) continue;  // singular postures
    ++n.drawn;
    const bool beyond = normal.dot(arm.J_WS.col(3).tail<3>()) < 0;
    n.beyond += beyond;
    const InverseSolutions all = inverse_kinematics(arm.X_WS);
    bool ours = false;
    for (int i = 0; i < all.count; ++i) {
      ours = ours || (all.candidate[i].in_limits && largest_difference(all.candidate[i].q, q) < kSame);
    }
    const bool theirs = largest_difference(thesis::inverse(arm.X_WS, thesis::exact_frames()), q) < kSame;
    n.ours_all += ours;
    n.ours_beyond += ours && beyond;
    n.thesis_all += theirs;
    n.thesis_beyond += theirs && beyond;
  }
  return n;
}

StudyResult kinematics_study(const StudyRequest& request) {
  StudyResult study{"kinematics", "none: the kinematic models alone, against the plant's own", {}, {}, {}};
  add_samples(study);
  add_trajectory(study, request.quick);
  add_branches(study, request);
  add_solutions(study);
  add_kinematic_curves(study);
  study.files = kinematics_drawings();
  return study;
}

}  // namespace trocar
