#include "tissue/thin/rod_contact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr double kRingCompliance = 0.149;  // of P R^3 / (E I), a ring pressed along two lines (Roark's formulas)
constexpr double kDragStiffness = 0.8;     // of friction's spring over that of the dent (tissue.md 1.4)
constexpr double kNoDrag = 1e-6;           // N
constexpr double kLeastLoopStiffness = 1;  // N/m

bool carries_force(const SolvedContact& contact) {
  return contact.share > 0 && contact.force_T.allFinite() && contact.tool_T.allFinite() &&
         contact.normal_T.allFinite() &&
         std::all_of(contact.place.weight.begin(), contact.place.weight.end(),
                     [](double weight) { return std::isfinite(weight); });
}

}  // namespace

double ring_stiffness(const RodOptions& rod) {
  const double mean = rod.outer_radius_m - rod.wall_m / 2;
  const double plate = rod.young_pa / (1 - rod.poisson * rod.poisson) * std::pow(rod.wall_m, 3) / 12;
  return plate / (kRingCompliance * std::pow(mean, 3));
}

double dent_stiffness(const RodOptions& rod, double tool_radius_m) {
  if (rod.inner_radius_m() <= 0)
    return rod.young_pa / (1 - rod.poisson * rod.poisson) * std::numbers::pi / 4 * 2 * tool_radius_m;
  return ring_stiffness(rod) * 2 * (tool_radius_m + rod.outer_radius_m);
}

std::vector<RodSpring> rod_contacts(const SolvedContacts& contacts, std::int32_t first_triangle, const RodSurface& tube,
                                    double stiffness_n_per_m) {
  std::vector<RodSpring> pushes, drags;
  const SurfacePtr& surface = tube.surface();
  for (std::int32_t i = 0; i < contacts.count; ++i) {
    const SolvedContact& contact = contacts.at[static_cast<std::size_t>(i)];
    MaterialPoint place = contact.place;
    place.triangle -= first_triangle;
    if (place.triangle < 0 || place.triangle >= static_cast<std::int32_t>(surface->triangles.size()) ||
        !carries_force(contact))
      continue;
    const auto& [a, b, c] = surface->triangles[static_cast<std::size_t>(place.triangle)];
    const auto vertex = [&](std::int32_t v) { return surface->vertices[static_cast<std::size_t>(v)]; };
    const Vec3 point = interpolate(place.weight, {vertex(a), vertex(b), vertex(c)});
    const double arc = tube.arc_of(place), stiffness = contact.share * stiffness_n_per_m;
    pushes.push_back({arc, contact.normal_T, stiffness, contact.normal_T.dot(point - contact.tool_T), true, 0});
    const Vec3 drag = contact.force_T - contact.force_T.dot(contact.normal_T) * contact.normal_T;
    const double size = drag.norm();
    if (size < kNoDrag) continue;
    drags.push_back({arc, drag / size, kDragStiffness * stiffness, size / (kDragStiffness * stiffness), false, 0});
  }
  pushes.insert(pushes.end(), drags.begin(), drags.end());
  return pushes;
}

double loop_stiffness(const ElasticRod& rod, double arc_m, const Vec3& direction, double spring_n_per_m) {
  // The step's matrix has the spring in it: its compliance c = 1 / (K + k), and k in series with K is k (1 - k c).
  const double k = spring_n_per_m;
  return std::clamp(k * (1 - k * rod.compliance(arc_m, direction)), std::min(kLeastLoopStiffness, k), k);
}

}  // namespace trocar
