// Heat in tissue: against closed forms, its ledger, and what it does to tissue.
#include "tissue/interaction/tissue_heat.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/support/shapes.h"

namespace trocar::tissue_heat_test {
namespace {

SurfacePtr block(double half_m) { return still_surface(test::box(Vec3::Constant(-half_m), Vec3::Constant(half_m))); }
/// Its top, z = 0, in squares of a width about the origin.
SurfacePtr slab(double half_m, double deep_m, double width_m) {
  SurfaceSnapshot s;
  const int n = static_cast<int>(std::lround(2 * half_m / width_m)), row = n + 1;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) s.vertices.emplace_back(-half_m + width_m * i, -half_m + width_m * j, 0);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = i + row * j;
      s.triangles.push_back({a, a + 1, a + row + 1});
      s.triangles.push_back({a, a + row + 1, a + row});
    }
  // Sides and bottom meet in a point far below.
  const auto point = static_cast<std::int32_t>(s.vertices.size());
  s.vertices.emplace_back(0, 0, -deep_m);
  for (int i = 0; i < n; ++i) {
    s.triangles.push_back({i + 1, i, point});
    s.triangles.push_back({i * row, (i + 1) * row, point});
    s.triangles.push_back({n * row + i, n * row + i + 1, point});
    s.triangles.push_back({(i + 1) * row + n, i * row + n, point});
  }
  return std::make_shared<const SurfaceSnapshot>(std::move(s));
}

/// Nothing but conduction, however hot.
TissueHeatOptions only_conduction() {
  TissueHeatOptions o;
  o.step_s = 0.05;
  o.conductivity_slope = o.perfusion_w_per_m3_k = o.gas_w_per_m2_k = 0;
  o.boil_c = o.soft_cap_c = 5000;
  o.char_from_c = 5001;
  o.char_full_c = o.hard_cap_c = 5002;
  o.tip_j_per_k = 1e-9;
  return o;
}
double diffusivity(const TissueHeatOptions& o) {
  return o.conductivity_w_per_m_k / (o.density_kg_m3 * o.specific_heat_j_per_kg_k);
}
/// Rise at a distance from a point that gives P from t = 0 on, infinite medium (Carslaw and Jaeger).
double point_source_k(double power_w, double r, double t, const TissueHeatOptions& o) {
  return power_w / (4 * std::numbers::pi * o.conductivity_w_per_m_k * r) *
         std::erfc(r / std::sqrt(4 * diffusivity(o) * t));
}

HeatSource at(const Vec3& place, double power_w, HeatMode mode = HeatMode::kSoftCoagulation, double radius_m = 0.0025) {
  return {place, radius_m, power_w, mode, 0};
}
void run(TissueHeat& heat, const HeatSource& source, int steps) {
  for (int i = 0; i < steps; ++i) heat.step({&source, 1});
}
void cool(TissueHeat& heat, int most_steps) {
  for (int i = 0; i < most_steps && !heat.cold(); ++i) heat.step({});
}
/// How far down from the origin cells are dead, m.
double depth(const TissueHeat& heat) {
  double deepest = 0;
  for (double z = 0; z < 0.015; z += 1e-4)
    if (heat.damage_at({0, 0, -z}) >= 1) deepest = z;
  return deepest;
}
double white_radius(const TissueHeat& heat) {
  double widest = 0;
  for (double x = 0; x < 0.015; x += 1e-4)
    if (heat.damage_at({x, 0, -0.0005}) >= 1) widest = x;
  return widest;
}
int above(const std::vector<float>& shares, float share) {
  return static_cast<int>(std::count_if(shares.begin(), shares.end(), [=](float s) { return s > share; }));
}

const Vec3 kMiddle = Vec3::Constant(0.0005);  // of a cube
constexpr double kTiny = 1e-4;                // radius of a contact that heats one cube

// ---- the grid

