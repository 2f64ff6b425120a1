// Wounds that bleed: how much, what stops them, and a ledger that closes whatever is done.
#include "tissue/interaction/bleeding.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <random>

#include "tests/tissue/support/shapes.h"

namespace trocar::bleeding_test {
namespace {

constexpr double kStep = 0.01;    // s
constexpr std::int32_t kTop = 4;  // vertex of a sphere

TriangleSurface organ(int levels = 4) { return test::sphere({0, 0, 0.05}, 0.05, levels); }

/// An organ without clotting and vessels: ooze alone.
BleedingOptions steady() {
  BleedingOptions options;
  options.clot_s = 1e15;
  options.vessels.clear();
  return options;
}

struct Rig {
  explicit Rig(const BleedingOptions& options = {}, int levels = 4) : rest(organ(levels)), bleeding(rest, options) {}
  Rig(const BleedingOptions& options, const VesselFlow& vessels) : rest(organ()), bleeding(rest, options, vessels) {}
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds / kStep); ++i) bleeding.step(rest.vertices, kStep);
  }
  double lost_in(double seconds) {
    const double before = bleeding.ledger().lost_ml;
    run(seconds);
    return bleeding.ledger().lost_ml - before;
  }
  TriangleSurface rest;
  Bleeding bleeding;
};

VesselFlow artery(double radius_m = 0.6e-3) {
  VesselFlow flow;
  flow.add_node({.supply = Supply::kArterial});
  flow.add_node({.capillary_m3_per_pa_s = 5e-11});
  flow.add_vessel({0, 1, radius_m, 0.05});
  return flow;
}

void expect_closed(const BloodLedger& ledger) {
  EXPECT_NEAR(ledger.blood_missing_ml(), 0, 1e-9 * ledger.lost_ml + 1e-15);
  EXPECT_NEAR(ledger.water_missing_ml(), 0, 1e-9 * ledger.water_given_ml + 1e-15);
}

TEST(Bleeding, OozesByAreaAtThePortalPressure) {
  Rig rig(steady());
  EXPECT_EQ(rig.lost_in(1), 0);
  const std::array<std::int32_t, 1> top = {kTop};
  const WoundId id = rig.bleeding.add_wound(top, 1e-4, 0.002);
  EXPECT_NEAR(rig.lost_in(60), 6.7e-4 * 1e-4 * 60 * 1e6, 1e-6) << "4 mL of 1 cm2 in a minute: mild";
  EXPECT_NEAR(rig.bleeding.wound(id).rate_ml_per_min, 4.02, 0.01);
  EXPECT_NEAR(rig.bleeding.ledger().rate_ml_per_min, 4.02, 0.01);
  EXPECT_GT(rig.bleeding.blood()[kTop], 0.5F);
  EXPECT_GT(rig.bleeding.wet()[kTop], 0.5F);
  expect_closed(rig.bleeding.ledger());
}

TEST(Bleeding, ClotsWithItsTimeConstant) {
  BleedingOptions options = steady();
  options.clot_s = 4;
  Rig rig(options, 3);
  const std::array<std::int32_t, 1> top = {kTop};
  rig.bleeding.add_wound(top, 1e-4, 0.002);
  EXPECT_NEAR(rig.lost_in(50), 6.7e-4 * 1e-4 * 1e6 * 4, 0.0005);
}

TEST(Bleeding, WoundsNearAnotherWidenIt) {
  Rig rig(steady());
  const MaterialPoint place{0, {1, 0, 0}};
  const WoundId id = rig.bleeding.add_wound(place, 1e-5, 0.002);
  EXPECT_EQ(rig.bleeding.add_wound(MaterialPoint{0, {0.9, 0.1, 0}}, 3e-5, 0.005), id);
  EXPECT_EQ(rig.bleeding.wounds(), 1U);
  EXPECT_NEAR(rig.bleeding.wound(id).area_m2, 4e-5, 1e-18);
  EXPECT_EQ(rig.bleeding.wound(id).depth_m, 0.005);
  const std::array<std::int32_t, 1> top = {kTop};
  EXPECT_NE(rig.bleeding.add_wound(top, 1e-5, 0.002), id);
}

