// The elastic sheet against closed forms, against itself, and against what may be thrown at it.
#include "tissue/thin/elastic_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "haptics/input_error.h"

namespace trocar::elastic_sheet_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

SheetOptions tough() {
  SheetOptions options;
  options.tear_n_per_m = 1e9;
  return options;
}

/// Nodes within this of a line x = const.
std::vector<std::int32_t> nodes_at(const ElasticSheet& sheet, double x, double within = 1e-9) {
  std::vector<std::int32_t> out;
  for (std::size_t n = 0; n < sheet.position().size(); ++n)
    if (std::abs(sheet.position()[n].x() - x) <= within) out.push_back(static_cast<std::int32_t>(n));
  return out;
}

/// Hangs what lies left of a line on where it is, so that the sheet is clamped there.
void clamp_left_of(ElasticSheet& sheet, double x) {
  for (std::size_t n = 0; n < sheet.position().size(); ++n)
    if (sheet.position()[n].x() <= x + 1e-9)
      sheet.anchor({.node = static_cast<std::int32_t>(n), .position = sheet.position()[n], .stiffness_n_per_m = 1e5});
}

MaterialPoint at_node(const ElasticSheet& sheet, std::int32_t node) {
  for (std::size_t t = 0; t < sheet.triangles().size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      if (sheet.triangles()[t][i] == node) {
        MaterialPoint place{static_cast<std::int32_t>(t), {0, 0, 0}};
        place.weight[i] = 1;
        return place;
      }
  return {};
}

/// A constant force on a node: a spring so long that its force does not change.
SheetSpring dead_load(const ElasticSheet& sheet, std::int32_t node, const Vec3& force) {
  return {.place = at_node(sheet, node),
          .direction = -force.normalized(),
          .stiffness_n_per_m = 1e-6,
          .stretch_m = force.norm() / 1e-6};
}

int parts(const ElasticSheet& sheet) {
  std::vector<std::size_t> root(sheet.position().size());
  for (std::size_t i = 0; i < root.size(); ++i) root[i] = i;
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i];
    return i;
  };
  for (const auto& [a, b, c] : sheet.triangles()) {
    root[find(std::size_t(b))] = find(std::size_t(a));
    root[find(std::size_t(c))] = find(std::size_t(a));
  }
  int out = 0;
  for (std::size_t i = 0; i < root.size(); ++i) out += root[i] == i;
  return out;
}

TEST(ElasticSheet, RefusesWhatIsNoSheet) {
  const TriangleSurface sheet = rectangular_sheet(0.03, 0.02, 0.005);
  EXPECT_THROW(rectangular_sheet(0.03, -1, 0.005), InputError);
  EXPECT_THROW(ElasticSheet({}, {}), InputError);
  SheetOptions none;
  none.thickness_m = 0;
  EXPECT_THROW(ElasticSheet(sheet, none), InputError);
  TriangleSurface twice = sheet;
  twice.triangles.push_back(twice.triangles.front());
  EXPECT_THROW(ElasticSheet(twice, {}), InputError);
  TriangleSurface lost = sheet;
  lost.vertices.push_back(Vec3::Zero());
  EXPECT_THROW(ElasticSheet(lost, {}), InputError);
  TriangleSurface nowhere = sheet;
  nowhere.vertices[0].x() = kNan;
  EXPECT_THROW(ElasticSheet(nowhere, {}), InputError);
}

TEST(ElasticSheet, ARectangleHasItsAreaAndFacesUp) {
  const ElasticSheet sheet(rectangular_sheet(0.04, 0.03, 0.003), {});
  EXPECT_NEAR(sheet.mass_kg(), 0.04 * 0.03 * 0.001 * 1060, 1e-9);
  for (const auto& [a, b, c] : sheet.triangles())
    EXPECT_GT((sheet.position()[std::size_t(b)] - sheet.position()[std::size_t(a)])
                  .cross(sheet.position()[std::size_t(c)] - sheet.position()[std::size_t(a)])
                  .z(),
              0);
}

