// Proof that the device can do what a level asks for: every start, target and waypoint of its boards, within reach, far
// enough from singularities, clear of its own links and of the organ, and with torque and heat to spare
// (docs/decisions/0004-placement.md).
//
// Postures are those of a hand that aims: direct mapping by the whole pose, through a port by tip and roll with the
// stylus at its reference swing. Theatre T, SI units. Thread: any; not for the tick.
#pragma once

#include <string>
#include <vector>

#include "app/session/setup/scene.h"
#include "app/session/setup/torque_budget.h"
#include "haptics/kinematics/device_geometry.h"
#include "scenarios/layout/shaft_room.h"

namespace trocar {

/// What every posture must have.
struct ReachRules {
  double joint_margin_rad = 8 * kDegree;
  double det_a = 0.30;
  double off_axis = 0.10;  ///< |AO x Z6| of unit vectors: Z6 parallel to AO is singular inside the limits
  double handle_to_port_m = Fulcrum::kNearest_m + 0.010;
  double shaft_gap_m = ShaftRoom::kLeastGap;  ///< between the organ and the instrument behind its tip
  double held_s = kHeldTime_s;  ///< the hard limit must be rendered this long from cold at the worst posture
};

/// One posture, or the worst of several, each number by itself.
struct Reach {
  bool reachable = true;
  double joint_margin_rad = 1e9, det_a = 1e9, off_axis = 1e9;
  double clearance_m = 1e9;       ///< of link l1 from base ring and legs
  double handle_to_port_m = 1e9;  ///< fulcrum only
  double shaft_gap_m = 1e9;       ///< touch only: between organ and instrument behind the tip (shaft_room.h)
  double torque_share = 0;        ///< largest |gravity + kappa x hard limit| of a joint, of what its motor can give
  double held_s = 1e9;            ///< until a winding fades while that torque is held, from cold; at most 60

  void add(const Reach& other);
  bool sound(const ReachRules& rules) const;
  /// First rule that is broken, in words; empty when sound.
  std::string broken(const ReachRules& rules) const;
};

/// @param F_I_T scene wrench at the hard limit.
Reach reach_of(const DeviceModel& device, const InstrumentMap& map, const Pose& X_TI, const Wrench& F_I_T);

/// Worst of all stops of a board at the hard limit. @param map with its force_scale.
Reach board_reach(const Exercise& exercise, const Board& board, const DeviceModel& device, const InstrumentMap& map);

struct BoardReach {
  int board = 0;
  Reach worst;
};

struct LevelProof {
  std::string exercise, level;
  bool fulcrum = false;
  double kappa = 1;
  OrganPlacement placement;  ///< touch only: how the organ was laid
  double room_share = 1;     ///< of the region, where kappa x the soft limit can be given
  double room_n = 0;         ///< scene force at the region's 5th percentile, kappa 1
  double hottest_c = 25;     ///< winding after the time limit at the mean load of the worst board
  std::vector<BoardReach> boards;
  Reach worst;
  bool sound = true;
  std::string why;  ///< first thing that is not sound
};

/// @param unseen boards that seeds from 0 on draw, beside the practice boards 0 to 19. @throws InputError when a board
/// cannot be laid.
LevelProof prove_level(const Exercise& exercise, const std::string& level, const Organ& organ, int unseen,
                       const ReachRules& rules = {});

/// Largest scene force along T's z that the device can give with the tip at each point of a grid over the region, N.
struct RoomMap {
  int columns = 0, rows = 0;
  std::vector<double> room_n;  ///< row by row from the smallest y; 0 out of reach
};
RoomMap room_map(const InstrumentMap& map, const DeviceModel& device, const TargetLayout& layout, int columns,
                 int rows);

}  // namespace trocar
