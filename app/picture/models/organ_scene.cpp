#include "app/picture/models/organ_scene.h"

#include <string>

#include "tissue/theatre_frame.h"

namespace trocar {
namespace {

std::string credit_line(const Organ& organ) {
  std::string line = "Organ: " + organ.name;
  if (organ.synthetic && organ.credit.find("synthetic") == std::string::npos) line += " (synthetic)";
  if (!organ.credit.empty()) line += " \u00b7 " + organ.credit;
  if (!organ.licence.empty() && organ.credit.find(organ.licence) == std::string::npos)
    line += " \u00b7 licence: " + organ.licence;
  if (organ.cut_at_border) line += " \u00b7 cut at the image's border: the flat side is not anatomy";
  return line;
}

/// The abdominal wall round everything would hide what the picture is about.
bool surrounds(const Organ& other, const Organ& organ) {
  return other.surface.bounds().contains(organ.surface.bounds());
}

Eigen::AlignedBox3d whole_box(const Organ& organ) {
  Eigen::AlignedBox3d box = organ.surface.bounds();
  for (const Organ& other : organ.adjacent)
    if (!surrounds(other, organ)) box.extend(other.surface.bounds());
  return box;
}

/// Highest point of the surface near the vertical through `x`, `y`.
Vec3 crest(const TriangleSurface& surface, double x, double y, double within) {
  Vec3 best(x, y, surface.bounds().min().z());
  for (const Vec3& v : surface.vertices)
    if ((v.head<2>() - Eigen::Vector2d(x, y)).norm() < within && v.z() > best.z()) best = v;
  return best;
}

}  // namespace

SceneView organ_scene(const Organ& organ) {
  Pose to_centre;
  to_centre.R = theatre_from_ras();
  to_centre.p = -(to_centre.R * whole_box(organ).center());
  SceneView view;
  view.organ = still_surface(organ.surface.transformed(to_centre));
  view.material = organ.material;
  for (const Organ& other : organ.adjacent)
    if (!surrounds(other, organ))
      view.adjacent.push_back({still_surface(other.surface.transformed(to_centre)), other.material});
  Eigen::AlignedBox3d box = view.organ->bounds();
  for (const AdjacentOrganView& other : view.adjacent) box.extend(other.surface->bounds());
  const Vec3 size = box.sizes();
  const double reach = size.maxCoeff();
  view.camera.look_at_T = Vec3(0, 0, 0.1 * size.z());
  view.camera.eye_T = view.camera.look_at_T + Vec3(-0.10, -0.72, 0.62).normalized() * (0.95 * reach + 0.02);
  const Vec3 tip = crest(*view.organ, 0.22 * size.x(), 0.05 * size.y(), 0.08 * reach) + Vec3(0, 0, 0.008);
  const Vec3 z = -Vec3(0.65, -0.30, 0.70).normalized();
  view.X_TI.R.col(2) = z;
  view.X_TI.R.col(0) = z.cross(Vec3::UnitZ()).normalized();
  view.X_TI.R.col(1) = z.cross(view.X_TI.R.col(0));
  view.X_TI.p = tip;
  view.jaw_opening_m = 0.005;
  view.hud.credit = credit_line(organ);
  return view;
}

}  // namespace trocar
