#include "app/session/setup/adjacent_organs.h"

#include <algorithm>
#include <cmath>

#include "scenarios/layout/height_field.h"

namespace trocar {
namespace {

constexpr double kStep = 0.004;    // m, raster of the look from above
constexpr double kMargin = 0.010;  // m round the region that has to stay free

bool covers_region(const TriangleSurface& adjacent_T, const HeightField& organ, const TargetLayout& layout) {
  const HeightField field(adjacent_T);
  const double half_x = layout.region_x_m / 2 + kMargin, half_y = layout.region_y_m / 2 + kMargin;
  for (double x = -half_x; x <= half_x; x += kStep)
    for (double y = -half_y; y <= half_y; y += kStep) {
      const auto other = field.top(x, y);
      if (!other) continue;
      const auto mine = organ.top(x, y);
      if (mine && other->position.z() > mine->position.z()) return true;
    }
  return false;
}

double difference(const ContactMaterial& a, const ContactMaterial& b) {
  return std::abs(a.stiffness_n_per_m - b.stiffness_n_per_m) + 1e3 * std::abs(a.mu_static - b.mu_static);
}

/// Index of the material; when the patch has no room for another one, that of the most alike.
std::int32_t material_index(const ContactMaterial& wanted, std::vector<ContactMaterial>& materials) {
  constexpr double kSame = 1e-9;
  const auto alike =
      std::min_element(materials.begin(), materials.end(), [&](const ContactMaterial& a, const ContactMaterial& b) {
        return difference(a, wanted) < difference(b, wanted);
      });
  const bool full = materials.size() + 1 >= static_cast<std::size_t>(kMaxPatchMaterials);
  if (alike != materials.end() && (full || difference(*alike, wanted) < kSame))
    return static_cast<std::int32_t>(alike - materials.begin()) + 1;
  materials.push_back(wanted);
  return static_cast<std::int32_t>(materials.size());
}

void append(const TriangleSurface& surface, std::int32_t material, AdjacentOrgans& all) {
  const auto first = static_cast<std::int32_t>(all.felt_T.vertices.size());
  all.felt_T.vertices.insert(all.felt_T.vertices.end(), surface.vertices.begin(), surface.vertices.end());
  for (const auto& [a, b, c] : surface.triangles) all.felt_T.triangles.push_back({first + a, first + b, first + c});
  all.triangle_material.insert(all.triangle_material.end(), surface.triangles.size(), material);
}

}  // namespace

AdjacentOrgans place_adjacent_organs(const Organ& organ, const TriangleSurface& organ_T, const Pose& X_TO,
                                     const Exercise& exercise, const MaterialTable& materials,
                                     const std::string& bound) {
  AdjacentOrgans all;
  append(organ_T, 0, all);
  const HeightField field(organ_T);
  for (const Organ& other : organ.adjacent) {
    if (other.name == bound) continue;
    SurfacePtr surface_T = still_surface(other.surface.transformed(X_TO));
    if (covers_region(*surface_T, field, exercise.layout)) {
      all.set_aside.push_back(other.name);
      continue;
    }
    append(*surface_T,
           material_index(materials.beside(exercise.surface, organ.material, other.material), all.materials), all);
    all.organs.push_back({other.name, other.material, std::move(surface_T)});
  }
  if (all.organs.empty()) all.felt_T = {}, all.triangle_material.clear();
  return all;
}

}  // namespace trocar