TEST(HeatGrid, CubesFillTheSurface) {
  const TriangleSurface ball = test::sphere({0.001, -0.002, 0.0005}, 0.012, 4);
  HeatGrid grid(0.001);
  grid.set_surface(still_surface(ball));
  bool fresh = false;
  for (int k = -2; k < 2; ++k)
    for (int j = -2; j < 2; ++j)
      for (int i = -2; i < 2; ++i) grid.need({i, j, k}, fresh);
  double tissue = 0, skin = 0;
  grid.for_blocks([&](const HeatBlock& b) {
    for (std::size_t c = 0; c < HeatBlock::kCells; ++c) {
      if (b.state[c] != HeatCell::kTissue) continue;
      const double from_middle = (grid.middle(b, c) - Vec3(0.001, -0.002, 0.0005)).norm();
      EXPECT_LT(from_middle, 0.012);
      EXPECT_TRUE(!b.skin[c] || from_middle > 0.0105) << "one cube deep";
      ++tissue;
      skin += b.skin[c];
    }
  });
  EXPECT_NEAR(tissue * 1e-9, ball.volume_m3(), 0.01 * ball.volume_m3());
  EXPECT_GT(skin, 4 * std::numbers::pi * 10 * 10);
  EXPECT_EQ(grid.need({9, 0, 0}, fresh), nullptr) << "beside the ball";
}

// ---- conduction, blood

TEST(TissueHeat, APointSourceConductsAsCarslawAndJaegerHaveIt) {
  // One cube stands for the point: three cubes away 3.5 % of the steady rise too much along the axes, with 1 / r^2
  // less.
  for (const auto& [edge_m, bound_k] : {std::pair{0.001, 2.0}, std::pair{0.0005, 0.5}}) {
    TissueHeatOptions o = only_conduction();
    o.edge_m = edge_m;
    TissueHeat heat(block(0.04), o);
    const Vec3 middle = Vec3::Constant(edge_m / 2);
    const double power = 1, seconds = 20;
    run(heat, at(middle, power, HeatMode::kSoftCoagulation, kTiny), static_cast<int>(std::lround(seconds / o.step_s)));
    for (const Vec3& cube : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(-1, 1, 0), Vec3(1, 1, 1)})
      for (double away = 0.002; away < 0.009; away += 0.001) {
        const double r = away * cube.norm(), exact = point_source_k(power, r, seconds, o);
        if (r < 0.0029) continue;
        EXPECT_NEAR(heat.temperature_at(middle + away * cube) - o.body_c, exact, bound_k) << r << " m, " << cube;
      }
    EXPECT_NEAR(heat.ledger().stored_j, power * seconds, 0.01);
  }
}

TEST(TissueHeat, NothingFlowsThroughTheSurface) {
  const TissueHeatOptions o = only_conduction();
  TissueHeat heat(block(0.04), o);
  const double power = 0.5, seconds = 40;
  const Vec3 source(0.0005, 0.0005, 0.0395), image(0.0005, 0.0005, 0.0405);
  run(heat, at(source, power, HeatMode::kSoftCoagulation, kTiny), static_cast<int>(seconds / o.step_s));
  for (double x = 0.003; x < 0.008; x += 0.001) {
    const Vec3 p = source + Vec3(x, 0, 0);
    const double exact = point_source_k(power, x, seconds, o) + point_source_k(power, (p - image).norm(), seconds, o);
    EXPECT_NEAR(heat.temperature_at(p) - o.body_c, exact, 0.3 + 0.05 * exact) << x;
  }
}

TEST(TissueHeat, BloodLeavesTheSteadyProfileOfPennes) {
  TissueHeatOptions o = only_conduction();
  o.conductivity_w_per_m_k = 2;
  o.perfusion_w_per_m3_k = 150e3;
  o.damage_from_c = 4000;  // blood flows on
  o.step_s = 0.1;
  TissueHeat heat(block(0.02), o);
  const double power = 5, length = std::sqrt(o.conductivity_w_per_m_k / o.perfusion_w_per_m3_k);
  run(heat, at(kMiddle, power, HeatMode::kSoftCoagulation, kTiny), 1000);
  for (double r = 0.004; r < 0.011; r += 0.001) {  // four cubes and more: nearer, a cube is no point
    const double exact = power / (4 * std::numbers::pi * o.conductivity_w_per_m_k * r) * std::exp(-r / length);
    EXPECT_NEAR(heat.temperature_at(kMiddle + Vec3(0, r, 0)) - o.body_c, exact, 0.05 + 0.05 * exact) << r;
  }
  const HeatLedger l = heat.ledger();
  EXPECT_GT(l.perfused_j, 0.6 * l.delivered_j);
}

