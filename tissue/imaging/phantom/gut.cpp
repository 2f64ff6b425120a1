// Gullet, stomach, duodenum, pancreas, adrenals, large and small bowel.
#include <algorithm>
#include <cmath>

#include "tissue/imaging/phantom/phantom_labels.h"
#include "tissue/imaging/phantom/structures.h"

namespace trocar::phantom {
namespace {

namespace label = phantom_label;

constexpr double kSwirlMm = 3.6;

const Tube& stomach_tube() {
  static const Tube tube({{Vec(-70, -4, 52), 27},
                          {Vec(-71, 10, 28), 28},
                          {Vec(-68, 30, 4), 25},
                          {Vec(-54, 46, -18), 20},
                          {Vec(-30, 54, -28), 17},
                          {Vec(-8, 53, -28), 13},
                          {Vec(3, 49, -26), 8.5}});
  return tube;
}

Tube duodenum_tube() {
  return Tube({{Vec(4, 49, -26), 9.8},
               {Vec(11, 36, -31), 11.5},
               {Vec(18, 16, -38), 12},
               {Vec(29, 2, -46), 12},
               {Vec(35, -4, -62), 12},
               {Vec(35, -4, -84), 12},
               {Vec(26, -6, -100), 12},
               {Vec(4, -9, -105), 12},
               {Vec(-24, -9, -102), 11.5},
               {Vec(-40, -4, -84), 11.5},
               {Vec(-44, 4, -72), 11}});
}

Tube pancreas_tube() {
  return Tube({{Vec(13, -7, -72), 12},
               {Vec(13, -5, -54), 15},
               {Vec(0, 1, -42), 9.5},
               {Vec(-24, -2, -36), 11},
               {Vec(-52, -9, -29), 11},
               {Vec(-80, -14, -20), 9}});
}

Tube colon_tube() {
  Tube tube({{Vec(100, -22, -200), 19},
             {Vec(100, -18, -150), 19},
             {Vec(99, -8, -118), 18},
             {Vec(88, 16, -98), 17},
             {Vec(62, 48, -94), 16.5},
             {Vec(22, 66, -88), 16.5},
             {Vec(-20, 69, -79), 16},
             {Vec(-58, 62, -66), 16},
             {Vec(-88, 38, -48), 15.5},
             {Vec(-104, 8, -42), 15},
             {Vec(-112, -14, -64), 14},
             {Vec(-114, -24, -96), 13.5},
             {Vec(-112, -26, -150), 13},
             {Vec(-110, -26, -200), 13}});
  tube.ripple(0.07, 27);
  return tube;
}

/// Slow swirl that makes loops of straight rows. Its gradient stays under 0.45, so it never folds: rows that do not
/// touch before it do not touch after it.
Vec swirled(const Vec& p) {
  return p + kSwirlMm * Vec(std::sin(0.085 * p.z() + 0.05 * p.y()), std::sin(0.075 * p.x() + 1),
                            std::sin(0.08 * p.x() + 0.06 * p.y() + 2));
}

Tube small_bowel_tube() {
  constexpr double r = 11;
  std::vector<Knot> knots{{Vec(-42, 1, -77), 6}, {Vec(-45, 6, -73), 8}, {Vec(-52, 15, -74), r}};
  const auto row = [&](double y, double z, double from, double to) {
    for (int n = 0; n <= 5; ++n) knots.push_back({Vec(from + (to - from) * n / 5, y, z), r});
  };
  row(19, -75, -42, 50);
  row(19, -101, 54, -82);
  row(45, -105, -84, 8);  // under the transverse colon
  row(45, -131, 20, -78);
  row(19, -127, -86, 70);
  knots.push_back({Vec(80, 34, -128), r});
  knots.push_back({Vec(79, 54, -131), r});
  row(70, -135, 68, -62);
  knots.push_back({Vec(-74, 69, -150), r});
  knots.push_back({Vec(-76, 68, -185), r});
  return Tube(knots);
}

/// Wall round what the gut holds.
std::function<double(const Vec&, double)> gut(double wall_mm, double wall, double content, double gas_above_y) {
  return [=](const Vec& p, double d) {
    if (d > -wall_mm) return wall;
    return p.y() > gas_above_y ? -880.0 : content + 6 * std::sin(0.3 * p.x()) * std::sin(0.27 * p.z());
  };
}

void add_adrenals(std::vector<Structure>& to) {
  const auto limb = [&](std::uint16_t number, const Vec& from, const Vec& end) {
    to.push_back(
        tube_structure(number, Tube({{from, 4}, {0.5 * (from + end) + Vec(0, 1, 0), 3.6}, {end, 2.6}}), filled(72)));
  };
  limb(label::kAdrenalRight, Vec(37, -46, 14), Vec(45, -56, -2));
  limb(label::kAdrenalRight, Vec(37, -46, 14), Vec(33, -58, 0));
  limb(label::kAdrenalLeft, Vec(-40, -40, 12), Vec(-48, -46, 0));
  limb(label::kAdrenalLeft, Vec(-40, -40, 12), Vec(-33, -54, -2));
}

}  // namespace

double stomach_mass(const Vec& p, double reach) { return stomach_tube().distance(p, reach); }

void add_upper_gut(std::vector<Structure>& to, const Anatomy& a) {
  to.push_back(tube_structure(label::kDuodenum, duodenum_tube(), gut(2.2, 92, 22, 1e6)));
  const auto lobules = [](const Vec& p, double d) {  // fat between the lobules roughens the pancreas
    return d > -2 && std::sin(0.9 * p.x()) * std::sin(0.9 * p.z()) > 0.45 ? -10.0 : 98.0;
  };
  to.push_back(tube_structure(label::kPancreas, pancreas_tube(), lobules));
  const Tube gullet({{Vec(-13, -16, 125), 7.5},
                     {Vec(-16, -12, 96), 7.5},
                     {Vec(-26, -10, 72), 8},
                     {Vec(-46, -5, 58), 9},
                     {Vec(-58, 0, 54), 10}});
  to.push_back({label::kStomach, stomach_tube().box(),
                [a](const Vec& p) {
                  const double mass = stomach_tube().distance(p, 4);
                  return mass > 3 ? mass : without(mass, std::min(liver(p, a), spleen(p, a)) - 2, 6);
                },
                gut(3.2, 88, 18, 50), [](const Box& box) { return stomach_tube().misses(box); }});
  to.push_back(tube_structure(label::kOesophagus, gullet, filled(62)));
  add_adrenals(to);
}

void add_bowel(std::vector<Structure>& to) {
  const auto stool = [](const Vec& p, double d) {
    if (d > -2.2) return 85.0;
    const double crumbs = std::sin(0.31 * p.x() + 0.4 * p.y()) + std::sin(0.37 * p.y() - 0.29 * p.z()) +
                          std::sin(0.47 * p.z() + 0.23 * p.x()) + std::sin(0.61 * p.x() - 0.53 * p.y() + 0.2 * p.z());
    if (p.y() > 68) return -900.0;
    return crumbs > 2.1 ? -250.0 : 45 + 12 * crumbs;
  };
  const Tube colon = colon_tube();
  to.push_back(tube_structure(label::kColon, colon, stool));
  const Tube tube = small_bowel_tube();
  Box box = tube.box();
  box.extend(Vec(box.min() - Vec::Constant(8))), box.extend(Vec(box.max() + Vec::Constant(8)));
  to.push_back({label::kSmallBowel, box,
                [tube, colon](const Vec& p) {
                  const double d = tube.distance(swirled(p), 0.5);
                  return d < 0 ? std::max(d, 3 - colon.distance(p, 16)) : d;  // lies against the colon, not in it
                },
                gut(2, 98, 22, 78),
                [tube](const Box& region) {
                  const Vec swirl = Vec::Constant(kSwirlMm);
                  return tube.misses(Box(region.min() - swirl, region.max() + swirl));
                }});
}

}  // namespace trocar::phantom
