#include "haptics/control/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace trocar {
namespace {

constexpr double kRoom = 5e-4;      // m of travel that a list outlives
constexpr double kTurnRoom = 2e-3;  // m that the far end of an axis may turn meanwhile
// Of an axis of length L turned by up to kTurnRoom = x L a point beside the nearest one, q, is further away: for all s
// |q(s) - c| - s x L >= |q - c| sqrt(1 - x^2) - s_q x L. Axes too short for x <= 0.1 count as if they moved as a whole.
constexpr double kLongAxis = 10 * kTurnRoom;
constexpr float kBeside = 1.006f;  // > 1 / sqrt(1 - 0.1^2)

using Block = Eigen::Array<float, PatchBalls::kBlock, 1>;

Block lanes(const PatchBalls::Lane& lane, int first) { return Block::Map(lane.data() + first); }

/// A capsule in single precision, about the origin of the balls.
struct SiftedCapsule {
  Eigen::Vector3f front, axis;
  float per_length2, reach, turn_room;
  float least_share;  ///< 1: it moves as a whole

  /// Negative where a ball may come into reach.
  Block clearance(const PatchBalls& balls, int first) const {
    const Block x = lanes(balls.x, first) - front.x(), y = lanes(balls.y, first) - front.y(),
                z = lanes(balls.z, first) - front.z();
    const Block s = ((x * axis.x() + y * axis.y() + z * axis.z()) * per_length2).max(0.0f).min(1.0f);
    const Block dx = x - s * axis.x(), dy = y - s * axis.y(), dz = z - s * axis.z();
    const Block limit = kBeside * (lanes(balls.radius, first) + reach + turn_room * s.max(least_share));
    return dx * dx + dy * dy + dz * dz - limit * limit;
  }
};

bool is_long(const CapsuleAxis& ends) { return (ends.back - ends.front).squaredNorm() >= kLongAxis * kLongAxis; }

SiftedCapsule in_single(const PlacedTool& tool, int c, const Vec3& origin, double room) {
  const CapsuleAxis& ends = tool.axes[c];
  const Vec3 front = tool.tip + ends.front - origin, axis = ends.back - ends.front;
  const double length2 = axis.squaredNorm();
  const double rounding = double{PatchBalls::kRounding} * (front.lpNorm<1>() + axis.lpNorm<1>());
  return {.front = front.cast<float>(),
          .axis = axis.cast<float>(),
          .per_length2 = static_cast<float>(length2 > 0 ? 1 / length2 : 0),
          .reach = static_cast<float>(tool.capsules.at[c].radius_m + room + rounding),
          .turn_room = static_cast<float>(kTurnRoom),
          .least_share = is_long(ends) ? 0.0f : 1.0f};
}

bool in_order_of_patch(const NearPairs::Pair& l, const NearPairs::Pair& r) {
  return std::tie(l.index, l.capsule) < std::tie(r.index, r.capsule);
}

}  // namespace

void NearPairs::travel(double way_m) {
  for (double& front : front_) front += way_m;
}

void NearPairs::turn(const CapsuleAxes& from, const CapsuleAxes& to, double share) {
  for (int c = 0; c < kMaxCapsules; ++c) {
    front_[c] += share * (to[c].front - from[c].front).norm();
    back_[c] += share * (to[c].back - from[c].back).norm();
  }
}

bool NearPairs::keep_up(const PlacedTool& tool, const ContactPatch& patch, double slack_m) {
  if (serves(tool.capsules, patch.stamp, slack_m)) return false;
  list(tool, patch, slack_m);
  return true;
}

bool NearPairs::serves(const ToolCapsules& capsules, std::uint64_t stamp, double slack_m) const {
  if (stamp != stamp_ || !listed_) return false;
  double radii = 0;
  for (int c = 0; c < capsules.count; ++c) {
    if (front_[c] + slack_m > room_m_ || back_[c] > kTurnRoom) return false;
    radii += capsules.at[c].radius_m;
  }
  return radii == radii_m_;
}

void NearPairs::list(const PlacedTool& tool, const ContactPatch& patch, double slack_m) {
  listed_ = true;
  stamp_ = patch.stamp;
  radii_m_ = 0;
  for (int c = 0; c < tool.capsules.count; ++c) radii_m_ += tool.capsules.at[c].radius_m;
  front_.fill(0);
  back_.fill(0);
  room_m_ = slack_m + kRoom;
  if (patch.balls.count == patch.count && patch.balls.stamp == patch.stamp) {
    sift(tool, patch, patch.balls);
  } else {
    enclose(patch, balls_);
    sift(tool, patch, balls_);
  }
  ++work.lists;
  work.listed += count_;
}

int NearPairs::first_after(const Pair& done) const {
  const auto end = pair_.begin() + count_;
  return static_cast<int>(std::upper_bound(pair_.begin(), end, done, in_order_of_patch) - pair_.begin());
}

void NearPairs::sift(const PlacedTool& tool, const ContactPatch& patch, const PatchBalls& balls) {
  std::array<SiftedCapsule, kMaxCapsules> capsules;
  for (int c = 0; c < tool.capsules.count; ++c) capsules[c] = in_single(tool, c, balls.origin, room_m_);
  std::array<Block, kMaxCapsules> clearance;
  count_ = 0;
  for (int first = 0; first < patch.count; first += PatchBalls::kBlock) {
    bool any = false;
    for (int c = 0; c < tool.capsules.count; ++c) {
      clearance[c] = capsules[c].clearance(balls, first);
      any = any || clearance[c].minCoeff() <= 0;
    }
    if (!any) continue;
    for (int i = first; i < std::min(first + PatchBalls::kBlock, patch.count); ++i) {
      for (int c = 0; c < tool.capsules.count; ++c) {
        if (clearance[c][i - first] > 0) continue;
        Pair& pair = pair_[count_];
        pair.index = i;
        pair.capsule = static_cast<std::int8_t>(c);
        count_ += bound(tool, patch.triangle[i], pair);
      }
    }
  }
}

bool NearPairs::bound(const PlacedTool& tool, const PatchTriangle& triangle, Pair& pair) const {
  const CapsuleAxis& ends = tool.axes[pair.capsule];
  const double radius = tool.capsules.at[pair.capsule].radius_m;
  const TriangleBall ball = ball_round(triangle.vertex);
  const Vec3 from_front = ball.centre - tool.tip - ends.front, axis = ends.back - ends.front;
  const double length2 = axis.squaredNorm();
  const double s = length2 > 0 ? std::clamp(from_front.dot(axis) / length2, 0.0, 1.0) : 0;
  const Vec3 u = axis * s - from_front;
  const double distance = u.norm();
  double support = 0;
  for (const Vec3& v : triangle.vertex) support = std::max(support, u.dot(v - ball.centre));
  if (distance > 0) support /= distance;
  const double beside = ball.radius + radius + room_m_ + kTurnRoom;  // beyond, a point of the axis has too far to go
  pair.share = is_long(ends) ? std::min(1.0, s + beside / std::sqrt(length2)) : 1;
  pair.due = std::max(0.0, distance - support) - radius;
  return pair.due <= room_m_ + pair.share * kTurnRoom;
}

}  // namespace trocar