TEST(TissueHeat, StepsThatAreTooLongAreDivided) {
  TissueHeatOptions o;
  o.edge_m = 0.0002;
  o.step_s = 0.05;
  TissueHeat heat(block(0.01), o);
  ASSERT_LT(heat.most_stable_step_s(), o.step_s);
  run(heat, at({0, 0, 0.01}, 5, HeatMode::kForcedCoagulation, 0.0003), 10);
  EXPECT_GT(heat.hottest_c(), 90);
  for (double x = -0.003; x < 0.003; x += 1e-4)
    for (double z = 0.007; z < 0.01; z += 1e-4) {
      const double c = heat.temperature_at({x, 0, z});
      EXPECT_GE(c, o.body_c - 1e-9);
      EXPECT_LE(c, o.hard_cap_c + 1e-9);
    }
}

TEST(TissueHeat, OptionsThatMakeNoSenseAreRefused) {
  TissueHeatOptions o;
  o.edge_m = 0;
  EXPECT_THROW(TissueHeat(block(0.01), o), InputError);
  o = {};
  o.soft_cap_c = 120;
  EXPECT_THROW(TissueHeat(block(0.01), o), InputError);
  o = {};
  o.water_kg_m3 = 1000;
  EXPECT_THROW(TissueHeat(block(0.01), o), InputError);
}

// ---- joules

TEST(TissueHeat, EveryJouleIsAccountedFor) {
  TissueHeatOptions o;
  o.perfusion_w_per_m3_k = 400e3;  // cools soon
  TissueHeat heat(slab(0.03, 0.06, 0.003), o);
  double given = 0;
  const auto drag = [&](HeatMode mode, double y) {
    for (int i = 0; i < 150; ++i) {
      const HeatSource source = at({-0.004 + 5e-5 * i, y, 0}, 40, mode, 0.0008);
      heat.step({&source, 1});
      given += heat.given()[0].delivered_j;
    }
  };
  drag(HeatMode::kCut, -0.006);
  drag(HeatMode::kForcedCoagulation, 0);
  drag(HeatMode::kSoftCoagulation, 0.006);
  for (int i = 0; i < 300; ++i) heat.step({});
  const HeatLedger l = heat.ledger();
  EXPECT_LT(std::abs(l.missing_j()), 0.001 * l.delivered_j);
  EXPECT_NEAR(given, l.delivered_j + l.into_tip_j, 1e-9 * given);
  EXPECT_LT(l.delivered_j + l.into_tip_j, l.offered_j) << "soft coagulation has its cap";
  for (const double part : {l.stored_j, l.steam_j, l.perfused_j, l.to_gas_j, l.removed_j, l.into_tip_j})
    EXPECT_GT(part, 0.001 * l.delivered_j);
  cool(heat, 60000);
  EXPECT_TRUE(heat.cold());
  EXPECT_LT(std::abs(heat.ledger().missing_j()), 0.001 * l.delivered_j);
  EXPECT_EQ(heat.ledger().stored_j, 0);
}

TEST(TissueHeat, WhatIsStoredIsWhatTheThermometerSays) {
  TissueHeat heat(block(0.03));
  run(heat, at({0, 0, 0.03}, 15), 100);
  const TissueHeatOptions o;
  double stored = 0;
  for (double x = -0.0195; x < 0.02; x += 0.001)
    for (double y = -0.0195; y < 0.02; y += 0.001)
      for (double z = 0.0105; z < 0.03; z += 0.001) stored += heat.temperature_at({x, y, z}) - o.body_c;
  stored *= o.density_kg_m3 * o.specific_heat_j_per_kg_k * 1e-9;
  const HeatLedger l = heat.ledger();
  EXPECT_NEAR(stored, l.stored_j, 0.01 * l.stored_j);
  EXPECT_NEAR(l.delivered_j, 15, 1e-6) << "15 W for a second";
  EXPECT_NEAR(l.stored_j, 15, 0.3) << "hardly anything is lost in a second";
}

