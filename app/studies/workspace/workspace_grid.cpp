#include "app/studies/workspace/workspace_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "haptics/kinematics/device_geometry.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "haptics/kinematics/link_clearance.h"
#include "haptics/kinematics/spherical_parallel.h"

namespace trocar {
namespace {

constexpr double kReach = kLink1 + kLink2;
constexpr double kGridTop = 0.20;  // m: nothing reaches higher within the limits
constexpr double kWristDeg = -80;  // of the posture kept: the middle of theta5's range
constexpr std::uint8_t bit(ReachSet set) { return static_cast<std::uint8_t>(set); }

double margin_of_first_four(const JointVector& q) {
  double margin = 1e9;
  for (int i = 0; i < 4; ++i) margin = std::min({margin, q[i] - kJointRange[i].low, kJointRange[i].high - q[i]});
  return margin;
}

/// Sets that a posture belongs to; 0 outside the limits.
std::uint8_t sets_of(const JointVector& q, double& det_a) {
  const double margin = margin_of_first_four(q);
  if (margin < 0) return 0;
  const Vec3 s = q.head<3>().array().sin(), c = q.head<3>().array().cos();
  det_a = s.prod() + c.prod();
  if (det_a <= 1e-9) return 0;
  std::uint8_t sets = bit(ReachSet::kLimits);
  const bool ruled = margin >= kRuleMargin_rad && det_a >= kRuleDetA;
  if (ruled) sets |= bit(ReachSet::kRules);
  const LinkClearance room = link_clearance(q.head<3>(), spherical_parallel(q.head<3>()).R_WP);
  if (room.ring_m + kLinkHalfWidth + kLegHalfWidth >= 0) sets |= bit(ReachSet::kRing);
  if (!room.clear()) return sets;
  sets |= bit(ReachSet::kLimitsClear);
  if (ruled) sets |= bit(ReachSet::kRulesClear);
  return sets;
}

/// Of two postures the one in the set nearer to use; a controller wants to be clear first, then within its rules.
int rank(std::uint8_t sets) {
  if (sets & bit(ReachSet::kRulesClear)) return 4;
  if (sets & bit(ReachSet::kLimitsClear)) return 3;
  if (sets & bit(ReachSet::kRules)) return 2;
  return sets ? 1 : 0;
}

}  // namespace

ReachCell reach_at(const Vec3& p, int planes) {
  ReachCell cell;
  const double reach = p.norm();
  if (reach > kReach || reach < 1e-3) return cell;
  const Vec3 out = p / reach, u = out.unitOrthogonal(), v = out.cross(u);
  int best_rank = 0;
  double best_det = 0;
  for (int k = 0; k < planes / 2; ++k) {  // each pose has both signs of the plane
    const double psi = 2 * std::numbers::pi * k / planes;
    const Vec3 normal = std::cos(psi) * u + std::sin(psi) * v;
    Pose X;
    X.p = p;
    X.R.col(2) = out.cross(normal);  // at right angles to OA in the plane
    X.R.col(0) = out;
    X.R.col(1) = X.R.col(2).cross(X.R.col(0));
    const InverseSolutions all = inverse_kinematics(X);
    for (int i = 0; i < all.count; ++i) {
      JointVector q = all.candidate[static_cast<std::size_t>(i)].q;
      double det_a = 0;
      const std::uint8_t sets = sets_of(q, det_a);
      cell.sets |= sets;
      if (rank(sets) < best_rank || (rank(sets) == best_rank && det_a <= best_det)) continue;
      best_rank = rank(sets);
      best_det = det_a;
      q[4] = kWristDeg * kDegree;
      q[5] = 0;
      cell.posture = q;
    }
  }
  return cell;
}

WorkspaceGrid::WorkspaceGrid(double side, int planes) : side_(side) {
  // A whole number of cubes about x' = 0 and y' = 0, an odd one: the planes through O are the middle of a layer.
  const int half = static_cast<int>(std::ceil(kReach / side - 0.5));
  const int below = static_cast<int>(std::ceil(kReach / side)), above = static_cast<int>(std::ceil(kGridTop / side));
  size_ = {2 * half + 1, 2 * half + 1, below + above};
  low_ = {-(half + 0.5) * side, -(half + 0.5) * side, -below * side};
  cells_.resize(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1] * size_[2]));
  for (int k = 0; k < size_[2]; ++k) {
    for (int j = 0; j < size_[1]; ++j) {
      for (int i = 0; i < size_[0]; ++i) cells_[index(i, j, k)] = reach_at(centre(i, j, k), planes);
    }
  }
}