TEST(Bleeding, RefusesPlacesThatAreNotThere) {
  Rig rig;
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::array<std::int32_t, 1> beyond = {1 << 20}, top = {kTop};
  EXPECT_EQ(rig.bleeding.add_wound(beyond, 1e-5, 0.01), -1);
  EXPECT_EQ(rig.bleeding.add_wound(MaterialPoint{}, 1e-5, 0.01), -1);
  EXPECT_EQ(rig.bleeding.add_wound(MaterialPoint{0, {none, none, none}}, 1e-5, 0.01), -1);
  EXPECT_EQ(rig.bleeding.add_wound(top, none, 0.01), -1);
  EXPECT_EQ(rig.bleeding.add_wound(top, 0, 0.01), -1);
  EXPECT_EQ(rig.bleeding.add_wound(top, 1e-5, -1), -1);
  EXPECT_EQ(rig.bleeding.cut_vessel(0, 0.5, {0, {1, 0, 0}}, {0, {1, 0, 0}}), -1) << "no network";
  rig.run(0.1);
  EXPECT_EQ(rig.bleeding.ledger().lost_ml, 0);
}

TEST(Bleeding, DeeperCutsMeetMoreVesselsAndTheSameOnesEachTime) {
  const std::vector<double> depths = {0.002, 0.008, 0.02, 0.03};
  std::vector<double> sum(depths.size());
  for (std::int32_t v = 0; v < 200; ++v) {
    std::int32_t before = 0;
    for (std::size_t d = 0; d < depths.size(); ++d) {
      const TriangleSurface rest = organ(3);
      const std::array<std::int32_t, 1> place = {v};
      Bleeding bleeding(rest);
      const std::int32_t met = bleeding.wound(bleeding.add_wound(place, 5e-5, depths[d])).vessels;
      Bleeding again(rest);
      const WoundId id = again.add_wound(place, 2e-5, depths[0]);
      again.add_wound(place, 3e-5, depths[d]);
      EXPECT_EQ(again.wound(id).vessels, met) << "in two cuts or in one";
      EXPECT_GE(met, before);
      before = met;
      sum[d] += met;
    }
  }
  EXPECT_EQ(sum[0], 0);
  EXPECT_LT(sum[0], sum[1]);
  EXPECT_LT(sum[1], sum[2]);
  EXPECT_LT(sum[2], sum[3]);
  double expected = 0;
  for (const VesselSize& size : liver_vessels()) expected += 200 * (1 - std::exp(-size.per_m2 * 5e-5));
  EXPECT_NEAR(sum[3] / expected, 1, 0.2) << "as many as their density says; some vertices share a patch";
}

TEST(Bleeding, VesselsOfTheLiverBleedAsTheGradesOfTheBleedingScale) {
  const auto per_minute = [](const VesselSize& size) {
    BleedingOptions options = steady();
    options.ooze_m_per_s = 0;
    options.vessels = {size};
    options.vessels[0].per_m2 = 1e12;
    Rig rig(options);
    const std::array<std::int32_t, 1> top = {kTop};
    rig.bleeding.add_wound(top, 1e-5, 0.05);
    return rig.lost_in(8) * 60 / 8;  // ten beats
  };
  const std::vector<VesselSize> sizes = liver_vessels();
  for (const std::size_t small : {0U, 1U}) {
    EXPECT_GT(per_minute(sizes[small]), 1);
    EXPECT_LT(per_minute(sizes[small]), 10);
  }
  for (const std::size_t large : {2U, 3U}) {
    EXPECT_GT(per_minute(sizes[large]), 10);
    EXPECT_LT(per_minute(sizes[large]), 50);
  }
}