TEST(ElasticSheet, PulledItGivesTheForceOfItsLaw) {
  SheetOptions options = tough();
  options.poisson = 0;  // no contraction: the strip stays as wide
  for (const double stretch : {1.02, 1.2}) {
    ElasticSheet sheet(rectangular_sheet(0.04, 0.02, 0.004), options);
    for (const std::int32_t n : nodes_at(sheet, 0))
      sheet.anchor({.node = n, .position = sheet.position()[std::size_t(n)], .stiffness_n_per_m = 1e6});
    for (const std::int32_t n : nodes_at(sheet, 0.04))
      sheet.anchor({.node = n,
                    .position = sheet.position()[std::size_t(n)] + Vec3((stretch - 1) * 0.04, 0, 0),
                    .stiffness_n_per_m = 1e6});
    sheet.settle();
    double pull = 0;
    for (const SheetAnchor& anchor : sheet.anchors())
      if (anchor.position.x() > 0.02) pull -= anchor.force.x();
    const double strain = 0.5 * (stretch * stretch - 1);
    EXPECT_NEAR(pull, options.young_pa * options.thickness_m * strain * stretch * 0.02, 0.001 * pull) << stretch;
  }
}

TEST(ElasticSheet, PulledItGrowsNarrower) {
  SheetOptions options = tough();
  options.poisson = 0.4;
  ElasticSheet sheet(rectangular_sheet(0.06, 0.01, 0.0025), options);
  const std::vector<std::int32_t> right = nodes_at(sheet, 0.06);
  clamp_left_of(sheet, 0);
  std::vector<SheetSpring> springs;
  for (const std::int32_t n : right) springs.push_back(dead_load(sheet, n, {0.002, 0, 0}));
  sheet.settle(springs);
  double low = 1, high = -1, longest = 0;
  for (const Vec3& p : sheet.position()) {
    longest = std::max(longest, p.x());
    if (std::abs(p.x() - 0.03) > 0.003) continue;
    low = std::min(low, p.y());
    high = std::max(high, p.y());
  }
  const double along = longest / 0.06 - 1, across = (high - low) / 0.01 - 1;
  EXPECT_NEAR(along, 0.002 * double(right.size()) / (options.young_pa * options.thickness_m * 0.01), 0.06 * along);
  EXPECT_NEAR(across, -0.4 * along, 0.05 * along);
}

/// Deflection of a cantilever under a small load at its end, over F L^3 / (3 D b).
double cantilever(double edge_m, bool turned) {
  SheetOptions options = tough();
  options.poisson = 0;
  const double length = 0.04, width = 0.012;
  TriangleSurface drawn =
      turned ? rectangular_sheet(width, length + edge_m, edge_m) : rectangular_sheet(length + edge_m, width, edge_m);
  if (turned)
    for (Vec3& v : drawn.vertices) v = Vec3(v.y(), width - v.x(), 0);
  double root = 0;  // what is clamped ends at the last node before `edge_m`
  for (const Vec3& v : drawn.vertices)
    if (v.x() <= 1.05 * edge_m) root = std::max(root, v.x());
  ElasticSheet sheet(drawn, options);
  clamp_left_of(sheet, root);
  double end = 0;
  for (const Vec3& v : drawn.vertices) end = std::max(end, v.x());
  const auto right = nodes_at(sheet, end, 1e-9);
  const double force = 1e-5;
  std::vector<SheetSpring> springs;
  for (const std::int32_t n : right) springs.push_back(dead_load(sheet, n, Vec3(0, 0, force / double(right.size()))));
  sheet.settle(springs, 1e-10, 4000);
  double sum = 0;
  for (const std::int32_t n : right) sum += sheet.position()[std::size_t(n)].z() / double(right.size());
  return sum / (force * std::pow(end - root, 3) / (3 * options.bending_j() * width));
}

TEST(ElasticSheet, BentItGivesWayLikeAPlateWhicheverWayTheTrianglesRun) {
  for (const bool turned : {false, true}) {
    const double coarse = cantilever(0.004, turned), fine = cantilever(0.002, turned);
    std::printf("cantilever over theory: %.3f, %.3f\n", coarse, fine);
    EXPECT_NEAR(fine, 1, 0.08) << turned;
    EXPECT_LT(std::abs(fine - 1), std::abs(coarse - 1) + 0.02) << turned;
  }
}

