#include "app/session/setup/workspace_proof.h"

#include <algorithm>
#include <cmath>

#include "app/session/setup/force_scale.h"
#include "app/session/setup/placement.h"
#include "app/session/setup/torque_budget.h"
#include "haptics/control/gravity.h"
#include "haptics/control/motor_heat.h"
#include "haptics/device/transmission.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "haptics/kinematics/link_clearance.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/layout/board_numbers.h"

namespace trocar {
namespace {

constexpr double kProofHeatStep_s = 0.05;
constexpr double kContactShare = 0.5;  // of the time limit that is spent pressing [assumed]

/// Winding after the time limit at the load of a board: gravity always, the soft limit for kContactShare of the time.
double heat_of(const Scene& scene, const std::vector<Stop>& stops) {
  std::array<double, kArmJoints> square{};
  for (const Stop& stop : stops) {
    const Pose X_WS = scene.loop.map.stylus_pose(stop.X_TI);
    const auto q = inverse_within_limits(X_WS, home_angles());
    if (!q) continue;
    const ArmState arm = arm_state(*q);
    const JointVector gravity = gravity_torque(scene.loop.device, arm);
    const Vec3 force = scene.setup.exercise.soft_force_n * stop.normal_T;
    const JointVector pressing = gravity + torque_of(arm, scene.loop.map.stylus_wrench(X_WS, {force, Vec3::Zero()}));
    for (int i = 0; i < kArmJoints; ++i) {
      square[static_cast<std::size_t>(i)] +=
          ((1 - kContactShare) * std::pow(current_of(scene.loop.device, i, gravity[i]), 2) +
           kContactShare * std::pow(current_of(scene.loop.device, i, pressing[i]), 2)) /
          static_cast<double>(stops.size());
    }
  }
  double hottest = 0;
  for (const double mean : square) {
    MotorHeat heat;
    for (double t = 0; t < scene.level.time_limit_s; t += kProofHeatStep_s)
      heat.update(std::sqrt(mean), kProofHeatStep_s);
    hottest = std::max(hottest, heat.winding_c());
  }
  return hottest;
}

/// Least room behind the tip, of all discs.
double least_shaft_gap(const Scene& scene) {
  const ShaftRoom room(felt_surface(scene), scene.loop.tool, scene.loop.map);
  double least = ShaftRoom::kFarthest;
  for (const Target& target : scene.board.targets)
    least = std::min(least, room.gap_m(target.centre_T, target.normal_T));
  return least;
}

void judge(LevelProof& proof, const std::string& what) {
  if (what.empty()) return;
  if (proof.sound) proof.why = what;
  proof.sound = false;
}

}  // namespace

void Reach::add(const Reach& o) {
  reachable = reachable && o.reachable;
  joint_margin_rad = std::min(joint_margin_rad, o.joint_margin_rad);
  det_a = std::min(det_a, o.det_a);
  off_axis = std::min(off_axis, o.off_axis);
  clearance_m = std::min(clearance_m, o.clearance_m);
  handle_to_port_m = std::min(handle_to_port_m, o.handle_to_port_m);
  shaft_gap_m = std::min(shaft_gap_m, o.shaft_gap_m);
  torque_share = std::max(torque_share, o.torque_share);
  held_s = std::min(held_s, o.held_s);
}

std::string Reach::broken(const ReachRules& rules) const {
  if (!reachable) return "a posture is out of reach";
  if (joint_margin_rad < rules.joint_margin_rad) return "a joint comes too near to its limit";
  if (det_a < rules.det_a) return "the shoulder comes too near to its singularity";
  if (off_axis < rules.off_axis) return "the stylus axis comes too near to the line to O";
  if (clearance_m <= 0) return "link l1 meets the base ring or a leg";
  if (handle_to_port_m < rules.handle_to_port_m) return "the handle comes too near to the port";
  if (shaft_gap_m < rules.shaft_gap_m)
    return "the instrument's shaft would press on the organ where the tip is to touch";
  if (torque_share > 1) return "gravity and the hard limit ask more torque than a motor can give";
  if (held_s < rules.held_s) return "the hard limit overheats a motor at once";
  return "";
}

bool Reach::sound(const ReachRules& rules) const { return broken(rules).empty(); }

Reach reach_of(const DeviceModel& device, const InstrumentMap& map, const Pose& X_TI, const Wrench& F_I_T) {
  Reach reach;
  const Pose X_WS = map.stylus_pose(X_TI);
  const auto q = inverse_within_limits(X_WS, home_angles());
  reach.reachable = q.has_value();
  if (!q) return reach;
  const ArmState arm = arm_state(*q);
  reach.joint_margin_rad = joint_limit_margin(*q);
  reach.det_a = arm.det_a;
  reach.off_axis = arm.X_WS.p.normalized().cross(arm.X_WS.R.col(2)).norm();
  const Mat3 R_WP = rotation_W_Wprime() * arm.R_WPprime * rotation_P_Pprime().transpose();
  const LinkClearance clearance = link_clearance(q->head<3>(), R_WP);
  reach.clearance_m = std::min(clearance.ring_m, clearance.legs_m);
  if (map.fulcrum) reach.handle_to_port_m = map.fulcrum->distance_m(map.mapped_stylus(X_WS).p);
  const JointVector torque = gravity_torque(device, arm) + torque_of(arm, map.stylus_wrench(X_WS, F_I_T));
  for (int i = 0; i < kArmJoints; ++i) {
    const double most = max_joint_torque(device.transmission[static_cast<std::size_t>(i)]);
    reach.torque_share = std::max(reach.torque_share, std::abs(torque[i]) / most);
    reach.held_s = std::min(reach.held_s, seconds_until_fading(current_of(device, i, torque[i])));
  }
  return reach;
}

Reach board_reach(const Exercise& exercise, const Board& board, const DeviceModel& device, const InstrumentMap& map) {
  Reach worst;
  for (const Stop& stop : stops_of(exercise, board, map.instrument_pose(home_pose()).R))
    worst.add(reach_of(device, map, stop.X_TI, {exercise.hard_force_n * stop.normal_T, Vec3::Zero()}));
  return worst;
}

LevelProof prove_level(const Exercise& exercise, const std::string& level, const Organ& organ, int unseen,
                       const ReachRules& rules) {
  LevelProof proof;
  proof.exercise = exercise.id;
  proof.level = level;
  AttemptSetup setup;
  setup.exercise = exercise;
  setup.level = level;
  setup.weak_too = true;
  const bool exam = find_level(exercise, level).exam;
  for (int k = 0; k < kPracticeBoards + unseen; ++k) {
    setup.board = k < kPracticeBoards ? k : drawn_board(k - kPracticeBoards, exam);
    const Scene scene = build_scene(setup, organ, {"simulated", 1000, 16});
    setup.force_scale = scene.loop.map.force_scale;  // "auto" is the same for every board
    const std::vector<Stop> stops = stops_of(exercise, scene.board, scene.loop.map.instrument_pose(home_pose()).R);
    BoardReach board{setup.board, board_reach(exercise, scene.board, scene.loop.device, scene.loop.map)};
    if (kind_of(exercise).on_organ) {
      board.worst.shaft_gap_m = least_shaft_gap(scene);
      setup.placement = proof.placement = scene.placement;  // the same for every board of the level
    }
    const std::string why = board.worst.broken(rules);
    judge(proof, why.empty() ? "" : "board " + std::to_string(setup.board) + ": " + why);
    proof.worst.add(board.worst);
    proof.hottest_c = std::max(proof.hottest_c, heat_of(scene, stops));
    proof.fulcrum = scene.loop.map.fulcrum.has_value();
    proof.kappa = scene.loop.map.force_scale;
    proof.room_share = scene.room_share;
    proof.room_n = renderable_force_n(scene.loop.map, scene.loop.device, exercise.layout);
    proof.boards.push_back(std::move(board));
  }
  if (proof.hottest_c >= MotorHeatParameters{}.fade_c) judge(proof, "a motor overheats within the time limit");
  return proof;
}

RoomMap room_map(const InstrumentMap& map, const DeviceModel& device, const TargetLayout& layout, int columns,
                 int rows) {
  RoomMap out{columns, rows, {}};
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Vec3 tip_T(((i + 0.5) / columns - 0.5) * layout.region_x_m, ((j + 0.5) / rows - 0.5) * layout.region_y_m,
                       0);
      out.room_n.push_back(renderable_force_n(map, device, tip_T));
    }
  }
  return out;
}

}  // namespace trocar