TEST(TissueHeat, NoContactNoHeat) {
  TissueHeat heat(block(0.02));
  run(heat, at({0, 0, 0.03}, 60, HeatMode::kCut), 50);
  EXPECT_FALSE(heat.given()[0].touches);
  run(heat, at({0, 0, 0.02}, 60, HeatMode::kCut, 0), 50);
  EXPECT_FALSE(heat.given()[0].touches);
  run(heat, at(Vec3::Constant(std::nan("")), 60, HeatMode::kCut), 1);
  const HeatLedger l = heat.ledger();
  EXPECT_NEAR(l.offered_j, 60 * 1.01, 1e-9);
  EXPECT_EQ(l.delivered_j + l.into_tip_j, 0);
  EXPECT_EQ(above(heat.white(), 0), 0);
  EXPECT_EQ(heat.tip_c(0), TissueHeatOptions{}.body_c);
  heat.step({});
  EXPECT_EQ(heat.hottest_c(), TissueHeatOptions{}.body_c);
}

// ---- boiling

TEST(TissueHeat, WaterBoilsAtAHundredDegreesAsLongAsItLasts) {
  TissueHeatOptions o;
  o.conductivity_w_per_m_k = 1e-6;
  o.conductivity_slope = o.perfusion_w_per_m3_k = o.tip_power_share = 0;
  o.tip_j_per_k = 1e-9;
  TissueHeat heat(block(0.02), o);
  const double power = 2;
  int warming = 0, boiling = 0;
  for (;; ++warming) {
    run(heat, at(kMiddle, power, HeatMode::kForcedCoagulation, kTiny), 1);
    if (heat.temperature_at(kMiddle) > 99.999) break;
  }
  for (; heat.temperature_at(kMiddle) < 100.001 && boiling < 1000; ++boiling)
    run(heat, at(kMiddle, power, HeatMode::kForcedCoagulation, kTiny), 1);
  const double cube = 1e-9;
  EXPECT_NEAR(warming * 0.01, o.density_kg_m3 * o.specific_heat_j_per_kg_k * cube * 63 / power, 0.011);
  EXPECT_NEAR(boiling * 0.01, o.water_kg_m3 * o.latent_j_per_kg * cube / power, 0.021);
  run(heat, at(kMiddle, power, HeatMode::kForcedCoagulation, kTiny), 500);
  EXPECT_NEAR(heat.hottest_c(), o.hard_cap_c, 0.5) << "dry, up to the cap";
}

TEST(TissueHeat, NothingGetsHotterThanItsMode) {
  for (const auto& [mode, cap_c] : {std::pair{HeatMode::kSoftCoagulation, 98.0},
                                    std::pair{HeatMode::kForcedCoagulation, 350.0}, std::pair{HeatMode::kCut, 350.0}})
    for (const double radius : {0.0005, 0.002}) {
      TissueHeat heat(block(0.02));
      double hottest = 0;
      for (int i = 0; i < 150; ++i) {
        run(heat, at({0, 0, 0.02}, 200, mode, radius), 1);
        hottest = std::max(hottest, heat.hottest_c());
      }
      EXPECT_LE(hottest, cap_c + 1e-6);
      EXPECT_GT(hottest, 95);
    }
}

TEST(TissueHeat, ACutVaporisesWhatItTouchesAndThenTouchesNothing) {
  TissueHeat heat(slab(0.03, 0.06, 0.003));
  std::vector<VaporisedCube> gone;
  for (int i = 0; i < 1000; ++i) {
    run(heat, at({0, 0, 0}, 40, HeatMode::kCut, 0.001), 1);
    gone.insert(gone.end(), heat.vaporised().begin(), heat.vaporised().end());
  }
  ASSERT_GT(gone.size(), 4u);
  for (const VaporisedCube& cube : gone) {
    EXPECT_LT(cube.middle_T.norm(), 0.001 + 0.00087);
    EXPECT_LT(cube.middle_T.z(), 0);
    EXPECT_TRUE(heat.vaporised_at(cube.middle_T));
  }
  EXPECT_FALSE(heat.vaporised_at({0, 0, -0.004}));
  EXPECT_FALSE(heat.given()[0].touches) << "nothing is left within the radius";
  const HeatLedger l = heat.ledger();
  const TissueHeatOptions o;
  EXPECT_GT(l.steam_j, static_cast<double>(gone.size()) * o.water_kg_m3 * o.latent_j_per_kg * 1e-9);
  int walls = 0;
  for (const VaporisedCube& cube : gone) {
    const Vec3 below = cube.middle_T - Vec3(0, 0, cube.edge_m);
    if (heat.vaporised_at(below)) continue;
    ++walls;
    EXPECT_GT(heat.look_at(below).charred, 0.99 * o.char_left_by_cut);
  }
  EXPECT_GT(walls, 0);
}