const ReachCell& WorkspaceGrid::cell(int i, int j, int k) const {
  static const ReachCell outside;
  const bool inside = i >= 0 && j >= 0 && k >= 0 && i < size_[0] && j < size_[1] && k < size_[2];
  return inside ? cells_[index(i, j, k)] : outside;
}

int WorkspaceGrid::layer(int axis, double coordinate) const {
  return static_cast<int>(std::floor((coordinate - low_[axis]) / side_));
}

const ReachCell& WorkspaceGrid::cell_at(const Vec3& p) const {
  return cell(layer(0, p.x()), layer(1, p.y()), layer(2, p.z()));
}

double WorkspaceGrid::volume_m3(ReachSet set) const {
  const auto count = std::count_if(cells_.begin(), cells_.end(), [set](const ReachCell& c) { return c.in(set); });
  return static_cast<double>(count) * side_ * side_ * side_;
}

Vec3 WorkspaceGrid::extent(ReachSet set) const {
  Eigen::AlignedBox3d box;
  for (int k = 0; k < size_[2]; ++k) {
    for (int j = 0; j < size_[1]; ++j) {
      for (int i = 0; i < size_[0]; ++i) {
        if (cell(i, j, k).in(set)) box.extend(centre(i, j, k));
      }
    }
  }
  return box.isEmpty() ? Vec3::Zero() : Vec3(box.sizes() + Vec3::Constant(side_));
}

/// Cells of the set in [0, i) x [0, j) x [0, k).
std::vector<int> WorkspaceGrid::summed(ReachSet set) const {
  const auto [nx, ny, nz] = size_;
  std::vector<int> sum(static_cast<std::size_t>(nx + 1) * static_cast<std::size_t>((ny + 1) * (nz + 1)));
  const auto at = [&, stride = nx + 1, rows = ny + 1](int i, int j, int k) -> int& {
    return sum[static_cast<std::size_t>((k * rows + j) * stride + i)];
  };
  for (int k = 1; k <= nz; ++k) {
    for (int j = 1; j <= ny; ++j) {
      for (int i = 1; i <= nx; ++i) {
        at(i, j, k) = cell(i - 1, j - 1, k - 1).in(set) + at(i - 1, j, k) + at(i, j - 1, k) + at(i, j, k - 1) -
                      at(i - 1, j - 1, k) - at(i - 1, j, k - 1) - at(i, j - 1, k - 1) + at(i - 1, j - 1, k - 1);
      }
    }
  }
  return sum;
}

bool WorkspaceGrid::holds(const std::vector<int>& sum, const std::array<int, 3>& box) const {
  const auto at = [&](int i, int j, int k) {
    return sum[static_cast<std::size_t>((k * (size_[1] + 1) + j) * (size_[0] + 1) + i)];
  };
  const auto [a, b, c] = box;
  for (int k = 0; k + c <= size_[2]; ++k) {
    for (int j = 0; j + b <= size_[1]; ++j) {
      for (int i = 0; i + a <= size_[0]; ++i) {
        const int filled = at(i + a, j + b, k + c) - at(i, j + b, k + c) - at(i + a, j, k + c) - at(i + a, j + b, k) +
                           at(i, j, k + c) + at(i, j + b, k) + at(i + a, j, k) - at(i, j, k);
        if (filled == a * b * c) return true;
      }
    }
  }
  return false;
}

double WorkspaceGrid::largest_cube(ReachSet set) const {
  const std::vector<int> sum = summed(set);
  int edge = 0;
  while (edge < size_[2] && holds(sum, {edge + 1, edge + 1, edge + 1})) ++edge;
  return edge * side_;
}

double WorkspaceGrid::box_scale(ReachSet set, const Vec3& box) const {
  const std::vector<int> sum = summed(set);
  constexpr double kStep = 0.02;
  double scale = 0;
  for (double s = kStep; s <= 2; s += kStep) {
    std::array<int, 3> n{};
    for (int axis = 0; axis < 3; ++axis) {
      n[static_cast<std::size_t>(axis)] = std::max(1, static_cast<int>(std::ceil(s * box[axis] / side_ - 1e-9)));
    }
    if (!holds(sum, n)) break;
    scale = s;
  }
  return scale;
}

}  // namespace trocar