TEST(Bleeding, CoagulationTakesAShareAndThenAll) {
  Rig rig(steady());
  const std::array<std::int32_t, 1> top = {kTop};
  const WoundId id = rig.bleeding.add_wound(top, 1e-5, 0.002);
  const double whole = rig.lost_in(1);
  rig.bleeding.coagulate(id, 0.5);
  EXPECT_NEAR(rig.lost_in(1), whole / 2, 1e-9);
  rig.bleeding.coagulate(rig.rest.vertices[kTop] + Vec3(0, 0, 0.02), 0.005, 1);
  EXPECT_NEAR(rig.lost_in(1), whole / 2, 1e-9) << "beside it";
  rig.bleeding.coagulate(rig.rest.vertices[kTop], 0.005, 1);
  EXPECT_EQ(rig.lost_in(1), 0);
  rig.bleeding.add_wound(top, 1e-5, 0.002);
  EXPECT_NEAR(rig.lost_in(1), whole, 1e-9) << "cut again";
}

TEST(Bleeding, HeatClosesSmallVesselsAndClipsLargeOnes) {
  BleedingOptions options = steady();
  options.ooze_m_per_s = 0;
  options.vessels = {{Supply::kPortal, 2e-3, 0.06, 1e12, 0, 0.001}, {Supply::kArterial, 0.3e-3, 0.03, 1e12, 0, 0.001}};
  Rig rig(options);
  const std::array<std::int32_t, 1> top = {kTop};
  const WoundId id = rig.bleeding.add_wound(top, 1e-5, 0.01);
  EXPECT_EQ(rig.bleeding.wound(id).vessels, 2);
  rig.run(0.1);
  EXPECT_EQ(rig.bleeding.wound(id).open_vessels, 2);
  rig.bleeding.coagulate(id, 1);
  EXPECT_GT(rig.lost_in(0.1), 0);
  EXPECT_EQ(rig.bleeding.wound(id).open_vessels, 1);
  rig.bleeding.clip_wound(id, 0.5);
  const double half = rig.lost_in(0.1);
  EXPECT_GT(half, 0);
  rig.bleeding.clip_wound(id, 1);
  EXPECT_EQ(rig.lost_in(0.1), 0);
}

TEST(Bleeding, AToolThatPressesStopsItWhileItPresses) {
  Rig rig(steady());
  const std::array<std::int32_t, 1> top = {kTop};
  const WoundId id = rig.bleeding.add_wound(top, 1e-5, 0.002);
  rig.run(0.1);
  const double whole = rig.lost_in(kStep);
  rig.bleeding.press(rig.rest.vertices[kTop], 0.004, 4 * kMmHg);
  EXPECT_NEAR(rig.lost_in(kStep), whole / 2, 1e-12) << "8 mmHg drive it";
  EXPECT_TRUE(rig.bleeding.wound(id).pressed);
  rig.bleeding.press(rig.rest.vertices[kTop], 0.004, 8.01 * kMmHg);
  EXPECT_EQ(rig.lost_in(kStep), 0);
  EXPECT_NEAR(rig.lost_in(kStep), whole, 1e-12) << "let go";
  EXPECT_FALSE(rig.bleeding.wound(id).pressed);
  rig.bleeding.press(rig.rest.vertices[kTop], 0.5 * std::sqrt(1e-5 / 3.14159265), 1e5);
  EXPECT_NEAR(rig.lost_in(kStep), 0.75 * whole, 1e-9) << "a tip of half the wound's radius";
}

TEST(Bleeding, AnArteryTakesMoreThanItsPressure) {
  Rig rig(steady(), artery());
  ASSERT_EQ(rig.bleeding.cut_vessel(0, 0.5, {0, {1, 0, 0}}, {0, {1, 0, 0}}), 0);
  const Vec3 place = rig.rest.vertices[static_cast<std::size_t>(rig.rest.triangles[0][0])];
  const auto pressed = [&](double mmhg) {
    const double before = rig.bleeding.ledger().lost_ml;
    for (int i = 0; i < 80; ++i) {  // a beat
      rig.bleeding.press(place, 0.005, mmhg * kMmHg);
      rig.bleeding.step(rig.rest.vertices, kStep);
    }
    return rig.bleeding.ledger().lost_ml - before;
  };
  const double whole = pressed(0);
  EXPECT_GT(whole * 60 / 0.8, 10) << "mL/min";
  EXPECT_LT(pressed(50), 0.8 * whole);
  EXPECT_GT(pressed(85), 0) << "in systole";
  EXPECT_EQ(pressed(110), 0);
}