TEST(TissueHeat, OnlyACutVaporisesAndOnlySparksChar) {
  for (const HeatMode mode : {HeatMode::kSoftCoagulation, HeatMode::kForcedCoagulation}) {
    TissueHeat heat(slab(0.03, 0.06, 0.003));
    for (int i = 0; i < 200; ++i) {
      run(heat, at({0, 0, 0}, 40, mode, 0.001), 1);
      EXPECT_TRUE(heat.vaporised().empty());
    }
    EXPECT_GE(above(heat.white(), 0.99f), 1);
    EXPECT_EQ(above(heat.charred(), 0.9f), mode == HeatMode::kForcedCoagulation ? 1 : 0);
  }
}

// ---- damage

TEST(Arrhenius, AtSixtyDegreesCellsDieInSeconds) {
  const ArrheniusLaw cells = TissueHeatOptions{}.cells;
  // ln k = ln 7.39e39 - 257.7e3 / (8.314 * 333.15), by hand: -1.24
  EXPECT_NEAR(std::log(cells.rate_per_s(60)), -1.24, 0.02);
  const ArrheniusTable table(cells, 43, 100);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(43, 100);
  for (int i = 0; i < 200; ++i) {
    const double c = any(random);
    EXPECT_NEAR(table.rate_per_s(c), cells.rate_per_s(c), 3e-4 * cells.rate_per_s(c)) << c;
  }
  EXPECT_EQ(table.rate_per_s(42.99), 0);
  EXPECT_NEAR(table.rate_per_s(300), cells.rate_per_s(100), 1e-9 * cells.rate_per_s(100));
}

TEST(TissueHeat, DamageIsTheIntegralOfTheLaw) {
  TissueHeat heat(block(0.02));
  const TissueHeatOptions o;
  const Vec3 place(0.0005, 0.0025, 0.0175);
  double cells = 0, collagen = 0, before = o.body_c;
  for (int i = 0; i < 400; ++i) {
    if (i < 250)
      run(heat, at({0, 0, 0.02}, 20), 1);
    else if (i % 4 == 1)
      cool(heat, 4);  // four steps are taken as one
    else
      continue;
    const double now = heat.temperature_at(place), mean = (now + before) / 2, dt = i < 250 ? 0.01 : 0.04;
    if (mean > o.damage_from_c) {
      cells += dt * o.cells.rate_per_s(mean);
      collagen += dt * o.collagen.rate_per_s(mean);
    }
    before = now;
  }
  ASSERT_GT(cells, 0.5);
  ASSERT_LT(cells, 50);
  EXPECT_NEAR(heat.damage_at(place), cells, 0.02 * cells);
  EXPECT_NEAR(heat.softened_at(place), 1 - std::exp(-collagen), 0.01);
  EXPECT_GT(heat.softened_at({0, 0, 0.0195}), 0.9) << "under the contact";
  EXPECT_LT(heat.softened_at({0, 0, 0.005}), 1e-9);
}

TEST(TissueHeat, AWhiteZoneOfMillimetresGrowsWithTimeAndPower) {
  double before = 0;
  for (const double power : {15.0, 30.0, 60.0}) {
    TissueHeat heat(slab(0.03, 0.06, 0.002));
    run(heat, at({0, 0, 0}, power), 100);
    const double early = white_radius(heat);
    const int early_white = above(heat.white(), 0.5f);
    run(heat, at({0, 0, 0}, power), 200);
    EXPECT_GT(white_radius(heat), early + 0.0005);
    EXPECT_GT(above(heat.white(), 0.5f), early_white);
    EXPECT_GT(white_radius(heat), before);
    before = white_radius(heat);
    // [M] contact coagulation of liver, 30 W for some seconds: 2 to 5 mm deep
    if (power == 30) {
      EXPECT_GT(depth(heat), 0.002);
      EXPECT_LT(depth(heat), 0.005);
    }
  }
}

TEST(TissueHeat, AVesselIsSealedWhenItsWholeSectionIs) {
  TissueHeat heat(slab(0.03, 0.06, 0.003));
  const Vec3 vessel(0, 0, -0.0015), along(1, 0, 0);
  EXPECT_FALSE(heat.sealed_at(vessel, along, 0.001));
  run(heat, at({0, 0, 0}, 30), 80);
  EXPECT_FALSE(heat.sealed_at(vessel, along, 0.001)) << "its far wall is alive";
  EXPECT_TRUE(heat.sealed_at({0, 0, -0.0008}, along, 0.0003));
  run(heat, at({0, 0, 0}, 30), 220);
  EXPECT_TRUE(heat.sealed_at(vessel, along, 0.001));
  EXPECT_FALSE(heat.sealed_at(vessel, along, 0.004));
}