TEST(ElasticSheet, TurnedAsAWholeItIsAtRest) {
  ElasticSheet sheet(rectangular_sheet(0.03, 0.02, 0.004), tough());
  const Mat3 R = Eigen::AngleAxisd(2.3, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  std::vector<Vec3> turned;
  for (const Vec3& p : sheet.position()) turned.push_back(R * p + Vec3(0.1, 0, 0.2));
  sheet.place(turned);
  EXPECT_LT(sheet.energy_j(), 1e-15);
  sheet.step();
  for (std::size_t n = 0; n < turned.size(); ++n) EXPECT_LT((sheet.position()[n] - turned[n]).norm(), 1e-9);
}

TEST(ElasticSheet, AFoldComesBack) {
  ElasticSheet sheet(rectangular_sheet(0.03, 0.02, 0.004), tough());
  std::vector<Vec3> folded;
  for (const Vec3& p : sheet.position())
    folded.push_back(p.x() > 0.015 ? Vec3(0.030 - p.x(), p.y(), 0.004 + 0.1 * (p.x() - 0.015)) : p);
  sheet.place(folded);
  const double before = sheet.energy_j();
  for (int i = 0; i < 300; ++i) sheet.step();
  EXPECT_LT(sheet.energy_j(), 0.01 * before);
  EXPECT_EQ(sheet.held_steps(), 0U);
}

TEST(ElasticSheet, ThrownInTheAirItKeepsItsMomentumAndNeverGainsEnergy) {
  SheetOptions options = tough();
  options.mass_damping_per_s = 0;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(-1, 1);
  for (int round = 0; round < 3; ++round) {
    ElasticSheet sheet(rectangular_sheet(0.03, 0.03, 0.005), options);
    std::vector<Vec3> at;
    for (const Vec3& p : sheet.position()) at.push_back(p + 0.002 * Vec3(share(random), share(random), share(random)));
    sheet.place(at);
    double energy = sheet.energy_j();
    for (int i = 0; i < 100; ++i) {
      sheet.step();
      EXPECT_LE(sheet.energy_j(), energy + 1e-12) << i;
      energy = sheet.energy_j();
      EXPECT_LT(sheet.momentum().norm(), 1e-9 + 1e-6 * sheet.mass_kg());
    }
  }
}

TEST(ElasticSheet, CutThroughItFallsApartAndASlitOpens) {
  ElasticSheet sheet(rectangular_sheet(0.04, 0.03, 0.003), tough());
  const std::size_t triangles = sheet.triangles().size();
  EXPECT_EQ(sheet.cut({{0.2, 0, 0}, {0.2, 0.03, 0}}), 0) << "beside it";
  EXPECT_EQ(sheet.cut({{kNan, 0, 0}, {0.2, 0.03, 0}}), 0);
  EXPECT_EQ(parts(sheet), 1);
  // In from the border: it gapes when it is pulled, and hangs together.
  EXPECT_NEAR(sheet.cut({{0.02, 0, 0}, {0.02, 0.015, 0}}), 0.015, 0.006);
  EXPECT_EQ(parts(sheet), 1);
  EXPECT_EQ(sheet.topology(), 1U);
  EXPECT_GT(sheet.cut({{0.02, 0.012, 0}, {0.02, 0.03, 0}}), 0.01);
  EXPECT_EQ(parts(sheet), 2);
  EXPECT_EQ(sheet.triangles().size(), triangles);
  EXPECT_NEAR(sheet.mass_kg(), 0.04 * 0.03 * 0.001 * 1060, 1e-9);
  // The halves know nothing of each other.
  clamp_left_of(sheet, 0);
  const MaterialPoint right = at_node(sheet, nodes_at(sheet, 0.04).front());
  for (int i = 0; i < 20; ++i) {
    std::vector<SheetSpring> pull{
        {.place = right, .direction = -Vec3::UnitX(), .stiffness_n_per_m = 1, .stretch_m = 0.001}};
    sheet.step(pull);
  }
  EXPECT_GT(sheet.place_T(right).x(), 0.045);
  for (const SheetAnchor& anchor : sheet.anchors()) EXPECT_LT(anchor.force.norm(), 1e-6);
}

TEST(ElasticSheet, PulledTooHardItTearsAndNotBefore) {
  for (const double share : {0.5, 1.6}) {  // at the clamp's corners there is more
    SheetOptions options;
    options.tear_n_per_m = 4;
    ElasticSheet sheet(rectangular_sheet(0.04, 0.02, 0.004), options);
    const auto right = nodes_at(sheet, 0.04);
    clamp_left_of(sheet, 0);
    std::vector<SheetSpring> springs;
    for (const std::int32_t n : right)
      springs.push_back(dead_load(sheet, n, {share * options.tear_n_per_m * 0.02 / double(right.size()), 0, 0}));
    bool tore = false;
    for (int i = 0; i < 100; ++i) {
      sheet.step(springs);
      tore = tore || !sheet.torn().empty();
    }
    EXPECT_EQ(tore, share > 1) << share;
    EXPECT_EQ(sheet.held_steps(), 0U);
  }
}

TEST(ElasticSheet, WhatIsNotFiniteCountsAsNotThere) {
  ElasticSheet sheet(rectangular_sheet(0.03, 0.02, 0.004), tough());
  clamp_left_of(sheet, 0);
  const MaterialPoint place = at_node(sheet, nodes_at(sheet, 0.03).front());
  const std::size_t anchors = sheet.anchors().size();
  sheet.anchor({.node = 3, .position = Vec3::Constant(kNan)});
  sheet.anchor({.node = -1});
  EXPECT_EQ(sheet.anchors().size(), anchors);
  std::vector<SheetSpring> springs(4, {.place = place, .stiffness_n_per_m = 10, .stretch_m = 0.001});
  springs[0].direction.x() = kNan;
  springs[1].stretch_m = kNan;
  springs[2].place.triangle = 100000;
  springs[3].place.weight[0] = kNan;
  for (int i = 0; i < 5; ++i) sheet.step(springs);
  for (const Vec3& p : sheet.position()) EXPECT_TRUE(p.allFinite());
  EXPECT_LT(sheet.energy_j(), 1e-12);
}

TEST(ElasticSheet, RandomPullsCutsAndSettingsLeaveItFinite) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0, 1);
  SheetOptions options;
  options.gravity_m_s2 = {0, 0, -9.81};
  options.tear_n_per_m = 30;
  ElasticSheet sheet(rectangular_sheet(0.04, 0.03, 0.004), options);
  clamp_left_of(sheet, 0);
  for (int i = 0; i < 600; ++i) {
    std::vector<SheetSpring> springs;
    for (int k = 0; k < 3; ++k) {
      const auto triangle = static_cast<std::int32_t>(share(random) * double(sheet.triangles().size()));
      springs.push_back({.place = {triangle, {0.3, 0.3, 0.4}},
                         .direction = Vec3(share(random) - 0.5, share(random) - 0.5, share(random) - 0.5).normalized(),
                         .stiffness_n_per_m = 300 * share(random),
                         .stretch_m = 0.05 * share(random),
                         .pushes_only = share(random) < 0.5});
    }
    sheet.step(springs);
    if (i % 50 == 49) {
      const Vec3 a = sheet.position()[std::size_t(share(random) * double(sheet.position().size()))];
      sheet.cut({a, a + 0.01 * Vec3(share(random) - 0.5, share(random) - 0.5, 0)});
    }
  }
  for (const Vec3& p : sheet.position()) ASSERT_TRUE(p.allFinite());
  EXPECT_LT(sheet.held_steps(), 5U);
  // Let go it comes to rest.
  for (int i = 0; i < 600; ++i) sheet.step();
  double fastest = 0;
  for (const SheetAnchor& anchor : sheet.anchors())  // of what still hangs
    fastest = std::max(fastest, sheet.velocity()[std::size_t(anchor.node)].norm());
  EXPECT_LT(fastest, 1e-3);
}

TEST(ElasticSheet, TheSameInputGivesTheSameBytes) {
  const auto run = [] {
    ElasticSheet sheet(rectangular_sheet(0.03, 0.02, 0.004), {});
    clamp_left_of(sheet, 0);
    std::vector<SheetSpring> springs{
        {.place = {5, {0.2, 0.3, 0.5}}, .direction = Vec3::UnitZ(), .stiffness_n_per_m = 20, .stretch_m = 0.01}};
    for (int i = 0; i < 50; ++i) sheet.step(springs);
    return std::vector<Vec3>(sheet.position().begin(), sheet.position().end());
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace trocar::elastic_sheet_test