TEST(Bleeding, ACutArteryIsClippedOrSealedAtEitherEnd) {
  Rig rig(steady(), artery());
  const WoundId first = rig.bleeding.cut_vessel(0, 0.5, {0, {1, 0, 0}}, {9, {1, 0, 0}});
  ASSERT_EQ(first, 0);
  ASSERT_EQ(rig.bleeding.wounds(), 2U);
  EXPECT_EQ(rig.bleeding.cut_vessel(0, 0.5, {0, {1, 0, 0}}, {9, {1, 0, 0}}), 0) << "once";
  rig.run(1);
  EXPECT_GT(rig.bleeding.wound(0).lost_ml, 0);
  EXPECT_GT(rig.bleeding.wound(1).lost_ml, 0) << "back through the bed";
  rig.bleeding.coagulate(first, 1);
  const double before = rig.bleeding.wound(0).lost_ml, other = rig.bleeding.wound(1).lost_ml;
  rig.run(1);
  EXPECT_EQ(rig.bleeding.wound(0).lost_ml, before);
  EXPECT_GT(rig.bleeding.wound(1).lost_ml, other);
  rig.bleeding.clip_vessel(0, 0.9, 1);
  EXPECT_EQ(rig.lost_in(1), 0);
  expect_closed(rig.bleeding.ledger());
}

TEST(Bleeding, ArteriesSpurtInThePulseAndDropsComeDown) {
  Rig rig(steady(), artery());
  rig.bleeding.cut_vessel(0, 0.02, {0, {1, 0, 0}}, {0, {1, 0, 0}});
  double least = 1e9, most = 0, before = 0, highest = 0;
  std::size_t drops = 0;
  for (int i = 0; i < 300; ++i) {
    rig.bleeding.step(rig.rest.vertices, kStep);
    const double lost = rig.bleeding.ledger().lost_ml;
    if (i > 0) least = std::min(least, lost - before), most = std::max(most, lost - before);
    before = lost;
    drops = std::max(drops, rig.bleeding.drops().size());
    for (const BloodDrop& drop : rig.bleeding.drops())
      highest = std::max(highest, (drop.place_T - Vec3(0, 0, 0.05)).norm() - 0.05);
    expect_closed(rig.bleeding.ledger());
  }
  EXPECT_GT(most, 1.15 * least);
  EXPECT_GT(drops, 3U);
  EXPECT_LE(drops, BloodDrops::kMost);
  EXPECT_GT(highest, 0.02);
  rig.bleeding.clip_vessel(0, 0.01, 1);
  rig.bleeding.clip_vessel(0, 0.5, 1);
  rig.run(3);
  EXPECT_TRUE(rig.bleeding.drops().empty());
  EXPECT_EQ(rig.bleeding.ledger().air_ml, 0);
  expect_closed(rig.bleeding.ledger());
}

TEST(Bleeding, ADropFliesAParabolaAndLandsWhereItMeetsTheSurface) {
  const TriangleSurface ball = organ();
  SurfaceFilm film(ball);
  BloodDrops drops;
  const Vec3 start(0.01, 0, 0.11), speed(0.1, 0.05, 1.0);
  ASSERT_TRUE(drops.launch({start, speed, 1e-8, 0}));
  for (int i = 0; i < 15; ++i) drops.step(ball.vertices, kStep, film);
  ASSERT_EQ(drops.drops().size(), 1U);
  const Vec3 expected = start + 0.15 * speed - Vec3(0, 0, kGravity * 0.15 * 0.15 / 2);
  EXPECT_LT((drops.drops()[0].place_T - expected).norm(), 1e-12);
  for (int i = 0; i < 50; ++i) drops.step(ball.vertices, kStep, film);
  EXPECT_TRUE(drops.drops().empty());
  EXPECT_NEAR(film.account().film.blood, 1e-8, 1e-20);
  EXPECT_EQ(film.account().pool.blood, 0);
  Vec3 landed = Vec3::Zero();
  for (std::size_t v = 0; v < ball.vertices.size(); ++v)
    if (film.at(static_cast<std::int32_t>(v)).blood > 0) landed = ball.vertices[v];
  EXPECT_GT(landed.x(), 0.02);
  EXPECT_GT(landed.z(), 0.08);
  drops.launch({{0.2, 0, 0.1}, Vec3::Zero(), 1e-8, 0});
  for (int i = 0; i < 50; ++i) drops.step(ball.vertices, kStep, film);
  EXPECT_NEAR(film.account().pool.blood, 1e-8, 1e-20) << "beside the organ";
  SurfaceFilm high(ball, {.floor_m = -1000});
  drops.launch({{0.2, 0, 0.1}, Vec3::Zero(), 1e-8, 0});
  for (int i = 0; i < 250; ++i) drops.step(ball.vertices, kStep, high);
  EXPECT_NEAR(high.account().pool.blood, 1e-8, 1e-20) << "out of the scene";
}