// ---- the surface

TEST(TissueHeat, ATrackBetweenVerticesIsSeen) {
  TissueHeat heat(slab(0.03, 0.06, 0.006));
  for (int i = 0; i < 600; ++i)
    run(heat, at({-0.009 + 3e-5 * i, 0.003, 0}, 30, HeatMode::kForcedCoagulation, 0.0006), 1);
  EXPECT_GT(heat.look_at({0, 0.003, -0.0003}).charred, 0.9);
  EXPECT_LT(heat.look_at({0, 0.006, -0.0003}).charred, 0.1) << "a narrow one";
  EXPECT_GE(above(heat.charred(), 0.3f), 6) << "the vertices on both sides, 3 mm away";
  EXPECT_LT(above(heat.charred(), 0.01f), 20);
}

/// One square of the slab with a vertex in its middle.
SurfacePtr with_middle(const SurfacePtr& slab_T, int square, std::vector<VertexOrigin>& added) {
  SurfaceSnapshot s;
  s.vertices = slab_T->vertices;
  s.triangles = slab_T->triangles;
  const auto t = static_cast<std::size_t>(2 * square);
  const auto [a, b, c] = s.triangles[t];
  const std::int32_t d = s.triangles[t + 1][2], middle = static_cast<std::int32_t>(s.vertices.size());
  s.vertices.push_back((s.vertices[static_cast<std::size_t>(a)] + s.vertices[static_cast<std::size_t>(c)]) / 2);
  s.triangles[t] = {a, b, middle};
  s.triangles[t + 1] = {c, d, middle};
  s.triangles.push_back({b, c, middle});
  s.triangles.push_back({d, a, middle});
  added = {{a, c, 0.5}};
  return std::make_shared<const SurfaceSnapshot>(std::move(s));
}

TEST(TissueHeat, NewVerticesShowWhatHappenedThere) {
  const SurfacePtr before = slab(0.03, 0.06, 0.006);
  TissueHeat heat(before);
  std::vector<VertexOrigin> added;
  const SurfacePtr after = with_middle(before, 5 * 10 + 5, added);
  run(heat, at(after->vertices.back(), 30), 70);
  const std::vector<float> white = heat.white();
  EXPECT_LT(*std::max_element(white.begin(), white.end()), 0.95f) << "4.2 mm away";
  const HeatLedger old = heat.ledger();
  heat.grow(after, added);
  ASSERT_EQ(heat.white().size(), white.size() + 1);
  EXPECT_EQ(heat.white().back(), 1.0f);
  EXPECT_EQ(heat.charred().size(), white.size() + 1);
  EXPECT_EQ(heat.ledger().stored_j, old.stored_j) << "the same tissue";
  EXPECT_GT(above(heat.white(), 0.1f), 3);
  EXPECT_THROW(heat.grow(before, added), InputError);
}

TEST(TissueHeat, ASurfaceThatLeavesTissueOutTakesItsHeatAway) {
  TissueHeat heat(block(0.02));
  run(heat, at({0, 0, 0.02}, 20), 100);
  TriangleSurface less = test::box(Vec3::Constant(-0.02), Vec3(0.02, 0.02, 0.018));
  less.vertices.insert(less.vertices.end(), {0, 0, 0.018});
  const double stored = heat.ledger().stored_j;
  heat.grow(still_surface(less), {{4, 7, 0.5}});
  const HeatLedger l = heat.ledger();
  EXPECT_LT(l.stored_j, 0.8 * stored);
  EXPECT_NEAR(l.stored_j + l.removed_j, stored, 1e-6 * stored);
  EXPECT_LT(std::abs(l.missing_j()), 1e-3);
}

