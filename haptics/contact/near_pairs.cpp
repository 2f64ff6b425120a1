#include "haptics/contact/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace trocar {
namespace {

constexpr double kRoom = 5e-4;         // m of travel that a list outlives
constexpr double kTurnRoom = 2e-3;     // m that the far end of an axis may turn meanwhile
constexpr double kChosenWay = 1.5e-4;  // m of a capsule's way that a choice from it outlives
// Of an axis of length L turned by up to kTurnRoom = x L a point beside the nearest one, q, is further away: for all s
// |q(s) - c| - s x L >= |q - c| sqrt(1 - x^2) - s_q x L. Axes too short for x <= 0.1 count as if they moved as a whole.
constexpr double kLongAxis = 10 * kTurnRoom;
constexpr float kBeside = 1.006f;  // > 1 / sqrt(1 - 0.1^2)
constexpr double kDigits = 1e-9;   // m: above what rounding takes from a bound

using Block = Eigen::Array<float, PatchBalls::kBlock, 1>;

Block lanes(const PatchBalls::Lane& lane, int first) { return Block::Map(lane.data() + first); }

bool in_order_of_patch(const NearPairs::Pair& l, const NearPairs::Pair& r) {
  return std::tie(l.index, l.capsule) < std::tie(r.index, r.capsule);
}

}  // namespace

/// A capsule in single precision, about the origin of the balls.
struct NearPairs::SiftedCapsule {
  Eigen::Vector3f front, axis;
  float reach, least_share;
  bool is_long;  ///< else it counts as if it moved as a whole
  double per_length, per_length2;

  SiftedCapsule() = default;
  SiftedCapsule(const PlacedTool& tool, int c, const Vec3& origin, double room) {
    const CapsuleAxis& ends = tool.axes[c];
    const Vec3 from = tool.tip + ends.front - origin, along = ends.back - ends.front;
    const double length2 = along.squaredNorm();
    const double rounding = double{PatchBalls::kRounding} * (from.lpNorm<1>() + along.lpNorm<1>());
    front = from.cast<float>();
    axis = along.cast<float>();
    reach = static_cast<float>(tool.capsules.at[c].radius_m + room + rounding);
    is_long = length2 >= kLongAxis * kLongAxis;
    least_share = is_long ? 0.0f : 1.0f;
    per_length2 = length2 > 0 ? 1 / length2 : 0;
    per_length = std::sqrt(per_length2);
  }

  /// Above 0 where a ball stays out of reach.
  Block clearance(const PatchBalls& balls, int first) const {
    const Block x = lanes(balls.x, first) - front.x(), y = lanes(balls.y, first) - front.y(),
                z = lanes(balls.z, first) - front.z();
    const Block s =
        ((x * axis.x() + y * axis.y() + z * axis.z()) * static_cast<float>(per_length2)).max(0.0f).min(1.0f);
    const Block dx = x - s * axis.x(), dy = y - s * axis.y(), dz = z - s * axis.z();
    const Block limit =
        kBeside * (lanes(balls.radius, first) + reach + static_cast<float>(kTurnRoom) * s.max(least_share));
    return dx * dx + dy * dy + dz * dz - limit * limit;
  }
};

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
  const bool listed = serves(tool.capsules, patch.stamp, slack_m);
  if (!listed) list(tool, patch, slack_m);
  if (listed && slack_m <= chosen_slack_m_ && choice_serves()) return false;
  choose(slack_m);
  return true;
}

bool NearPairs::choice_serves() const {
  for (int c = 0; c < kMaxCapsules; ++c) {
    if (front_[c] + furthest_share_[c] * back_[c] > chosen_until_[c]) return false;
  }
  return true;
}

void NearPairs::choose(double slack_m) {
  slack_m = chosen_slack_m_ = std::max(slack_m, chosen_slack_m_);  // the widest that has ever been asked for
  for (int c = 0; c < kMaxCapsules; ++c) {
    chosen_until_[c] = front_[c] + furthest_share_[c] * back_[c] + kChosenWay;
  }
  chosen_count_ = 0;
  for (int i = 0; i < listed_count_; ++i) {
    chosen_[chosen_count_] = static_cast<std::int16_t>(i);
    chosen_count_ += due(pair_[i], slack_m + kChosenWay);
  }
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
  work.listed += listed_count_;
}

int NearPairs::first_after(const Pair& done) const {
  const auto end = chosen_.begin() + chosen_count_;
  const auto behind = [this](const Pair& l, std::int16_t r) { return in_order_of_patch(l, pair_[r]); };
  return static_cast<int>(std::upper_bound(chosen_.begin(), end, done, behind) - chosen_.begin());
}

void NearPairs::sift(const PlacedTool& tool, const ContactPatch& patch, const PatchBalls& balls) {
  std::array<SiftedCapsule, kMaxCapsules> capsules;
  for (int c = 0; c < tool.capsules.count; ++c) {
    capsules[c] = SiftedCapsule(tool, c, balls.origin, room_m_);
  }
  std::array<Block, kMaxCapsules> clearance;
  listed_count_ = 0;
  furthest_share_.fill(0);
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
        Pair& pair = pair_[listed_count_];
        pair.index = i;
        pair.capsule = static_cast<std::int8_t>(c);
        if (!bound(tool, capsules[c], balls, patch.corners(i), pair)) continue;
        furthest_share_[c] = std::max(furthest_share_[c], pair.share);
        ++listed_count_;
      }
    }
  }
}

bool NearPairs::bound(const PlacedTool& tool, const SiftedCapsule& sifted, const PatchBalls& balls,
                      const std::array<Vec3, 3>& triangle, Pair& pair) const {
  const CapsuleAxis& ends = tool.axes[pair.capsule];
  const std::size_t i = static_cast<std::size_t>(pair.index);
  const double radius = tool.capsules.at[pair.capsule].radius_m;
  const Vec3 centre = balls.origin + Vec3(balls.x[i], balls.y[i], balls.z[i]);
  const Vec3 from_front = centre - tool.tip - ends.front, axis = ends.back - ends.front;
  const double s = std::clamp(from_front.dot(axis) * sifted.per_length2, 0.0, 1.0);
  const Vec3 u = axis * s - from_front;
  const double distance2 = u.squaredNorm();
  double support = 0;
  for (const Vec3& v : triangle) support = std::max(support, u.dot(v - centre));
  const double apart = distance2 > support ? (distance2 - support) / std::sqrt(distance2) : 0;
  const double beside =
      balls.radius[i] + radius + room_m_ + kTurnRoom;  // beyond, a point of the axis has too far to go
  pair.share = sifted.is_long ? std::min(1.0, s + beside * sifted.per_length) : 1;
  pair.due = apart - radius - kDigits;
  return pair.due <= room_m_ + pair.share * kTurnRoom;
}

}  // namespace trocar
