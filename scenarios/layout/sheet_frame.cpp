#include "scenarios/layout/sheet_frame.h"

#include <algorithm>

namespace trocar {
namespace {

constexpr double kFrameClear = 0.030;  // m over the highest place of the organ beneath (a choice)
constexpr double kFreeShare = 0.3;     // of the edge that is cut into, in its middle, without clips (a choice)
constexpr int kLookedAt = 12;          // places along either side, beneath which the organ is looked for
constexpr double kOnRim = 1e-9;        // m

}  // namespace

SheetFrame::SheetFrame(const SheetPlan& plan, const HeightField& organ_T)
    : corner_(plan.corner_m),
      along_(plan.along_m.normalized()),
      across_(-along_.y(), along_.x()),
      length_(plan.along_m.norm()),
      width_(plan.across_m) {
  double highest = -kFrameClear;
  for (int i = 0; i <= kLookedAt; ++i)
    for (int j = 0; j <= kLookedAt; ++j) {
      const Vec3 place = at({length_ * i / kLookedAt, width_ * j / kLookedAt});
      if (const auto top = organ_T.top(place.x(), place.y())) highest = std::max(highest, top->position.z());
    }
  height_ = highest + kFrameClear;
}

Vec3 SheetFrame::at(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d xy = corner_ + place.x() * along_ + place.y() * across_;
  return {xy.x(), xy.y(), height_};
}

bool SheetFrame::clipped(const Eigen::Vector2d& place) const {
  if (place.y() < kOnRim || place.x() < kOnRim || place.x() > length_ - kOnRim) return true;
  return place.y() > width_ - kOnRim && std::abs(place.x() - length_ / 2) > kFreeShare / 2 * length_;
}

}  // namespace trocar
