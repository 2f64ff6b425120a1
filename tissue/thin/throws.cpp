#include "tissue/thin/throws.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kWrapped = 0.7, kWrapOff = 0.35;  // turns from which a limb counts as wound, and below which as off
constexpr double kShaftSeen = 0.15;                // m of the shaft behind the tip
constexpr double kBeyondTip = 0.002;               // m before the tip
constexpr double kNearShaft = 0.02;                // m from its axis
constexpr double kOneThrow = 0.35;                 // linking that makes a throw
constexpr double kHalfTurn = 0.5;                  // of linking
constexpr double kQuiet = 0.2;                     // of the peak by length, below which throws are apart
constexpr double kShortestPart = 1e-6;             // m of a segment
constexpr std::size_t kThrowGap = 2;               // segments without density within a throw: some have no length
constexpr double kStraightLimb = 0.5;              // share of the other limb's bend, below which a limb went straight

/// Solid angle share of two segments, signed: what they add to the linking number.
double linking_of(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
  const Vec3 r13 = b0 - a0, r14 = b1 - a0, r23 = b0 - a1, r24 = b1 - a1;
  std::array<Vec3, 4> n{r13.cross(r14), r14.cross(r24), r24.cross(r23), r23.cross(r13)};
  for (Vec3& side : n) {
    const double size = side.norm();
    if (size < 1e-18) return 0;
    side /= size;
  }
  const auto angle = [&](std::size_t i, std::size_t j) { return std::asin(std::clamp(n[i].dot(n[j]), -1.0, 1.0)); };
  const double sum = angle(0, 1) + angle(1, 2) + angle(2, 3) + angle(3, 0);
  const double side = (b1 - b0).cross(a1 - a0).dot(r13);
  return side == 0 ? 0 : std::copysign(sum, side) / (4 * std::numbers::pi);
}

/// How much a line turns between two of its points, rad.
double bend_between(std::span<const Vec3> line, std::size_t from, std::size_t to) {
  double sum = 0;
  for (std::size_t i = std::max<std::size_t>(1, from); i < std::min(to, line.size() - 1); ++i) {
    const Vec3 before = line[i] - line[i - 1], behind = line[i + 1] - line[i];
    sum += std::atan2(before.cross(behind).norm(), before.dot(behind));
  }
  return sum;
}

/// Runs of one sign whose linking by length stands out.
struct ThrowRun {
  std::size_t from = 0, to = 0;
  double linking = 0;
};
std::vector<ThrowRun> throw_runs(std::span<const Vec3> line, std::span<const Vec3> other) {
  const std::vector<double> part = linking(line, other);
  std::vector<double> density;
  for (std::size_t i = 0; i < part.size(); ++i)
    density.push_back(std::abs(part[i]) / std::max((line[i + 1] - line[i]).norm(), kShortestPart));
  const double peak = density.empty() ? 0 : *std::max_element(density.begin(), density.end());
  std::vector<ThrowRun> runs;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (density[i] <= kQuiet * peak) continue;
    const bool same = !runs.empty() && i <= runs.back().to + kThrowGap && (runs.back().linking > 0) == (part[i] > 0);
    if (!same) runs.push_back({i, i, 0});
    runs.back().to = i + 1;
    runs.back().linking += part[i];
  }
  std::erase_if(runs, [](const ThrowRun& run) { return std::abs(run.linking) < kOneThrow; });
  return runs;
}

}  // namespace

KnotKind knot_kind(std::span<const Throw> throws) {
  if (throws.empty()) return KnotKind::kNone;
  if (throws.size() == 1) return throws[0].hitch ? KnotKind::kSlip : KnotKind::kHalfKnot;
  bool alternate = true;
  for (std::size_t i = 0; i < throws.size(); ++i) {
    if (throws[i].hitch) return KnotKind::kSlip;
    alternate = alternate && (i == 0 || throws[i].sense != throws[i - 1].sense);
  }
  if (!alternate) return KnotKind::kGranny;
  return throws[0].turns > 1 ? KnotKind::kSurgeons : KnotKind::kSquare;
}