TEST(Bleeding, PressureFallsWithTheBloodThatIsLost) {
  BleedingOptions options = steady();
  options.circulation.blood_m3 = 1e-5;
  Rig rig(options, 3);
  const std::array<std::int32_t, 1> top = {kTop};
  rig.bleeding.add_wound(top, 1e-3, 0.002);
  rig.run(60);
  EXPECT_NEAR(rig.bleeding.ledger().lost_ml, 5, 0.2) << "half of 10 mL: bled out";
  EXPECT_LT(rig.bleeding.circulation().mean_arterial_pa(), 16 * kMmHg);
}

TEST(Bleeding, IrrigationAndSuctionClearTheField) {
  Rig rig(steady());
  const std::array<std::int32_t, 1> top = {kTop};
  const WoundId id = rig.bleeding.add_wound(top, 1e-4, 0.002);
  rig.run(20);
  rig.bleeding.coagulate(id, 1);
  const float before = rig.bleeding.blood()[kTop];
  for (int i = 0; i < 500; ++i) {
    rig.bleeding.irrigate({.tip_T = {0, 0, 0.13}, .direction_T = {0, 0, -1}});
    rig.bleeding.suck({.tip_T = {0, 0, 0.101}, .radius_m = 0.01});
    rig.bleeding.step(rig.rest.vertices, kStep);
  }
  EXPECT_GT(before, 0.5F);
  EXPECT_LT(rig.bleeding.blood()[kTop], 0.1F);
  const BloodLedger ledger = rig.bleeding.ledger();
  EXPECT_NEAR(ledger.water_given_ml, 16.7 * 5, 1e-6);
  EXPECT_GT(ledger.water_sucked_ml, 1);
  EXPECT_GT(ledger.sucked_ml, 0);
  expect_closed(ledger);
}

/// A surface whose n-th triangle is split at its middle, and where the new vertex comes from.
std::vector<VertexOrigin> split(TriangleSurface& surface, std::size_t n) {
  const auto [a, b, c] = surface.triangles[n];
  const auto fresh = static_cast<std::int32_t>(surface.vertices.size());
  const auto& at = surface.vertices;
  surface.vertices.push_back((at[static_cast<std::size_t>(a)] + at[static_cast<std::size_t>(b)]) / 2);
  surface.vertices.push_back((surface.vertices.back() + at[static_cast<std::size_t>(c)]) / 2);
  surface.triangles[n] = {a, b, fresh + 1};
  surface.triangles.push_back({b, c, fresh + 1});
  surface.triangles.push_back({c, a, fresh + 1});
  surface.triangles.push_back({a, fresh, b});  // without area
  return {{a, b, 0.5}, {fresh, c, 0.5}};
}

