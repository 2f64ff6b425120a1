// Two organs in one solve and the bed between them: what peeling takes, what it does not, and what stays.
#include "tissue/solid/organ_bed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "tests/support/repeats.h"
#include "tests/tissue/solid/bed_rig.h"

namespace trocar::organ_bed_test {
namespace {

using test::BedHand;
using test::BedScene;

constexpr double kStep = 0.010;

/// Held by its far end.
BedHand by_the_end(const SoftOrgan& organ) {
  return BedHand(
      organ, [](const Vec3& p) { return p.x() > 0.0695; }, 2000);
}
/// Held by all of its top.
BedHand by_the_top(const SoftOrgan& organ, double stiffness_n_per_m) {
  return BedHand(
      organ, [](const Vec3& p) { return p.z() > 0.0109; }, stiffness_n_per_m);
}

struct Peeled {
  double work_j = 0, most_n = 0, step_n = 0;
};
/// Lifts the end straight up until all is free.
Peeled peel(SoftOrgan& organ, double speed) {
  BedHand hand = by_the_end(organ);
  Peeled out;
  double before = 0;
  for (int i = 1; i < 4000 && organ.bed()->free_share() < 1; ++i) {
    const double force = hand.step(organ, {0, 0, speed * kStep * i}).norm();
    out.most_n = std::max(out.most_n, force);
    out.step_n = std::max(out.step_n, std::abs(force - before));
    before = force;
  }
  out.work_j = hand.work_j();
  return out;
}

TEST(OrganBed, PeelingTakesItsEnergy) {
  // Strips of any tissue and on any lattice: what the hand does is G times the area.
  for (const auto& [below, above, energy] :
       {std::array{5e3, 20e3, 40.0}, std::array{20e3, 20e3, 40.0}, std::array{5e3, 15e3, 20.0}}) {
    BedScene scene;
    scene.organ.tether_n_per_m3 = 0;
    scene.below.young_pa = below;
    scene.above.young_pa = above;
    scene.bed.energy_j_per_m2 = energy;
    SoftOrgan organ = scene.made();
    const Peeled done = peel(organ, 0.010);
    ASSERT_EQ(organ.bed()->free_share(), 1);
    EXPECT_NEAR(done.work_j / (energy * organ.bed()->area_m2()), 1, 0.10) << below << " " << above << " " << energy;
  }
}

TEST(OrganBed, ForceOnTheFoldHasNoSteps) {
  BedScene scene;
  SoftOrgan organ = scene.made();
  const Peeled done = peel(organ, 0.010);
  EXPECT_LT(done.step_n / (kStep * 1e3), 0.3);
  // The capsule of the liver bears more than that along a fold of 25 mm (instrument_actions.h).
  EXPECT_LT(done.most_n, scene.below.rupture_n_per_m * 0.025);
}

TEST(OrganBed, BearsItsStrengthAndNoMore) {
  // Hard blocks, so that the lattice resolves it and all of the bed bears alike.
  BedScene scene;
  scene.below.young_pa = scene.above.young_pa = 1e6;
  scene.organ.bed_n_per_m3 = 1e9;
  scene.organ.solid.tolerance = 1e-4;
  scene.organ.solid.most_iterations = 500;
  SoftOrgan organ = scene.made();
  ASSERT_NEAR(organ.bed()->strength_pa(), scene.bed.strength_pa, 1e-9);
  BedHand hand = by_the_top(organ, 1e6);
  double most = 0;
  for (int i = 1; i < 1000 && organ.bed()->free_share() < 1; ++i)
    most = std::max(most, hand.step(organ, {0, 0, 0.001 * kStep * i}).z());
  EXPECT_NEAR(most / organ.bed()->area_m2() / scene.bed.strength_pa, 1, 0.05);
}

TEST(OrganBed, LessThanTheStrengthLeavesNothing) {
  BedScene scene;
  SoftOrgan organ = scene.made();
  const std::vector<Vec3f> before(organ.solid().position().begin(), organ.solid().position().end());
  {
    BedHand hand = by_the_top(organ, 400);
    for (int i = 1; i <= 300; ++i) hand.step(organ, {0, 0, 0.008 * std::sin(i * 0.01)});
    EXPECT_EQ(organ.bed()->damage_share(), 0);
    EXPECT_EQ(organ.bed()->free_share(), 0);
  }
  for (int i = 0; i < 800; ++i) organ.step({}, nullptr);
  double off = 0;
  for (std::size_t n = 0; n < before.size(); ++n)
    off = std::max(off, double((organ.solid().position()[n] - before[n]).norm()));
  EXPECT_LT(off, 1e-4);
}

TEST(OrganBed, ClosedPathGivesNoEnergyOut) {
  BedScene scene;
  SoftOrgan organ = scene.made();
  BedHand hand = by_the_top(organ, 400);
  // From rest a circle and back, aslant, so that the bed is opened, pressed and slid.
  for (int i = 1; i <= 200; ++i) {
    const double turn = 2 * std::numbers::pi * i / 200;
    hand.step(organ, {0.003 * std::sin(turn), 0.002 * (1 - std::cos(turn)), 0.003 * std::sin(turn)});
  }
  EXPECT_EQ(organ.bed()->damage_share(), 0);
  EXPECT_GE(hand.work_j(), 0);
  EXPECT_LT(hand.work_j(), 5e-3);
}

TEST(OrganBed, WhatIsPeeledOffDoesNotSinkIn) {
  BedScene scene;
  SoftOrgan organ = scene.made();
  peel(organ, 0.05);
  ASSERT_EQ(organ.bed()->free_share(), 1);
  for (int i = 0; i < 300; ++i) organ.step({}, nullptr);  // its tether brings it back
  BedHand hand = by_the_top(organ, 300);
  Vec3 force;
  for (int i = 0; i <= 200; ++i) force = hand.step(organ, {0, 0, -0.00005 * i});
  EXPECT_LT(force.z(), -0.5);
  // Every vertex of the upper block is still above what of the lower one is under it.
  const SurfaceSnapshot& now = *organ.surface();
  const std::size_t first = scene.lower()->vertices.size();
  double deepest = 0;
  for (std::size_t v = first; v < now.vertices.size(); ++v) {
    const auto under = std::min_element(
        now.vertices.begin(), now.vertices.begin() + std::ptrdiff_t(first),
        [&](const Vec3& a, const Vec3& b) { return (a - now.vertices[v]).norm() < (b - now.vertices[v]).norm(); });
    if ((*under - now.vertices[v]).head<2>().norm() < 0.002)
      deepest = std::max(deepest, under->z() - now.vertices[v].z());
  }
  EXPECT_GT(organ.bed()->contacts(), 20u);
  EXPECT_LT(deepest, 0.0015);
}

TEST(OrganBed, HeatWeakensAndTheHookVaporises) {
  BedScene scene;
  SoftOrgan whole = scene.made(), cooked = scene.made();
  for (std::size_t i = 0; i < cooked.bed()->links().size(); ++i) cooked.bed()->soften(i, 1);
  EXPECT_LT(peel(cooked, 0.010).most_n, 0.5 * peel(whole, 0.010).most_n);

  SoftOrgan hooked = scene.made();
  const int count = hooked.bed()->vaporise({0.04, 0, 0.0005}, 0.004, *hooked.surface());
  EXPECT_GT(count, 4);
  EXPECT_LT(count, 14);
  // None goes at once.
  hooked.step({}, nullptr);
  EXPECT_EQ(hooked.bed()->free_share(), 0);
  for (int i = 0; i < 3; ++i) hooked.step({}, nullptr);
  int free = 0;
  for (const OrganBed::Link& link : hooked.bed()->links()) free += link.free();
  EXPECT_EQ(free, count);
}

TEST(OrganBed, ACutGoesIntoOneOfTheOrgans) {
  BedScene scene;
  SoftOrgan organ = scene.made();
  const auto cells = organ.solid().cell_count();
  const OrganCut cut = organ.cut(track_blade({0.03, 0, 0.011}, {0.05, 0, 0.011}, -Vec3::UnitZ(), 0.006, 0.01));
  ASSERT_EQ(cut.refusal, CutRefusal::kNone);
  EXPECT_GT(organ.solid().cell_count(), cells);
  const std::size_t first = scene.lower()->vertices.size();
  for (std::size_t v = 0; v < organ.rest()->vertices.size(); ++v) {
    const auto t = std::find_if(organ.rest()->triangles.begin(), organ.rest()->triangles.end(),
                                [&](const auto& triangle) { return triangle[0] == std::int32_t(v); });
    if (t == organ.rest()->triangles.end()) continue;
    EXPECT_EQ(organ.part_of(std::int32_t(t - organ.rest()->triangles.begin())), v < first ? 0 : 1);
  }
  // Cut, it is peeled off as before.
  peel(organ, 0.05);
  EXPECT_EQ(organ.bed()->free_share(), 1);
}

/// A hand that takes hold at random, pulls, presses and lets go.
void pull_at_random(SoftOrgan& organ, unsigned seed, int pulls) {
  std::mt19937 random(seed);
  const auto share = [&] { return double(random()) / 4294967296.0; };
  for (int pull = 0; pull < pulls; ++pull) {
    const double x = 0.012 + 0.056 * share(), way = 0.06 * share() * share();
    const Vec3 direction = Vec3(share() - 0.5, share() - 0.5, share() - 0.3).normalized();
    BedHand hand(
        organ, [&](const Vec3& p) { return std::abs(p.x() - x) < 0.006; }, 50 + 1000 * share());
    if (hand.places() == 0) continue;
    const int steps = 1 + int(4 * share());
    for (int i = 1; i <= steps; ++i) {
      hand.step(organ, way * i / steps * direction);
      if (share() < 0.02) organ.bed()->vaporise({x, 0, 0}, 0.004, *organ.surface());
    }
  }
}

TEST(OrganBed, BearsRandomPulls) {
  BedScene scene;
  const int rounds = test::repeats("BED_ROUNDS", 8);
  for (int round = 0; round < rounds; ++round) {
    SoftOrgan organ = scene.made();
    pull_at_random(organ, unsigned(round), 100);
    for (const Vec3f& p : organ.solid().position()) {
      ASSERT_TRUE(p.allFinite());
      ASSERT_LT(p.norm(), 1);
    }
    ASSERT_GE(organ.bed()->damage_share(), organ.bed()->free_share());
    ASSERT_LE(organ.bed()->damage_share(), 1);
  }
}

TEST(OrganBed, SameInputSameBytes) {
  BedScene scene;
  SoftOrgan one = scene.made(), two = scene.made();
  pull_at_random(one, 7, 60);
  pull_at_random(two, 7, 60);
  EXPECT_GT(one.bed()->damage_share(), 0);
  EXPECT_EQ(one.bed()->damage_share(), two.bed()->damage_share());
  ASSERT_EQ(one.solid().node_count(), two.solid().node_count());
  EXPECT_EQ(std::memcmp(one.solid().position().data(), two.solid().position().data(),
                        one.solid().node_count() * sizeof(Vec3f)),
            0);
}

}  // namespace
}  // namespace trocar::organ_bed_test
