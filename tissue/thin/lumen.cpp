#include "tissue/thin/lumen.h"

#include <algorithm>

#include "tissue/thin/rod_section.h"

namespace trocar {

void Lumen::begin() {
  std::erase_if(closures_, [](const Closure& closure) { return closure.state == LumenState::kPressed; });
}

void Lumen::press(double from_m, double to_m, double flatness, double angle) {
  const double open = open_area(flatness);
  closures_.push_back({next_++, LumenState::kPressed, from_m, to_m, open, open_flow(flatness),
                       open > 0 ? 0 : options_.pressed_holds_pa, flatness, angle});
}

int Lumen::clip(double from_m, double to_m, double width_share, double holds_pa, double angle) {
  // What is left is a smaller lumen of the same form: its flow goes with the square of its area.
  const double open = 1 - std::clamp(width_share, 0.0, 1.0);
  closures_.push_back(
      {next_, LumenState::kClipped, from_m, to_m, open, open * open, open > 0 ? 0 : holds_pa, 1 - open, angle});
  return next_++;
}

void Lumen::open(int number) {
  std::erase_if(closures_, [number](const Closure& closure) { return closure.number == number; });
}

void Lumen::seal(double from_m, double to_m, double quality) {
  const double open = 1 - std::clamp(quality, 0.0, 1.0);
  closures_.push_back({next_++, LumenState::kSealed, from_m, to_m, open, open * open,
                       open > 0 ? 0 : options_.seal_holds_pa, 0.7 * (1 - open), 0});
}

void Lumen::nick(double arc_m, double share) { leaks_.push_back({arc_m, std::clamp(share, 0.0, 1.0)}); }

std::vector<LumenSegment> Lumen::segments(const ElasticRod& rod) const {
  std::vector<LumenSegment> found;
  for (std::size_t i = 0; i < rod.segments().size(); ++i) {
    const RodSegment& segment = rod.segments()[i];
    LumenSegment lumen;
    lumen.segment = i;
    lumen.radius_m = rod.options().inner_radius_m();
    lumen.length_m = (rod.nodes()[i + 1].position - rod.nodes()[i].position).norm();
    if (!segment.whole) {
      lumen.state = LumenState::kCut;
      lumen.open = lumen.flow = 0;
    } else if (lumen.radius_m <= 0) {
      lumen.open = lumen.flow = 0;  // a thread
    }
    for (const Closure& closure : closures_) {
      if (!segment.whole || closure.to_m <= segment.arc_from_m || closure.from_m >= segment.arc_to_m) continue;
      if (closure.open < lumen.open || (closure.open <= 0 && closure.holds_pa > lumen.holds_pa))
        lumen.state = closure.state;
      lumen.open = std::min(lumen.open, closure.open);
      lumen.flow = std::min(lumen.flow, closure.flow);
      lumen.holds_pa = std::max(lumen.holds_pa, closure.holds_pa);
    }
    found.push_back(lumen);
  }
  return found;
}

std::vector<LumenEnd> Lumen::ends(const ElasticRod& rod) const {
  std::vector<LumenEnd> found;
  for (std::size_t p = 0; p < rod.parts().size(); ++p) {
    const RodPart& part = rod.parts()[p];
    const auto at = [&](std::size_t node, const Vec3& outward, bool anchored) {
      found.push_back({p, node, rod.nodes()[node].arc_m, !anchored, rod.nodes()[node].position, outward});
    };
    at(part.first, -rod.segments()[part.first].frame.t, part.anchored_first);
    at(part.last, rod.segments()[part.last - 1].frame.t, part.anchored_last);
  }
  return found;
}

Lumen::Shape Lumen::shape_at(const ElasticRod& rod, double arc_m) const {
  Shape shape;
  const double runs_out = 2 * rod.options().outer_radius_m;
  for (const Closure& closure : closures_) {
    const double beside = std::max({closure.from_m - arc_m, arc_m - closure.to_m, 0.0});
    const double flatness = closure.flatness * std::max(0.0, 1 - beside / runs_out);
    if (flatness > shape.flatness) shape = {flatness, closure.angle};
  }
  return shape;
}

}  // namespace trocar