TEST(TissueHeat, WarmTissueCoolsAndNothingOfItIsKept) {
  TissueHeatOptions o;
  o.perfusion_w_per_m3_k = 400e3;
  TissueHeat heat(block(0.02), o);
  run(heat, at({0, 0, 0.02}, 2), 30);
  EXPECT_GT(heat.hottest_c(), 37.5);
  EXPECT_LT(heat.hottest_c(), 43);
  EXPECT_GT(heat.blocks(), 0u);
  cool(heat, 20000);
  EXPECT_TRUE(heat.cold());
  EXPECT_EQ(heat.blocks(), 0u);

  run(heat, at({0, 0, 0.02}, 30), 100);
  const double deep = heat.damage_at({0, 0, 0.019});
  cool(heat, 60000);
  EXPECT_TRUE(heat.cold());
  EXPECT_GT(heat.blocks(), 0u) << "what is hurt is kept";
  EXPECT_GE(heat.damage_at({0, 0, 0.019}), deep);
  EXPECT_GE(deep, 1);
}

TEST(TissueHeat, AfterAResetNothingIsLeft) {
  const SurfacePtr surface = slab(0.03, 0.06, 0.003);
  TissueHeat heat(surface), fresh(surface);
  run(heat, at({0, 0, 0}, 40, HeatMode::kCut, 0.001), 200);
  ASSERT_GT(heat.tip_c(0), 40);
  heat.reset();
  EXPECT_TRUE(heat.cold());
  EXPECT_EQ(heat.blocks(), 0u);
  EXPECT_EQ(above(heat.white(), 0) + above(heat.charred(), 0), 0);
  EXPECT_EQ(heat.tip_c(0), fresh.tip_c(0));
  EXPECT_EQ(heat.ledger().offered_j, 0);
  EXPECT_FALSE(heat.vaporised_at({0.0005, 0.0005, -0.0005}));
  run(heat, at({0, 0, 0}, 30), 50);
  run(fresh, at({0, 0, 0}, 30), 50);
  EXPECT_EQ(heat.white(), fresh.white());
  EXPECT_EQ(heat.ledger().stored_j, fresh.ledger().stored_j);
}

TEST(TissueHeat, SameInputSameBytes) {
  const auto after = [] {
    TissueHeat heat(slab(0.03, 0.06, 0.002));
    for (int i = 0; i < 200; ++i) {
      const std::array<HeatSource, 2> two{at({-0.005 + 5e-5 * i, 0, 0}, 40, HeatMode::kCut, 0.0008),
                                          at({0, 0.008, 0}, 30, HeatMode::kForcedCoagulation, 0.002)};
      heat.step({two.data(), i % 50 < 40 ? 2u : 0u});
    }
    std::vector<float> all = heat.white();
    all.insert(all.end(), heat.charred().begin(), heat.charred().end());
    const HeatLedger l = heat.ledger();
    for (const double part : {l.stored_j, l.steam_j, l.perfused_j, l.from_tip_j}) {
      float halves[2];
      std::memcpy(halves, &part, sizeof part);
      all.insert(all.end(), halves, halves + 2);
    }
    return all;
  };
  const std::vector<float> one = after(), two = after();
  ASSERT_EQ(one.size(), two.size());
  EXPECT_EQ(std::memcmp(one.data(), two.data(), one.size() * sizeof(float)), 0);
}

// ---- the tip

TEST(TissueHeat, AHotTipBurnsAfterThePowerIsOff) {
  TissueHeatOptions o;
  o.tip_power_share = 0.3;
  TissueHeat heat(slab(0.03, 0.06, 0.003), o);
  run(heat, at({-0.015, 0, 0}, 60, HeatMode::kForcedCoagulation, 0.001), 150);
  const double hot = heat.tip_c(0);
  ASSERT_GT(hot, 150);
  EXPECT_LE(hot, o.hard_cap_c);
  const double before = heat.ledger().from_tip_j;
  run(heat, at({0.015, 0, 0}, 0, HeatMode::kSoftCoagulation, 0.001), 200);
  EXPECT_GT(heat.ledger().from_tip_j, before + 0.1);
  EXPECT_GT(heat.temperature_at({0.015, 0, -0.0005}), 45) << "elsewhere, and no power";
  EXPECT_LT(heat.tip_c(0), hot);
  EXPECT_LT(std::abs(heat.ledger().missing_j()), 0.001 * heat.ledger().delivered_j);
  for (int i = 0; i < 6000; ++i) heat.step({});
  EXPECT_NEAR(heat.tip_c(0), o.body_c, 1);
}

}  // namespace
}  // namespace trocar::tissue_heat_test
