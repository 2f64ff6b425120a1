// Skin, subcutaneous fat, the muscles of the wall, bones, diaphragm and lungs.
#include <algorithm>
#include <cmath>

#include "tissue/imaging/phantom/phantom_labels.h"
#include "tissue/imaging/phantom/structures.h"

namespace trocar::phantom {
namespace {

namespace label = phantom_label;

constexpr double kFatDepthMm = 16, kWallDepthMm = 28, kVertebraMm = 36;

/// What lies outside an inset of the trunk, which is convex: a box whose corners lie within holds nothing of it.
Structure outside_of(std::uint16_t label, double inset, std::function<double(const Vec&, double)> hounsfield) {
  return {label,
          everywhere(),
          [inset](const Vec& p) { return -trunk(p, inset); },
          std::move(hounsfield),
          [inset](const Box& box) {
            for (const auto x : {box.min().x(), box.max().x()})
              for (const auto y : {box.min().y(), box.max().y()})
                if (trunk(Vec(x, y, 0), inset) >= 0) return false;
            return true;
          },
          0,
          0,
          true};
}

double within_vertebra(const Vec& p) { return std::abs(p.z() - kVertebraMm * std::round(p.z() / kVertebraMm)); }

double spine_hounsfield(const Vec& p, double d) {
  if (column(p, 0, -84, 7.5) < 0) return column(p, 0, -84, 5) < 0 ? 35 : 5;  // cord in its sac
  const bool body = p.y() > -78;
  if (body && within_vertebra(p) > 13.5) return 85;  // disc
  const bool shell = d > -2.5 || (body && within_vertebra(p) > 11.5);
  return shell ? 420 : 185 + 12 * std::sin(1.3 * p.x()) * std::sin(1.1 * p.z());
}

/// Arch and transverse processes.
double posterior_arch(const Vec& p) {
  const Vec folded(p.x(), p.y(), p.z() - kVertebraMm * std::round(p.z() / kVertebraMm));
  const double arch = pillar(p, 0, -85, 17, 10);
  return joined(arch, ellipsoid(folded, Vec(0, -82, 4), Vec(42, 5, 7)), 4);
}

/// Ribs slope down from back to front, one every 30 mm, as far as the costal arch.
double ribs(const Vec& p) {
  const double depth = -trunk(p, 22.0);
  const double slope = p.z() + 0.5 * (p.y() + 80);
  const double across = slope - 30 * std::round(slope / 30);
  const double bar = std::hypot(depth / 4.5, across / 6.5) - 1;
  const double arch = -30 + 0.55 * std::max(0.0, p.y() + 20) - p.z();
  return std::max({bar * 4.5, arch, p.y() - 84});
}

/// Floor of the chest: lung lies above it only, deeper in the back than in front.
double chest_floor(const Vec& p) { return p.z() - (22 + 0.3 * p.y()); }

/// The sheet that the diaphragm drapes over liver, spleen, stomach and heart; negative below.
double draped(const Vec& p, const Anatomy& a) {
  const double organs = joined(liver_lobes(p, a), spleen(p, a), 40);
  const double mediastinum = pillar(p, 2, -34, 42, 46);
  const double retroperitoneum = joined(mediastinum, ellipsoid(p, Vec(-52, -44, 6), Vec(50, 40, 62)), 20);
  return joined(joined(joined(organs, stomach_mass(p, organs + 30), 30), heart_mass(p), 20), retroperitoneum, 20) - 5;
}

constexpr double kFloorFilletMm = 12;

double lungs(const Vec& p, const Anatomy& a) {
  const double floor = -chest_floor(p);
  return floor > 2 * kFloorFilletMm ? floor : common(-draped(p, a), floor, kFloorFilletMm);
}

double wall_hounsfield(const Vec& p, double) {
  const double side = std::abs(p.x());
  if (p.y() > 30 && p.z() < 30 && (side < 2 || std::abs(side - 68 - 0.1 * p.y()) < 1.5))
    return -60;  // white and semilunar line
  const double depth = -trunk(p, kFatDepthMm);
  return side > 72 && std::abs(std::fmod(depth, 4) - 2) < 0.35 ? 5 : 58;  // three layers at the side
}

double back_muscles(const Vec& p) { return std::min(pillar(p, 32, -86, 30, 16), pillar(p, -32, -86, 30, 16)); }

Tube psoas(double side) {
  return Tube({{Vec(side * 25, -60, 14), 6},
               {Vec(side * 31, -58, -50), 13},
               {Vec(side * 39, -54, -105), 19},
               {Vec(side * 46, -48, -165), 23}});
}

}  // namespace

double heart_mass(const Vec& p) { return ellipsoid(p, Vec(-28, 38, 130), Vec(68, 52, 44)); }

void add_outside(std::vector<Structure>& to, const Anatomy& a, double sheet_mm) {
  to.push_back(outside_of(0, -a.outer_fat_mm, filled(-1000)));
  to.push_back(outside_of(label::kSkin, -a.outer_fat_mm + std::max(2.0, sheet_mm),
                          [a](const Vec& p, double) { return trunk(p, 2 - a.outer_fat_mm) > 0 ? 30.0 : -105.0; }));
  to.push_back(outside_of(label::kSubcutaneousFat, kFatDepthMm,
                          [](const Vec& p, double) { return -105 + 4 * std::sin(0.4 * p.x() + 0.3 * p.y()); }));
  to.push_back(
      {label::kVertebrae, Box(Vec(-24, -116, -1e6), Vec(24, -36, 1e6)), spine, spine_hounsfield, {}, 0, 0, true});
}

void add_wall(std::vector<Structure>& to, const Anatomy& a, double sheet_mm) {
  to.push_back({label::kVertebrae, Box(Vec(-46, -100, -1e6), Vec(46, -70, 1e6)), posterior_arch,
                [](const Vec& p, double d) { return column(p, 0, -84, 7.5) < 0 ? 20.0 : (d > -2 ? 420.0 : 200.0); }});
  Structure bars = outside_of(label::kRibs, 27.5, [](const Vec&, double d) { return d > -1.5 ? 480.0 : 180.0; });
  bars.distance = ribs;
  bars.measured = false;
  to.push_back(std::move(bars));
  to.push_back(outside_of(label::kMuscle, kWallDepthMm, wall_hounsfield));
  to.push_back({label::kMuscle, Box(Vec(-64, -104, -1e6), Vec(64, -68, 1e6)), back_muscles, filled(56)});
  for (const double side : {1.0, -1.0}) to.push_back(tube_structure(label::kMuscle, psoas(side), filled(60)));
  const double sheet = std::max(3.5, sheet_mm);
  Structure chest{label::kDiaphragm, Box(Vec(-150, -100, -30), Vec(150, 110, 1e6)),
                  [a, sheet](const Vec& p) { return lungs(p, a) - sheet; },
                  [sheet](const Vec& p, double d) {
                    if (d > -sheet) return 58.0;
                    return -850 + 25 * std::sin(0.22 * p.x()) * std::sin(0.2 * p.y()) * std::sin(0.25 * p.z());
                  }};
  chest.core_label = label::kLungs, chest.core_depth = sheet;
  to.push_back(measured(std::move(chest)));
}

}  // namespace trocar::phantom
