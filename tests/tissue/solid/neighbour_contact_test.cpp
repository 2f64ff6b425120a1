// Still organs beside one that gives way: what stops it, what does not, and what is left of it.
#include "tissue/solid/neighbour_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "tests/tissue/solid/bed_rig.h"
#include "tests/tissue/support/shapes.h"

namespace trocar::neighbour_contact_test {
namespace {

constexpr double kStep = 0.010;

/// A block that nothing but a hand holds, its foot in z = 0; no bed.
struct BlockScene {
  Vec3 size_m{0.06, 0.06, 0.03};
  TissueSolid tissue;
  SoftOrganOptions options;

  BlockScene() {
    tissue.young_pa = 5000;
    options.bed_n_per_m3 = 0;
  }
  SoftOrgan made() const {
    const SurfacePtr rest = still_surface(
        test::divided_box({-size_m.x() / 2, -size_m.y() / 2, 0}, {size_m.x() / 2, size_m.y() / 2, size_m.z()}, 0.005));
    return SoftOrgan(build_lattice(*rest, {.cell_m = options.solid.edge_m}).lattice, rest, tissue, options);
  }
  SoftOrgan made(const TriangleSurface& still_T) const {
    SoftOrgan organ = made();
    organ.set_beside(still_T);
    return organ;
  }
};

TriangleSurface plate(double top_m) {
  return test::divided_box({-0.15, -0.15, top_m - 0.03}, {0.15, 0.15, top_m}, 0.01);
}

/// Holds the top face, at the middle of every fourth triangle, by a spring in every direction.
class TopHand {
 public:
  TopHand(const SoftOrgan& organ, double stiffness_n_per_m) {
    double top = 0;
    for (const Vec3& vertex : organ.rest()->vertices) top = std::max(top, vertex.z());
    constexpr std::size_t kEvery = 4;  // triangles: a hand of hundreds is most of the step
    for (std::size_t t = 0; t < organ.rest()->triangles.size(); t += kEvery) {
      const MaterialPoint place{std::int32_t(t), {1. / 3, 1. / 3, 1. / 3}};
      if (organ.rest_place(place).z() > top - 1e-6) places_.push_back({place, organ.shares_of(place)});
    }
    stiffness_ = stiffness_n_per_m / double(places_.size());
  }
  /// One step with the hand moved by `by` from where it took hold. @return its force on the organ, N
  Vec3 step(SoftOrgan& organ, const Vec3& by) {
    std::vector<SoftSpring> springs;
    for (const Place& p : places_)
      for (int axis = 0; axis < 3; ++axis)
        springs.push_back({p.shares, Vec3::Unit(axis), stiffness_,
                           (organ.place_T(p.place) - organ.rest_place(p.place) - by)[axis], false, 0});
    organ.step({}, nullptr, springs);
    Vec3 force = Vec3::Zero();
    for (const SoftSpring& s : springs) force -= s.force_n * s.direction;
    work_ += 0.5 * (force + force_).dot(by - by_);
    by_ = by;
    return force_ = force;
  }
  /// Moves on in a straight line.
  Vec3 go(SoftOrgan& organ, const Vec3& to, double speed_m_per_s) {
    const Vec3 from = by_;
    const int steps = std::max(1, int(std::lround((to - from).norm() / speed_m_per_s / kStep)));
    for (int i = 1; i <= steps; ++i) step(organ, from + double(i) / steps * (to - from));
    return force_;
  }
  Vec3 stay(SoftOrgan& organ, int steps) {
    for (int i = 0; i < steps; ++i) step(organ, by_);
    return force_;
  }
  double work_j() const { return work_; }