struct Fuzzed {
  explicit Fuzzed(int operations) : rest(organ(3)), now(rest.vertices), bleeding(rest, {}, network()) {
    for (int i = 0; i < operations; ++i) {
      operate();
      largest_gap = std::max({largest_gap, std::abs(bleeding.ledger().blood_missing_ml()),
                              std::abs(bleeding.ledger().water_missing_ml())});
    }
  }
  static VesselFlow network() {
    VesselFlow flow = artery();
    for (int i = 0; i < 4; ++i) {
      flow.add_node({.capillary_m3_per_pa_s = 1e-11});
      flow.add_vessel({1, 2 + i, 0.4e-3, 0.02});
    }
    return flow;
  }
  double unit() { return static_cast<double>(random()) / 4294967295.0; }
  MaterialPoint place() { return {static_cast<std::int32_t>(random() % rest.triangles.size()), {0.2, 0.3, 0.5}}; }
  Vec3 somewhere() { return now[random() % now.size()]; }
  void operate() {
    switch (random() % 12) {
      case 0:
        bleeding.add_wound(place(), 1e-5 * unit(), 0.03 * unit());
        break;
      case 1:
        bleeding.coagulate(somewhere(), 0.01, unit());
        break;
      case 2:
        bleeding.press(somewhere(), 0.01, 2e4 * unit());
        break;
      case 3:
        bleeding.irrigate({.tip_T = somewhere() + Vec3(0, 0, 0.02)});
        break;
      case 4:
        bleeding.suck({.tip_T = somewhere()});
        break;
      case 5:
        if (random() % 40 == 0) bleeding.cut_vessel(static_cast<std::int32_t>(random() % 5), unit(), place(), place());
        break;
      case 6:
        if (random() % 40 == 0) bleeding.clip_vessel(static_cast<std::int32_t>(random() % 5), unit(), 1.2 * unit());
        break;
      case 7:
        if (bleeding.wounds() > 0 && random() % 8 == 0)
          bleeding.clip_wound(static_cast<WoundId>(random() % bleeding.wounds()), unit());
        break;
      case 8:
        grow();
        break;
      default:
        if (random() % 20 == 0)
          for (Vec3& p : now) p += 2e-4 * Vec3(unit() - 0.5, unit() - 0.5, unit() - 0.5);
        bleeding.step(now, kStep);
    }
  }
  void grow() {
    if (random() % 10 != 0) return;
    const std::vector<VertexOrigin> added = split(rest, random() % rest.triangles.size());
    for (const VertexOrigin& origin : added) {
      const Vec3 from = now[static_cast<std::size_t>(origin.from)], to = now[static_cast<std::size_t>(origin.to)];
      now.push_back(from + origin.share * (to - from));
    }
    bleeding.grow(rest, added);
  }
  TriangleSurface rest;
  std::vector<Vec3> now;
  Bleeding bleeding;
  std::mt19937 random{11};
  double largest_gap = 0;
};

TEST(Bleeding, TheLedgerClosesWhateverIsDone) {
  const Fuzzed fuzzed(10000);
  const BloodLedger ledger = fuzzed.bleeding.ledger();
  EXPECT_GT(ledger.lost_ml, 1);
  EXPECT_GT(ledger.sucked_ml, 0);
  EXPECT_GT(ledger.pool_ml, 0);
  EXPECT_GT(ledger.dried_ml, 0);
  EXPECT_LT(fuzzed.largest_gap, 1e-6 * std::min(ledger.lost_ml, ledger.water_given_ml));
  for (const float value : fuzzed.bleeding.blood()) ASSERT_TRUE(value >= 0 && value <= 1);
  double by_wound = 0;
  for (std::size_t i = 0; i < fuzzed.bleeding.wounds(); ++i)
    by_wound += fuzzed.bleeding.wound(static_cast<WoundId>(i)).lost_ml;
  EXPECT_NEAR(by_wound / ledger.lost_ml, 1, 1e-9);
}

TEST(Bleeding, SameInputSameBytes) {
  const Fuzzed a(3000), b(3000);
  EXPECT_EQ(a.bleeding.blood(), b.bleeding.blood());
  EXPECT_EQ(a.bleeding.wet(), b.bleeding.wet());
  EXPECT_EQ(a.bleeding.ledger().lost_ml, b.bleeding.ledger().lost_ml);
  EXPECT_EQ(a.bleeding.ledger().pool_ml, b.bleeding.ledger().pool_ml);
  ASSERT_EQ(a.bleeding.drops().size(), b.bleeding.drops().size());
  for (std::size_t i = 0; i < a.bleeding.drops().size(); ++i)
    EXPECT_EQ(a.bleeding.drops()[i].place_T, b.bleeding.drops()[i].place_T);
}

