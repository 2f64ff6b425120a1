#include "app/studies/workspace/workspace_study.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/studies/workspace/workspace_maps.h"
#include "app/studies/workspace/workspace_quality.h"
#include "app/studies/workspace/workspace_region.h"
#include "trainees/markup/html.h"

namespace trocar {
namespace {

/// The four devices of table 2.2, m: width, depth, height.
struct Commercial {
  const char* name;
  Vec3 box;
};
const std::array<Commercial, 4>& commercial() {
  static const std::array<Commercial, 4> devices{{{"PHANTOM Premium 1.5/6-DOF", {0.381, 0.191, 0.267}},
                                                  {"Freedom 6S", {0.220, 0.330, 0.170}},
                                                  {"Virtuose 6D Desktop", {0.120, 0.120, 0.120}},
                                                  {"Delta.6", {0.400, 0.400, 0.400}}}};
  return devices;
}

void add_extent(StudyResult& study, const SweptExtent& swept) {
  const Vec3 ring = 1e3 * swept.ring.sizes(), all = 1e3 * swept.limits.sizes(), clear = 1e3 * swept.clear.sizes();
  const auto near = [](double value, double wanted) { return std::abs(value / wanted - 1) <= 0.02; };
  study.cases.push_back({"width x', l1 up to the base ring", "mm", ring.x(), 449, "449 +-2 % (table 2.1, l3)",
                         near(ring.x(), 449),
                         "Limits of table 2.4 and the axis of l1 inside the ring, bodies without width."});
  study.cases.push_back({"height z', l1 up to the base ring", "mm", ring.z(), 318, "318 +-2 % (table 2.1, l6)",
                         near(ring.z(), 318), "The same."});
  study.cases.push_back({"depth y', l1 up to the base ring", "mm", ring.y(), 449, ">= 449 (table 2.1, l3)",
                         ring.y() >= 449, "The same."});
  study.cases.push_back({"width x', link widths counted", "mm", clear.x(), 449, "reported", true,
                         "l1 12 mm, ring and legs 8 mm thick (assumed): what is left of the width."});
  study.cases.push_back({"height z', link widths counted", "mm", clear.z(), 318, "reported", true, "The same."});
  study.cases.push_back({"width x', interference neglected", "mm", all.x(), 449, ">= 449", all.x() >= 449,
                         "Limits of table 2.4 alone: l1 would cross the ring."});
}

void add_volumes(StudyResult& study, const WorkspaceGrid& grid, const WorkspaceGrid& coarse) {
  const double limits = 1e3 * grid.volume_m3(ReachSet::kLimits), clear = 1e3 * grid.volume_m3(ReachSet::kLimitsClear);
  const double rules = 1e3 * grid.volume_m3(ReachSet::kRules), ruled = 1e3 * grid.volume_m3(ReachSet::kRulesClear);
  const double ring = 1e3 * grid.volume_m3(ReachSet::kRing);
  const auto add = [&](const char* name, double litres, const char* definition) {
    study.cases.push_back({name, "l", litres, {}, "reported", true, definition});
  };
  add("volume within the limits", limits, "Table 2.4, det A > 0; some arm plane reaches the middle of the cube.");
  add("volume, l1 inside the ring", ring, "And the axis of l1 inside the base ring, bodies without width.");
  add("volume, l1 clear of ring and legs", clear, "And l1 clear with its width and theirs (assumed).");
  add("volume within the rules", rules, "8 deg from every limit, det A >= 0.30; interference neglected.");
  add("volume within the rules, l1 clear", ruled, "What a controller may use.");
  study.cases.push_back({"share of the volume lost to l1, limits",
                         "1",
                         1 - clear / limits,
                         {},
                         "reported",
                         true,
                         "Of the volume within the limits."});
  study.cases.push_back({"share of the volume lost to l1, rules",
                         "1",
                         1 - ruled / rules,
                         {},
                         "reported",
                         true,
                         "Of the volume within the rules."});
  const double off = std::max(std::abs(1e3 * coarse.volume_m3(ReachSet::kLimitsClear) / clear - 1),
                              std::abs(1e3 * coarse.volume_m3(ReachSet::kRulesClear) / ruled - 1));
  study.cases.push_back({"volume at twice the cube, off by",
                         "1",
                         off,
                         {},
                         "<= 0.05",
                         off <= 0.05,
                         "Cubes of " + fixed_text(1e3 * coarse.side(), 0) + " against " +
                             fixed_text(1e3 * grid.side(), 0) + " mm, the worse of the two clear sets."});
  study.cases.push_back({"largest upright cube, l1 clear",
                         "mm",
                         1e3 * grid.largest_cube(ReachSet::kLimitsClear),
                         {},
                         "reported",
                         true,
                         "Within the limits; the region is a shell about O, not a block."});
}

StudyFile commercial_table(const WorkspaceGrid& grid) {
  std::string out =
      "| device | box W x D x H, mm | its volume, l | Trocar's device clear of its links, l | part of the box that "
      "fits in one piece |\n"
      "|---|---|---|---|---|\n";
  const std::string ours = fixed_text(1e3 * grid.volume_m3(ReachSet::kLimitsClear), 1);
  for (const Commercial& c : commercial()) {
    const Vec3 mm = 1e3 * c.box;
    out += std::string("| ") + c.name + " | " + fixed_text(mm.x(), 0) + " x " + fixed_text(mm.y(), 0) + " x " +
           fixed_text(mm.z(), 0) + " | " + fixed_text(1e3 * c.box.prod(), 1) + " | " + ours + " | " +
           fixed_text(grid.box_scale(ReachSet::kLimitsClear, c.box), 2) + " |\n";
  }
  return {"commercial.md", out};
}

void add_commercial(StudyResult& study, const WorkspaceGrid& grid, const Vec3& extent) {
  const double ours = grid.volume_m3(ReachSet::kLimitsClear);
  const Vec3 claimed(0.449, 0.449, 0.318);
  for (const Commercial& c : commercial()) {
    const double ratio = (extent.array() / c.box.array()).minCoeff(),
                 thesis = (claimed.array() / c.box.array()).minCoeff();
    study.cases.push_back(
        {std::string("extents over those of the ") + c.name, "1", ratio, thesis,
         thesis > 1 ? "> 1 (table 2.2)" : "reported: smaller in table 2.2 too", thesis <= 1 || ratio > 1,
         "Least of width, depth and height, link widths counted, over the box of table 2.2; thesis: the "
         "largest lengths of table 2.1 over it."});
  }
  for (const Commercial& c : commercial()) {
    study.cases.push_back({std::string("volume over that of the ") + c.name, "1", ours / c.box.prod(),
                           claimed.prod() / c.box.prod(), "reported", true,
                           "Region clear of the links over the box: the region is a shell, no box."});
  }
  study.files.push_back(commercial_table(grid));
}

void add_reference(StudyResult& study, const StudyRequest& request) {
  const RegionPercentiles p = region_percentiles(request.quick ? 1500 : 20000, request.seed);
  const std::string definition =
      "Reference's region, joint box drawn by seed, det A >= 0.05; the range is two standard "
      "deviations of a percentile of the reference's 4000 samples and ours.";
  const auto check = [&](const std::string& name, const char* unit, const RegionPercentiles::Three& value, double scale,
                         const std::array<double, 3>& wanted, double rounding) {
    const char* const which[] = {"5", "50", "95"};
    for (std::size_t i = 0; i < 3; ++i) {
      const double low = scale * value[i].low - rounding, high = scale * value[i].high + rounding;
      study.cases.push_back(
          {name + ", " + which[i] + " %",
           unit,
           scale * value[i].value,
           {},
           number_text(wanted[i]) + " (reference) within " + number_text(low) + " to " + number_text(high),
           wanted[i] >= low && wanted[i] <= high,
           definition});
    }
  };
  check("tip step by one count", "mm", p.step_m, 1e3, {0.140, 0.199, 0.286}, 5e-4);
  check("worst-direction force, 28 mN m", "N", p.force_28_n, 1, {0.31, 0.44, 0.63}, 5e-3);
  check("worst-direction force, 100 mN m", "N", p.force_100_n, 1, {1.10, 1.58, 2.25}, 5e-3);
  check("motor torque for the weight", "mN m", p.gravity_nm, 1e3, {14, 37, 84}, 0.5);
  study.cases.push_back({"share where the weight exceeds 28 mN m",
                         "1",
                         p.over_rating,
                         {},
                         "0.69 +-0.03 (reference)",
                         std::abs(p.over_rating - 0.69) <= 0.03,
                         definition});
  study.cases.push_back({"continuous force after the weight, 50 %",
                         "N",
                         p.left_n[1].value,
                         {},
                         "0 (reference)",
                         p.left_n[1].value == 0,
                         definition});
}

/// Qualities of every cell of limits_clear, by its place in cells().
std::vector<PostureQuality> qualities(const WorkspaceGrid& grid) {
  const DeviceModel model;
  std::vector<PostureQuality> all(grid.cells().size());
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (grid.cells()[n].in(ReachSet::kLimitsClear)) all[n] = posture_quality(model, grid.cells()[n].posture);
  }
  return all;
}

struct Map {
  const char* file;
  MapScale scale;
  double PostureQuality::*field;
  double factor;  ///< to the unit shown
};
const std::array<Map, 7>& maps() {
  static const std::array<Map, 7> all{
      {{"map_det_a.svg", {"det A at the best arm plane", "det A", 0, 1, 1}, &PostureQuality::det_a, 1},
       {"map_singular.svg",
        {"Smallest singular value of J (linear rows over 0.2 m, theta5 -80 deg)", "1", 0, 0.5, 2},
        &PostureQuality::smallest_singular,
        1},
       {"map_continuous.svg",
        {"Continuous force in the worst direction after the weight, 28 mN m", "N", 0, 0.5, 1},
        &PostureQuality::continuous_n,
        1},
       {"map_peak.svg",
        {"Peak force in the worst direction after the weight, 100 mN m", "N", 0, 2, 1},
        &PostureQuality::peak_n,
        1},
       {"map_gravity.svg",
        {"Motor torque that the weight alone takes", "mN m", 0, 100, 0},
        &PostureQuality::gravity_motor_nm,
        1e3},
       {"map_heat.svg",
        {"Hottest winding when the arm is held there for ever", "deg C (limit 125)", 25, 125, 0},
        &PostureQuality::winding_c,
        1},
       {"map_step.svg",
        {"Largest step of the stylus by one encoder count", "mm", 0.10, 0.30, 2},
        &PostureQuality::step_m,
        1e3}}};
  return all;
}

void add_maps(StudyResult& study, const WorkspaceGrid& grid) {
  const std::vector<PostureQuality> quality = qualities(grid);
  study.files.push_back({"workspace_sections.svg", set_sections(grid)});
  for (const Map& map : maps()) {
    const auto value = [&](const ReachCell& cell) {
      return map.factor * (quality[static_cast<std::size_t>(&cell - grid.cells().data())].*map.field);
    };
    study.files.push_back({map.file, value_sections(grid, map.scale, value)});
  }
  std::vector<double> peak, continuous, winding;
  for (std::size_t n = 0; n < quality.size(); ++n) {
    if (!grid.cells()[n].in(ReachSet::kRulesClear)) continue;
    peak.push_back(quality[n].peak_n);
    continuous.push_back(quality[n].continuous_n);
    winding.push_back(quality[n].winding_c);
  }
  const double held =
      static_cast<double>(std::count_if(winding.begin(), winding.end(), [](double c) { return c < 125; })) /
      static_cast<double>(winding.size());
  const char* where = "Cubes within the rules and clear of the links, posture with the largest det A.";
  study.cases.push_back(
      {"peak force after the weight, median", "N", quantiles(peak)[1].value, {}, "reported", true, where});
  study.cases.push_back(
      {"continuous force after the weight, median", "N", quantiles(continuous)[1].value, {}, "reported", true, where});
  study.cases.push_back({"share of the region held for ever under 125 deg C", "1", held, {}, "reported", true, where});
}

}  // namespace

StudyResult workspace_study(const StudyRequest& request) {
  StudyResult study{"workspace", "none: the kinematic and static models alone", {}, {}, {}};
  const double side = request.quick ? 0.014 : 0.008;
  const int planes = request.quick ? 36 : 72;
  const WorkspaceGrid grid(side, planes), coarse(2 * side, planes);
  const SweptExtent swept = sweep_extent(request.quick ? 24 : 60);
  add_extent(study, swept);
  add_volumes(study, grid, coarse);
  add_commercial(study, grid, swept.clear.sizes());
  add_reference(study, request);
  add_maps(study, grid);
  study.files.push_back({"workspace_3d.svg", workspace_picture(WorkspaceGrid(request.quick ? 0.02 : 0.010, 72))});
  return study;
}

}  // namespace trocar
