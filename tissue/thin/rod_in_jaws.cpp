#include "tissue/thin/rod_in_jaws.h"

#include <algorithm>
#include <cmath>

#include "tissue/thin/rod_section.h"

namespace trocar {
namespace {

constexpr double kLeastAcross = 0.2;  // cosine: a rod nearly in the plane is no wider than five times across

RodCrossing crossing_of(const ElasticRod& rod, double arc, const Vec3& point_I, const Vec3& tangent_I,
                        const JawSpace& jaws) {
  RodCrossing crossing;
  crossing.arc_m = arc;
  crossing.point_I = point_I;
  const double across = std::clamp(std::abs(tangent_I.x()), 0.0, 1.0);
  crossing.angle_rad = std::acos(across);
  crossing.half_width_m = rod_section(rod.options(), 1).half_width_m / std::max(across, kLeastAcross);
  const double near = point_I.z() - crossing.half_width_m, far = point_I.z() + crossing.half_width_m;
  const double between = std::min(far, 0.0) - std::max(near, -jaws.length_m);
  crossing.share_between = std::clamp(between / (far - near), 0.0, 1.0);
  crossing.tip_beyond_m = -far;
  return crossing;
}

int pieces_of(const RodSegment& segment, double spacing_m) {
  return std::max(1, static_cast<int>(std::ceil((segment.arc_to_m - segment.arc_from_m) / spacing_m)));
}

}  // namespace

std::vector<RodCrossing> rod_crossings(const ElasticRod& rod, const Pose& X_TI, const JawSpace& jaws) {
  std::vector<RodCrossing> found;
  const Pose X_IT = X_TI.inverse();
  const double aside = jaws.opening_m / 2 + rod.options().outer_radius_m;
  for (std::size_t i = 0; i < rod.segments().size(); ++i) {
    const RodSegment& segment = rod.segments()[i];
    if (!segment.whole) continue;
    const Vec3 a = X_IT * rod.nodes()[i].position, b = X_IT * rod.nodes()[i + 1].position;
    if ((a.x() < 0) == (b.x() < 0)) continue;
    const double share = a.x() / (a.x() - b.x());
    const Vec3 point = a + share * (b - a);
    if (std::abs(point.y()) > aside) continue;
    const double arc = segment.arc_from_m + share * (segment.arc_to_m - segment.arc_from_m);
    const RodCrossing crossing = crossing_of(rod, arc, point, (b - a).normalized(), jaws);
    if (crossing.share_between > 0) found.push_back(crossing);
  }
  return found;
}

std::vector<double> arcs_between(const ElasticRod& rod, const Pose& X_TI, const JawSpace& jaws, double reach_m,
                                 double spacing_m) {
  std::vector<double> found;
  const Pose X_IT = X_TI.inverse();
  const double round = rod.options().outer_radius_m + reach_m;
  for (std::size_t i = 0; i < rod.segments().size(); ++i) {
    const RodSegment& segment = rod.segments()[i];
    if (!segment.whole) continue;
    const Vec3 a = X_IT * rod.nodes()[i].position, b = X_IT * rod.nodes()[i + 1].position;
    const double length = segment.arc_to_m - segment.arc_from_m;
    const int pieces = pieces_of(segment, spacing_m);
    for (int k = 0; k < pieces; ++k) {
      const double share = (k + 0.5) / pieces;
      const Vec3 p = a + share * (b - a);
      if (std::abs(p.x()) < jaws.width_m / 2 + reach_m && std::abs(p.y()) < jaws.opening_m / 2 + round &&
          p.z() > -jaws.length_m && p.z() < reach_m)
        found.push_back(segment.arc_from_m + share * length);
    }
  }
  return found;
}

double length_between(const ElasticRod& rod, const Pose& X_TI, const JawSpace& jaws, double reach_m) {
  const Pose X_IT = X_TI.inverse();
  const double aside = jaws.opening_m / 2 + rod.options().outer_radius_m + reach_m;
  const Vec3 low(-jaws.width_m / 2 - reach_m, -aside, -jaws.length_m);
  const Vec3 high(jaws.width_m / 2 + reach_m, aside, reach_m);
  double length = 0;
  for (std::size_t i = 0; i < rod.segments().size(); ++i) {
    if (!rod.segments()[i].whole) continue;
    const Vec3 a = X_IT * rod.nodes()[i].position, edge = X_IT * rod.nodes()[i + 1].position - a;
    double from = 0, to = 1;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (std::abs(edge[axis]) < 1e-12) {
        if (a[axis] < low[axis] || a[axis] > high[axis]) to = 0;
        continue;
      }
      const double enter = (low[axis] - a[axis]) / edge[axis], leave = (high[axis] - a[axis]) / edge[axis];
      from = std::max(from, std::min(enter, leave));
      to = std::min(to, std::max(enter, leave));
    }
    length += std::max(0.0, to - from) * edge.norm();
  }
  return length;
}

bool overlaps(const ElasticRod& rod, const Pose& X_TI, const ToolCapsules& tool, double spacing_m) {
  const auto inside = [&](const Vec3& p_I) {
    for (int c = 0; c < tool.count; ++c) {
      const Capsule& capsule = tool.at[c];
      const Vec3 p_C = capsule.X_IC.inverse() * p_I;  // its axis runs from 0 to -length along z
      const Vec3 off = p_C - Vec3(0, 0, std::clamp(p_C.z(), -capsule.length_m, 0.0));
      if (off.norm() < capsule.radius_m + rod.options().outer_radius_m) return true;
    }
    return false;
  };
  const Pose X_IT = X_TI.inverse();
  for (std::size_t i = 0; i < rod.segments().size(); ++i) {
    const RodSegment& segment = rod.segments()[i];
    if (!segment.whole) continue;
    const Vec3 a = X_IT * rod.nodes()[i].position, b = X_IT * rod.nodes()[i + 1].position;
    const int pieces = pieces_of(segment, spacing_m);
    for (int k = 0; k <= pieces; ++k)
      if (inside(a + (static_cast<double>(k) / pieces) * (b - a))) return true;
  }
  return false;
}

double angle_in_rod(const ElasticRod& rod, double arc_m, const Vec3& direction_T) {
  const Vec3 in_rod = rod.frame_at(arc_m).transpose() * direction_T;
  return std::atan2(in_rod.y(), in_rod.x());
}

}  // namespace trocar