TEST(Bleeding, AResetLeavesNothing) {
  Rig used(BleedingOptions{}, artery()), fresh(BleedingOptions{}, artery());
  const auto bleed = [](Rig& rig) {
    rig.bleeding.cut_vessel(0, 0.3, {0, {1, 0, 0}}, {9, {1, 0, 0}});
    rig.bleeding.add_wound(MaterialPoint{40, {0.3, 0.3, 0.4}}, 5e-5, 0.02);
    rig.bleeding.irrigate({.tip_T = {0, 0, 0.12}});
    rig.run(2);
  };
  bleed(used);
  used.bleeding.clip_vessel(0, 0.1, 1);
  used.bleeding.irrigate({.tip_T = {0, 0, 0.12}});
  used.bleeding.reset();
  EXPECT_EQ(used.bleeding.wounds(), 0U);
  EXPECT_EQ(used.bleeding.ledger().lost_ml, 0);
  EXPECT_EQ(used.bleeding.ledger().water_given_ml, 0);
  for (const float value : used.bleeding.blood()) ASSERT_EQ(value, 0.0F);
  bleed(used);
  bleed(fresh);
  EXPECT_EQ(used.bleeding.blood(), fresh.bleeding.blood());
  EXPECT_EQ(used.bleeding.ledger().lost_ml, fresh.bleeding.ledger().lost_ml);
  EXPECT_EQ(used.bleeding.ledger().film_ml, fresh.bleeding.ledger().film_ml);
}

/// Run by hand: --gtest_also_run_disabled_tests --gtest_filter=*CostOfAStep
TEST(Bleeding, DISABLED_CostOfAStep) {
  const TriangleSurface rest = organ(6);  // 16 386 vertices
  const auto timed = [](const char* what, int count, const auto& work) {
    const std::clock_t begin = std::clock();
    for (int i = 0; i < count; ++i) work();
    const double ms = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    std::printf("%-40s %.3f ms\n", what, ms / count);
  };
  Bleeding bleeding(rest, {}, Fuzzed::network());
  std::printf("%zu vertices\n", rest.vertices.size());
  const auto step = [&] { bleeding.step(rest.vertices, kStep); };
  timed("dry", 1000, step);
  for (std::int32_t i = 0; i < 20; ++i) bleeding.add_wound(MaterialPoint{200 * i, {0.3, 0.3, 0.4}}, 2e-5, 0.002);
  timed("20 small wounds", 2000, step);
  std::printf("   %zu vertices wet, %.1f mL lost in 20 s\n", bleeding.film().wet_vertices(), bleeding.ledger().lost_ml);
  bleeding.reset();
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i)
    bleeding.add_wound(MaterialPoint{static_cast<std::int32_t>(random() % rest.triangles.size()), {0.3, 0.3, 0.4}},
                       1e-4, 0.02);
  for (int seconds = 0; seconds < 60; seconds += 10) {
    timed("20 wounds, mean of 10 s", 1000, step);
    const BloodLedger ledger = bleeding.ledger();
    std::printf("   %zu vertices wet, %.1f mL lost, %.1f film, %.1f pool, %.2f dried\n", bleeding.film().wet_vertices(),
                ledger.lost_ml, ledger.film_ml, ledger.pool_ml, ledger.dried_ml);
  }
  bleeding.cut_vessel(0, 0.5, {0, {1, 0, 0}}, {9, {1, 0, 0}});
  timed("and an artery that spurts", 500, step);
  timed("and irrigation and suction", 500, [&] {
    bleeding.irrigate({.tip_T = {0, 0, 0.14}});
    bleeding.suck({.tip_T = {0, 0, 0.1}});
    step();
  });
  std::printf("   %zu vertices wet, %zu drops\n", bleeding.film().wet_vertices(), bleeding.drops().size());
  timed("ledger", 100, [&] { bleeding.ledger(); });
  TriangleSurface grown = rest;
  timed("grow by two vertices", 20, [&] {
    const auto added = split(grown, random() % grown.triangles.size());
    bleeding.grow(grown, added);
  });
}

}  // namespace
}  // namespace trocar::bleeding_test