 private:
  struct Place {
    MaterialPoint place;
    NodeShares shares;
  };
  std::vector<Place> places_;
  double stiffness_ = 0, work_ = 0;
  Vec3 by_ = Vec3::Zero(), force_ = Vec3::Zero();
};

double lowest(const SoftOrgan& organ) {
  double z = 1;
  for (const Vec3& vertex : organ.surface()->vertices) z = std::min(z, vertex.z());
  return z;
}

bool same_bits(const SoftOrgan& a, const SoftOrgan& b) {
  return a.solid().node_count() == b.solid().node_count() &&
         std::memcmp(a.solid().position().data(), b.solid().position().data(),
                     a.solid().node_count() * sizeof(Vec3f)) == 0 &&
         std::memcmp(a.solid().velocity().data(), b.solid().velocity().data(),
                     a.solid().node_count() * sizeof(Vec3f)) == 0;
}

TEST(NeighbourContact, StopsABlockWithinAMillimetreAndBearsWhatPressesIt) {
  SoftOrgan organ = BlockScene().made(plate(-0.002));
  TopHand hand(organ, 1000);
  hand.go(organ, {0, 0, -0.010}, 0.050);
  const Vec3 force = hand.stay(organ, 200);
  EXPECT_LT(force.z(), -2.5);
  EXPECT_GT(lowest(organ), -0.003);
  EXPECT_LT(lowest(organ), -0.002);
  EXPECT_NEAR(organ.beside()->force_T().z() / -force.z(), 1, 0.02);
  EXPECT_GE(organ.beside()->contacts(), 100u);
}

TEST(NeighbourContact, IsThereInTimeWhateverTheSpeed) {
  for (const double speed : {0.05, 0.1, 0.3}) {
    SoftOrgan organ = BlockScene().made(plate(-0.020));
    TopHand hand(organ, 1000);
    const int steps = std::max(1, int(std::lround(0.030 / speed / kStep)));
    double least = 0;
    for (int i = 1; i < steps + 100; ++i) {
      hand.step(organ, {0, 0, -0.030 * std::min(1.0, double(i) / steps)});
      least = std::min(least, lowest(organ));
    }
    EXPECT_GT(least, -0.023) << speed;
    EXPECT_GT(lowest(organ), -0.021) << speed;
  }
}

TEST(NeighbourContact, NothingRubs) {
  SoftOrgan organ = BlockScene().made(plate(-0.002));
  TopHand hand(organ, 1000);
  hand.go(organ, {0, 0, -0.008}, 0.050);
  hand.stay(organ, 100);
  hand.go(organ, {0.030, 0, -0.008}, 0.030);
  EXPECT_LT(std::abs(organ.beside()->force_T().x()), 1e-6);
  EXPECT_LT(std::abs(hand.stay(organ, 300).x()), 0.005);
  EXPECT_GT(lowest(organ), -0.003);
}

TEST(NeighbourContact, WhatCrossesAtRestStaysWhereItIs) {
  SoftOrgan organ = BlockScene().made(plate(0.0004)), alone = BlockScene().made();
  for (int i = 0; i < 50; ++i) organ.step({}, nullptr), alone.step({}, nullptr);
  EXPECT_EQ(organ.beside()->neighbours(), 1u);
  EXPECT_TRUE(same_bits(organ, alone));
  EXPECT_EQ(organ.beside()->contacts(), 0u);
  // And no deeper: it is stopped from there.
  TopHand hand(organ, 1000);
  hand.go(organ, {0, 0, -0.005}, 0.050);
  EXPECT_LT(hand.stay(organ, 100).z(), -1.5);
  EXPECT_GT(lowest(organ), -0.001);
}

TEST(NeighbourContact, BitsAreTheSameUntilSomethingTouches) {
  SoftOrgan alone = BlockScene().made(), beside = BlockScene().made(plate(-0.010)),
            far = BlockScene().made(plate(-0.5));
  for (SoftOrgan* organ : {&alone, &beside, &far}) {
    TopHand hand(*organ, 500);
    hand.go(*organ, {0.004, 0.002, -0.006}, 0.040);
  }
  EXPECT_TRUE(same_bits(alone, beside));
  EXPECT_TRUE(same_bits(alone, far));
  EXPECT_EQ(far.beside()->looked_at(), 0u);
}

TEST(NeighbourContact, GivesNoEnergyOnAClosedPath) {
  for (const double speed : {0.080, 0.008})
    for (const bool round : {false, true}) {
      SoftOrgan organ = BlockScene().made(round ? test::sphere({0.005, 0.003, -0.052}, 0.05, 5) : plate(-0.002));
      TopHand hand(organ, 1000);
      for (int turn = 0; turn < 2; ++turn) {
        const double before = hand.work_j();
        for (const Vec3& to : {Vec3(0, 0, -0.008), Vec3(0.020, 0, -0.008), Vec3(0.020, 0.015, -0.006),
                               Vec3(0, 0, -0.009), Vec3(0, 0, 0.002), Vec3(0, 0, 0)})
          hand.go(organ, to, speed);
        EXPECT_GT(hand.work_j(), before) << round << " " << speed;
      }
    }
}

TEST(NeighbourContact, AThrownBlockComesBackWithLess) {
  BlockScene scene;
  scene.tissue.prony = {};  // what relaxes is no part of the energy that is told
  SoftOrgan organ = scene.made(test::sphere({0.01, 0, -0.060}, 0.05, 5));
  {
    TopHand hand(organ, 1000);
    hand.go(organ, {0, 0, -0.006}, 0.150);
  }
  double before = 0, first = 0;
  bool met = false;
  for (int i = 0; i < 200; ++i) {
    organ.step({}, nullptr);
    const double now = organ.solid().energy_j() + organ.beside()->energy_j();
    if (i == 0) first = before = now;
    EXPECT_LE(now, before + 0.01 * first) << i;
    before = now;
    met = met || organ.beside()->contacts() > 0;
  }
  EXPECT_TRUE(met);
  EXPECT_LT(before, 0.5 * first);
}

TEST(NeighbourContact, LeavesNothingBehindAndHoldsNothingBack) {
  SoftOrgan organ = BlockScene().made(plate(-0.001));
  TopHand hand(organ, 1000);
  hand.go(organ, {0, 0, -0.008}, 0.050);
  hand.stay(organ, 50);
  // Lifted off at once: no step in which the plate pulls more than a breath.
  double pull = 0;
  for (int i = 1; i <= 20; ++i) {
    hand.step(organ, {0, 0, -0.008 + 0.001 * i});
    pull = std::max(pull, -organ.beside()->force_T().z());
  }
  EXPECT_LT(pull, 0.1);
  hand.go(organ, {0, 0, 0}, 0.050);
  hand.stay(organ, 600);
  EXPECT_TRUE(organ.solid().ties().empty());
  EXPECT_EQ(organ.beside()->energy_j(), 0);
  for (std::size_t n = 0; n < organ.solid().node_count(); ++n)
    ASSERT_LT((organ.solid().position()[n] - organ.solid().rest()[n]).norm(), 2e-5);
}

TEST(NeighbourContact, ANeighbourThatMovesTakesItAlong) {
  SoftOrgan organ = BlockScene().made(plate(0));
  TopHand hand(organ, 20);
  double energy = 0;
  for (int i = 1; i <= 200; ++i) {
    const double up = 0.010 * std::min(1.0, i / 100.0);
    organ.carry({0, 0, up});
    hand.step(organ, Vec3::Zero());
    energy += organ.given_j();
    ASSERT_GT(lowest(organ), up - 0.0005) << i;
  }
  EXPECT_NEAR(lowest(organ), 0.010, 0.0005);
  EXPECT_NEAR(hand.stay(organ, 300).z(), -0.2, 0.02);
  EXPECT_GE(energy, 0);
}

TEST(NeighbourContact, DuctsAndWhatReachesIntoTheOrganAreLeftOut) {
  const TriangleSurface duct = test::divided_box({-0.05, -0.002, -0.008}, {0.05, 0.002, -0.004}, 0.002),
                        vein = test::divided_box({-0.01, -0.01, -0.05}, {0.01, 0.01, 0.02}, 0.005),
                        organ = plate(-0.040);
  EXPECT_EQ(BlockScene().made(duct).beside()->neighbours(), 0u);
  EXPECT_EQ(BlockScene().made(vein).beside()->neighbours(), 0u);
  EXPECT_EQ(BlockScene().made(test::joined(test::joined(duct, organ), vein)).beside()->neighbours(), 1u);
}

TEST(NeighbourContact, WhatEnclosesItDoesNotHoldIt) {
  // A body round the organ. Where it is 3 mm thick both surfaces look the same way; 10 mm deep it is no neighbour.
  for (const auto& [thick, way] : {std::pair(0.003, 0.002), std::pair(0.010, 0.015)}) {
    const TriangleSurface body =
        test::divided_box({-0.03 - thick, -0.03 - thick, -thick}, {0.03 + thick, 0.03 + thick, 0.03 + thick}, 0.005);
    SoftOrgan within = BlockScene().made(body), alone = BlockScene().made();
    EXPECT_EQ(within.beside()->neighbours(), 1u);
    for (SoftOrgan* organ : {&within, &alone}) {
      TopHand hand(*organ, 500);
      hand.go(*organ, {way, way / 4, -way}, 0.040);
      hand.go(*organ, {0, 0, way}, 0.040);
    }
    EXPECT_TRUE(same_bits(within, alone)) << thick;
  }
}

TEST(NeighbourContact, TouchesAfterACutToo) {
  SoftOrgan organ = BlockScene().made(plate(-0.002));
  TopHand hand(organ, 1000);
  hand.go(organ, {0, 0, -0.004}, 0.050);
  const double top = 0.026;
  const Blade blade = track_blade({-0.012, 0, top}, {0.012, 0, top}, -Vec3::UnitZ(), 0.006, 0.010);
  const std::size_t known = organ.surface()->vertices.size();
  ASSERT_EQ(organ.cut(blade).refusal, CutRefusal::kNone);
  ASSERT_GT(organ.surface()->vertices.size(), known);
  hand.go(organ, {0, 0, -0.010}, 0.050);
  EXPECT_LT(hand.stay(organ, 100).z(), -2);
  EXPECT_GT(lowest(organ), -0.003);
}

TEST(NeighbourContact, SameInputSameBytes) {
  const auto run = [](SoftOrgan& organ) {
    std::mt19937 random(5);
    TopHand hand(organ, 800);
    for (int i = 0; i < 12; ++i) {
      Vec3 to;
      for (int c = 0; c < 3; ++c) to[c] = 0.02 * (double(random()) / 2147483648.0 - 1);
      hand.go(organ, to, 0.2);
    }
  };
  const TriangleSurface still = test::joined(plate(-0.003), test::sphere({0, 0.07, 0.02}, 0.035, 4));
  SoftOrgan one = BlockScene().made(still), two = BlockScene().made(still);
  run(one);
  run(two);
  EXPECT_TRUE(same_bits(one, two));
  for (const Vec3f& p : one.solid().position()) ASSERT_TRUE(p.allFinite());
}

}  // namespace
}  // namespace trocar::neighbour_contact_test
