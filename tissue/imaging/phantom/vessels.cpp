// Aorta, vena cava, the portal vein and its roots, and what the contrast shows within the liver.
#include <cmath>

#include "tissue/imaging/phantom/phantom_labels.h"
#include "tissue/imaging/phantom/structures.h"

namespace trocar::phantom {
namespace {

namespace label = phantom_label;

double aorta(const Vec& p) { return column(p, -14, -32, 9.5); }

Tube left_renal_vein() {
  return Tube({{Vec(20, -30, -60), 4},
               {Vec(-2, -18, -62), 4},
               {Vec(-16, -18, -62), 4},
               {Vec(-34, -36, -55), 4.5},
               {Vec(-42, -42, -50), 4}});
}
Tube right_renal_vein() { return Tube({{Vec(26, -38, -54), 4.5}, {Vec(42, -43, -58), 4.5}}); }

Tube portal_trunk() {
  return Tube({{Vec(-2, -11, -46), 6.5},
               {Vec(0, -15, -22), 6.3},
               {Vec(0, -14.5, 0), 6.3},
               {Vec(2, -13.5, 12), 6},
               {Vec(9, -10, 23), 5.5},
               {Vec(18, -8, 32), 5}});
}
Tube splenic_vein() {
  return Tube({{Vec(-2, -11, -46), 4.5},
               {Vec(-24, -12, -38), 4.2},
               {Vec(-52, -19, -29), 4},
               {Vec(-80, -22, -16), 3.6},
               {Vec(-96, -24, -2), 3.2}});
}
Tube mesenteric_vein() { return Tube({{Vec(-2, -11, -46), 5.5}, {Vec(-2, -5, -66), 5.2}, {Vec(-1, 2, -88), 4.8}}); }

/// Three hepatic veins run to the vena cava under the diaphragm; the portal branches fan out from the hilum.
std::vector<Tube> branches() {
  const Knot right{Vec(36, 2, 36), 4.6}, left{Vec(-8, 14, 40), 3.6};
  const auto fork = [](const Knot& from, const Vec& mid, const Vec& end) {
    return Tube({from, {mid, 2.6}, {end, 1.2}});
  };
  return {Tube({{Vec(24, -28, 74), 5}, {Vec(48, -14, 62), 4.4}, {Vec(82, -4, 36), 3.2}, {Vec(104, 2, 2), 1.6}}),
          Tube({{Vec(24, -26, 74), 5}, {Vec(34, 4, 64), 4.2}, {Vec(44, 30, 46), 3}, {Vec(54, 48, 20), 1.5}}),
          Tube({{Vec(22, -26, 72), 4.6}, {Vec(4, 8, 62), 3.8}, {Vec(-24, 36, 52), 2.6}, {Vec(-52, 46, 44), 1.3}}),
          Tube({{Vec(18, -8, 32), 5}, right}),
          Tube({{Vec(18, -8, 32), 4.4}, {Vec(4, 2, 38), 4}, left}),
          fork(right, Vec(62, 16, 30), Vec(94, 28, 16)),
          fork(right, Vec(60, -22, 24), Vec(90, -40, 2)),
          fork(right, Vec(58, -16, 50), Vec(86, -24, 64)),
          fork(right, Vec(52, 26, 48), Vec(70, 44, 58)),
          fork(left, Vec(-22, 40, 42), Vec(-40, 56, 38)),
          fork(left, Vec(-30, 24, 46), Vec(-60, 34, 50)),
          fork(left, Vec(8, 36, 34), Vec(22, 54, 18))};
}

}  // namespace

std::function<double(const Vec&)> liver_vessels() {
  return [all = branches()](const Vec& p) {
    for (const Tube& tube : all)
      if (tube.distance(p, 0.5) < 0) return 52.0;
    return 0.0;
  };
}

void add_great_vessels(std::vector<Structure>& to) {
  for (const Tube& tube : {portal_trunk(), splenic_vein(), mesenteric_vein()})
    to.push_back(tube_structure(label::kPortalVein, tube, filled(172)));
  to.push_back({label::kAorta, Box(Vec(-24, -42, -1e6), Vec(-4, -22, 1e6)), aorta,
                [](const Vec&, double d) { return d > -1.2 ? 95.0 : 160.0; }});
  to.push_back({label::kVenaCava, Box(Vec(12, -48, -1e6), Vec(36, -24, 1e6)), vena_cava, filled(140)});
  for (const Tube& tube : {left_renal_vein(), right_renal_vein()})
    to.push_back(tube_structure(label::kVenaCava, tube, filled(150)));
}

}  // namespace trocar::phantom
