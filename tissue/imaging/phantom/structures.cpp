#include "tissue/imaging/phantom/structures.h"

#include <algorithm>
#include <cmath>

#include "tissue/imaging/phantom/phantom_labels.h"

namespace trocar::phantom {
namespace {

namespace label = phantom_label;

Box around(const Vec& centre, const Vec& radii) { return {centre - radii, centre + radii}; }

/// Slow grain of a parenchyma, a few HU: an organ is never quite even.
double mottle(const Vec& p, double depth) {
  return depth * std::sin(0.21 * p.x() + 0.13 * p.z()) * std::sin(0.19 * p.y() - 0.11 * p.x()) * std::cos(0.17 * p.z());
}

Structure gallbladder_structure(const Anatomy& a) {
  return {label::kGallbladder, Box(Vec(14, -8, -70), Vec(70, 80, 18)), [a](const Vec& p) { return gallbladder(p, a); },
          [](const Vec&, double d) { return d > -1.2 ? 55.0 : 8.0; }};
}

Structure liver_structure(const Anatomy& a) {
  return {label::kLiver, Box(Vec(-106, -86, -84), Vec(146, 102, 96)), [a](const Vec& p) { return liver(p, a); },
          [vessels = liver_vessels()](const Vec& p, double) { return 112 + mottle(p, 3) + vessels(p); }};
}

Structure kidney_structure(std::uint16_t label, double side) {
  const Vec centre(side * 62, -48, side > 0 ? -58 : -46);
  const auto inner = [side, centre](const Vec& p) {  // sinus fat and the collecting system
    const double sinus = ellipsoid(p, centre - Vec(side * 9, -2, 0), Vec(13, 8, 24));
    if (sinus < 0) return ellipsoid(p, centre - Vec(side * 12, -2, 0), Vec(10, 4.5, 15)) < 0 ? 12.0 : -85.0;
    return std::fmod(std::abs(sinus), 9) < 0.5 ? 178.0 : 186.0;
  };
  return {label, around(centre, Vec(27, 25, 54)), [side](const Vec& p) { return kidney(p, side); },
          [inner](const Vec& p, double d) { return d > -6 ? 192.0 : inner(p); }};
}

void add_solid_organs(std::vector<Structure>& to, const Anatomy& a) {
  to.push_back(measured(gallbladder_structure(a)));
  to.push_back(measured(liver_structure(a)));
  to.push_back(
      measured({label::kSpleen, around(Vec(-112, -26, 32), Vec(32, 55, 55)), [a](const Vec& p) { return spleen(p, a); },
                [](const Vec& p, double) { return 122 + mottle(p, 2); }}));
  to.push_back(measured(kidney_structure(label::kKidneyRight, 1)));
  to.push_back(measured(kidney_structure(label::kKidneyLeft, -1)));
}

/// Bile in a thin wall, or arterial blood in the portal phase.
double hilum_hounsfield(int label, double d) {
  const bool duct = label <= label::kBileDuct;
  if (duct) return d > -0.6 ? 60 : 8;
  return 158;
}

void add_hilum(Patient& patient, const Anatomy& a) {
  for (const NamedTube& each : hilum(a)) {
    const auto number = static_cast<std::uint16_t>(each.label);
    patient.structures.push_back(
        tube_structure(number, each.tube, [number](const Vec&, double d) { return hilum_hounsfield(number, d); }));
    patient.thin.push_back({number, each.tube});
  }
}

/// Fat that hides the hepatocystic triangle: round its plane and round the ducts and the artery.
Structure hilum_fat(const Anatomy& a) {
  const auto corner = hepatocystic_triangle(a);
  Box box;
  for (const Vec& each : corner) box.extend(each);
  const Vec reach = Vec::Constant(a.hilum_fat_mm);
  return {label::kHilumFat, Box(box.min() - reach, box.max() + reach),
          [corner, a](const Vec& p) { return triangle_distance(p, corner[0], corner[1], corner[2]) - a.hilum_fat_mm; },
          [](const Vec& p, double) { return -98 + mottle(p, 6); }};
}

Structure omentum(const Anatomy& a) {
  return {label::kOmentum, Box(Vec(-140, 20, -200), Vec(140, 110, -36)),
          [a](const Vec& p) {
            const double shelf = common(p.z() + 44 - 0.12 * p.x(), 28 - p.y(), 14);
            return common(shelf, -trunk(p, 30 + a.omentum_mm), 6);
          },
          [](const Vec& p, double) { return -96 + 9 * std::sin(0.5 * p.x()) * std::sin(0.43 * p.z() + 0.3 * p.y()); }};
}

}  // namespace

Structure measured(Structure structure) {
  structure.measured = true;
  return structure;
}

Box everywhere() { return {Vec::Constant(-1e6), Vec::Constant(1e6)}; }

std::function<double(const Vec&, double)> filled(double hounsfield) {
  return [hounsfield](const Vec&, double) { return hounsfield; };
}

Structure tube_structure(std::uint16_t label, Tube tube, std::function<double(const Vec&, double)> hounsfield) {
  Structure structure{label, tube.box(), {}, std::move(hounsfield)};
  structure.misses = [tube](const Box& box) { return tube.misses(box); };
  structure.distance = [tube = std::move(tube)](const Vec& p) { return tube.distance(p, 0.5); };
  return structure;
}

Patient draw_patient(const Anatomy& anatomy, double sheet_mm) {
  Patient patient;
  std::vector<Structure>& all = patient.structures;
  add_outside(all, anatomy, sheet_mm);
  add_solid_organs(all, anatomy);
  add_hilum(patient, anatomy);
  add_great_vessels(all);
  add_upper_gut(all, anatomy);
  add_bowel(all);
  all.push_back(measured({label::kHeart, Box(Vec(-110, -40, 60), Vec(60, 110, 200)), heart_mass,
                          [](const Vec&, double d) { return d > -9 ? 105.0 : 150.0; }}));
  add_wall(all, anatomy, sheet_mm);
  all.push_back(hilum_fat(anatomy));
  all.push_back(measured(omentum(anatomy)));
  all.push_back({label::kVisceralFat, everywhere(), [](const Vec&) { return -1.0; },
                 [](const Vec& p, double) { return -100 + mottle(p, 5); }});
  const double more = std::max(0.0, std::ceil(anatomy.outer_fat_mm / 10) * 10);  // in steps, so that grids stay alike
  patient.field = Box(Vec(-175 - more, -120 - more, -150), Vec(175 + more, 135 + more, 115));
  return patient;
}

}  // namespace trocar::phantom