const char* knot_name(KnotKind kind) {
  switch (kind) {
    case KnotKind::kNone:
      return "none";
    case KnotKind::kHalfKnot:
      return "half knot";
    case KnotKind::kSquare:
      return "square knot";
    case KnotKind::kSurgeons:
      return "surgeon's knot";
    case KnotKind::kGranny:
      return "granny knot";
    case KnotKind::kSlip:
      return "slip knot";
  }
  return "none";
}

double holding_force(std::span<const Throw> throws, const KnotHold& hold) {
  double sum = 0;
  for (std::size_t i = 0; i < throws.size(); ++i) {
    if (throws[i].hitch)
      sum += hold.hitch_n;
    else if (i == 0)
      sum += throws[i].turns > 1 ? hold.double_first_n : hold.first_n;
    else
      sum += throws[i].sense != throws[i - 1].sense ? hold.square_n : hold.granny_n;
  }
  return sum;
}

double turns_about(std::span<const Vec3> line_T, const Pose& X_TI, double from_z, double to_z, double within_m) {
  const Pose X_IT = X_TI.inverse();
  double sum = 0;
  std::optional<double> before;
  for (const Vec3& place : line_T) {
    const Vec3 p = X_IT * place;
    if (p.z() < from_z || p.z() > to_z || std::hypot(p.x(), p.y()) > within_m) {
      before.reset();
      continue;
    }
    const double angle = std::atan2(p.y(), p.x());
    if (before) sum += std::remainder(angle - *before, 2 * std::numbers::pi);
    before = angle;
  }
  return sum / (2 * std::numbers::pi);
}

std::vector<double> linking(std::span<const Vec3> a, std::span<const Vec3> b) {
  std::vector<double> out(a.size() > 1 ? a.size() - 1 : 0, 0.0);
  for (std::size_t i = 0; i < out.size(); ++i)
    for (std::size_t j = 0; j + 1 < b.size(); ++j) out[i] += linking_of(a[i], a[i + 1], b[j], b[j + 1]);
  return out;
}

std::vector<Throw> read_throws(std::span<const Vec3> a, std::span<const Vec3> b) {
  const std::vector<ThrowRun> of_a = throw_runs(a, b), of_b = throw_runs(b, a);
  std::vector<Throw> throws;
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    const double size = std::abs(of_a[i].linking);
    // Each limb goes on where the other came from: half a turn more than it was led round.
    Throw next{.turns = std::max(1, static_cast<int>(std::lround(size - kHalfTurn))),
               .sense = of_a[i].linking > 0 ? 1 : -1};
    // The same throw on the other limb, by order.
    if (of_b.size() == of_a.size()) {
      const double bend_a = bend_between(a, of_a[i].from, of_a[i].to + 1);
      const double bend_b = bend_between(b, of_b[i].from, of_b[i].to + 1);
      next.hitch = std::min(bend_a, bend_b) < kStraightLimb * std::max(bend_a, bend_b);
    }
    throws.push_back(next);
  }
  return throws;
}

void ThrowWatch::reset() { *this = {}; }

std::optional<Throw> ThrowWatch::step(const Seen& seen) {
  const auto turns = [&](Limb limb) {
    return turns_about(limb == Limb::kLong ? seen.long_T : seen.tail_T, seen.X_TI, -kShaftSeen, kBeyondTip, kNearShaft);
  };
  if (caught_) {
    turns_ = turns(wound_);
    if (!seen.held || *seen.held == wound_) {
      caught_ = false;  // let go with the turns still on: nothing has been drawn through
      return std::nullopt;
    }
    if (std::abs(turns_) > kWrapOff) return std::nullopt;
    caught_ = false;
    return next_;
  }
  const double of_long = turns(Limb::kLong), of_tail = turns(Limb::kTail);
  const bool by_long = seen.held ? *seen.held == Limb::kTail : std::abs(of_long) >= std::abs(of_tail);
  turns_ = by_long ? of_long : of_tail;
  if (!seen.held || std::abs(turns_) < kWrapped) return std::nullopt;
  caught_ = true;
  wound_ = by_long ? Limb::kLong : Limb::kTail;
  // Drawn back through the turns, what is held runs outwards against the shaft's direction.
  next_ = {.turns = std::max(1, static_cast<int>(std::lround(std::abs(turns_)))), .sense = turns_ > 0 ? -1 : 1};
  return std::nullopt;
}

}  // namespace trocar
