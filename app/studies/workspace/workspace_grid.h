// Where the stylus can be: W' cut into cubes, each asked exactly, by inverse kinematics, what postures reach its
// middle.
//
// Four joints place the stylus, so one is spare: the arm plane may turn about OA. Each cube tries the plane in equal
// steps and keeps, of the best set that it belongs to, the posture with the largest det A. theta5 and theta6 turn the
// stylus on the spot and do not matter here. Sets, from the widest to the one a controller may use:
//   limits        theta1..theta4 within table 2.4, det A > 0
//   ring          the same, and the axis of link l1 inside the base ring: bodies without width
//   limits_clear  within the limits, and link l1 clear of base ring and legs (figure 2.12, link_clearance.h)
//   rules         8 deg from every limit and det A >= 0.30, the margins that exercises are proved with
//   rules_clear   both
// Frame W', metres. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "haptics/quantities.h"

namespace trocar {

enum class ReachSet : std::uint8_t { kLimits = 1, kLimitsClear = 2, kRules = 4, kRulesClear = 8, kRing = 16 };

inline constexpr double kRuleMargin_rad = 0.13962634015954636;  ///< 8 deg
inline constexpr double kRuleDetA = 0.30;

struct ReachCell {
  std::uint8_t sets = 0;                      ///< bits of ReachSet
  JointVector posture = JointVector::Zero();  ///< theta1..theta4 of the posture kept, theta5 -80 deg, theta6 0

  bool in(ReachSet set) const { return (sets & static_cast<std::uint8_t>(set)) != 0; }
};

class WorkspaceGrid {
 public:
  /// @param side of a cube, m. @param planes steps of the arm plane over a whole turn, even.
  WorkspaceGrid(double side, int planes);

  double side() const { return side_; }
  const std::array<int, 3>& size() const { return size_; }
  Vec3 centre(int i, int j, int k) const { return low_ + side_ * Vec3(i + 0.5, j + 0.5, k + 0.5); }
  /// Empty cell outside the grid.
  const ReachCell& cell(int i, int j, int k) const;
  const ReachCell& cell_at(const Vec3& p) const;
  /// Index along an axis of the layer that holds a coordinate.
  int layer(int axis, double coordinate) const;

  double volume_m3(ReachSet set) const;
  /// Greatest extent along x', y', z', m.
  Vec3 extent(ReachSet set) const;
  /// Edge of the largest upright cube that lies in the set, m.
  double largest_cube(ReachSet set) const;
  /// How much of a box (x', y', z', m) fits into the set in one place, upright, all edges scaled alike.
  double box_scale(ReachSet set, const Vec3& box) const;

  const std::vector<ReachCell>& cells() const { return cells_; }

 private:
  std::size_t index(int i, int j, int k) const { return static_cast<std::size_t>((k * size_[1] + j) * size_[0] + i); }
  std::vector<int> summed(ReachSet set) const;
  bool holds(const std::vector<int>& sum, const std::array<int, 3>& box) const;

  double side_;
  Vec3 low_;
  std::array<int, 3> size_;
  std::vector<ReachCell> cells_;
};

/// One cube's answer for a point in W'.
ReachCell reach_at(const Vec3& p, int planes);

}  // namespace trocar
