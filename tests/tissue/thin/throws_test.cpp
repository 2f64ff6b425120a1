// Throws read from where a thread lies and seen while they are tied.
#include "tissue/thin/throws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace trocar::throws_test {
namespace {

using Line = std::vector<Vec3>;

struct Limbs {
  Line a, b;
};

/// Both limbs from the stitch upwards: at each throw they meet, go round one another and part to the other's side.
/// @param throws turns with their sign. @param straight the second limb is a post
Limbs tied(const std::vector<int>& throws, bool straight = false) {
  constexpr double kApart = 0.006, kRound = 0.0015, kHigh = 0.012, kThrow = 0.006;
  constexpr int kPoints = 40;
  Limbs out;
  double side = -1;  // of limb a
  double z = 0;
  const auto put = [&](const Vec3& middle, const Vec3& off) {
    out.a.push_back(middle + (straight ? 2 : 1) * off);
    out.b.push_back(middle - (straight ? 0 : 1) * off);
  };
  for (const int turns : throws) {
    for (int i = 0; i < kPoints; ++i) {  // together
      const double s = double(i) / kPoints;
      put({0, 0, z + s * (kHigh - kThrow)}, Vec3(side * std::lerp(kApart, kRound, s), 0, 0));
    }
    // Half a turn more than whole ones: each goes to where the other was.
    const double angle = (turns > 0 ? 1 : -1) * (2 * std::abs(turns) + 1) * std::numbers::pi;
    const int count = kPoints * (std::abs(turns) + 1);
    for (int i = 0; i < count; ++i) {
      const double s = double(i) / count, at = s * angle;
      put({0, 0, z + kHigh - kThrow + s * kThrow}, side * kRound * Vec3(std::cos(at), std::sin(at), 0));
    }
    side = -side;
    z += kHigh;
    for (int i = 0; i < kPoints; ++i)
      put({0, 0, z + 0.25 * kHigh * i / kPoints}, Vec3(side * std::lerp(kRound, kApart, double(i) / kPoints), 0, 0));
    z += 0.25 * kHigh;
  }
  put({0, 0, z + 0.03}, Vec3(side * kApart, 0, 0));
  return out;
}

TEST(Throws, LinkingOfClosedLinesIsAWholeNumber) {
  const auto ring = [](const Vec3& middle, const Vec3& x, const Vec3& y) {
    Line line;
    for (int i = 0; i <= 60; ++i) {
      const double at = 2 * std::numbers::pi * i / 60;
      line.push_back(middle + std::cos(at) * x + std::sin(at) * y);
    }
    return line;
  };
  const Line a = ring({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const auto sum = [&](const Line& b) {
    double all = 0;
    for (const double part : linking(a, b)) all += part;
    return all;
  };
  const double linked = sum(ring({1, 0, 0}, {1, 0, 0}, {0, 0, 1}));
  EXPECT_NEAR(std::abs(linked), 1, 1e-9);
  EXPECT_NEAR(sum(ring({1, 0, 0}, {1, 0, 0}, {0, 0, -1})), -linked, 1e-9) << "the other way round";
  EXPECT_NEAR(sum(ring({3, 0, 0}, {1, 0, 0}, {0, 0, 1})), 0, 1e-9);
}

TEST(Throws, ReadFromWhereTheLimbsLie) {
  const auto kind = [](const std::vector<int>& throws, bool straight = false) {
    const Limbs limbs = tied(throws, straight);
    return knot_kind(read_throws(limbs.a, limbs.b));
  };
  EXPECT_EQ(kind({}), KnotKind::kNone);
  EXPECT_EQ(kind({1}), KnotKind::kHalfKnot);
  EXPECT_EQ(kind({1, -1}), KnotKind::kSquare);
  EXPECT_EQ(kind({-1, 1, -1}), KnotKind::kSquare);
  EXPECT_EQ(kind({1, 1}), KnotKind::kGranny);
  EXPECT_EQ(kind({2, -1}), KnotKind::kSurgeons);
  EXPECT_EQ(kind({-2, 1, -1}), KnotKind::kSurgeons);
  EXPECT_EQ(kind({1, -1}, true), KnotKind::kSlip);
}

TEST(Throws, AreTheSameFromWhereverOneLooks) {
  std::mt19937 random(3);
  std::normal_distribution<double> some(0, 1);
  for (const std::vector<int>& made : {std::vector<int>{1, -1}, {2, -1, 1}, {-1, -1}}) {
    Limbs limbs = tied(made);
    const std::vector<Throw> there = read_throws(limbs.a, limbs.b);
    ASSERT_EQ(there.size(), made.size());
    for (std::size_t i = 0; i < made.size(); ++i) {
      EXPECT_EQ(there[i].turns, std::abs(made[i]));
      EXPECT_EQ(there[i].sense * there[0].sense, (made[i] > 0) == (made[0] > 0) ? 1 : -1);
    }
    const Mat3 turn =
        Eigen::Quaterniond(some(random), some(random), some(random), some(random)).normalized().toRotationMatrix();
    for (Line* line : {&limbs.a, &limbs.b})
      for (Vec3& place : *line) place = turn * place + Vec3(0.1, 0.2, 0.3);
    EXPECT_EQ(read_throws(limbs.a, limbs.b), there);
    EXPECT_EQ(read_throws(limbs.b, limbs.a), there) << "whichever limb is named first";
    for (Line* line : {&limbs.a, &limbs.b})
      for (Vec3& place : *line) place.x() = -place.x();
    EXPECT_EQ(read_throws(limbs.a, limbs.b)[0].sense, -there[0].sense) << "in a mirror";
  }
}

TEST(Throws, WhatTheyHold) {
  const Throw right{1, 1}, left{1, -1}, twice{2, 1}, hitch{1, -1, true};
  const auto hold = [](const std::vector<Throw>& throws) { return holding_force(throws); };
  EXPECT_EQ(hold({}), 0);
  EXPECT_GT(hold({twice}), hold({right}));
  EXPECT_GT(hold({right, left}), hold({right, right}));
  EXPECT_GT(hold({right, right}), hold({right, hitch}));
  EXPECT_GT(hold({right, left, right}), hold({right, left}));
  EXPECT_STREQ(knot_name(knot_kind(std::vector<Throw>{twice, left})), "surgeon's knot");
}

/// A limb wound about the shaft of an instrument that points down at the origin, outwards from a stitch below it.
Line wound(double turns, double radius = 0.003) {
  Line line;
  for (int i = 0; i < 20; ++i) line.push_back({radius + 0.03 * (20 - i) / 20, 0, 0.01});
  const int count = std::max(2, int(40 * std::abs(turns)));
  for (int i = 0; i <= count; ++i) {
    const double at = 2 * std::numbers::pi * turns * i / count;
    line.push_back({radius * std::cos(at), radius * std::sin(at), 0.01 + 0.004 * i / count});
  }
  const double end = 2 * std::numbers::pi * turns;
  for (int i = 1; i <= 20; ++i) line.push_back(line.back() + 0.0015 * Vec3(std::cos(end), std::sin(end), 0));
  return line;
}

/// As it is tied with one instrument: wound, the tail taken, drawn back through. @return what was seen
std::vector<Throw> tie(const std::vector<double>& turns, bool takes = true) {
  ThrowWatch watch;
  std::vector<Throw> seen;
  Pose X;  // z of I down
  X.R.col(0) = Vec3::UnitX();
  X.R.col(1) = -Vec3::UnitY();
  X.R.col(2) = -Vec3::UnitZ();
  const Line tail{{0, 0, -0.01}, {0, 0, -0.002}, {0, 0, 0.001}};
  const auto look = [&](const Line& line, std::optional<Limb> held) {
    if (const auto made = watch.step({line, tail, X, held})) seen.push_back(*made);
  };
  for (const double all : turns) {
    for (int i = 0; i <= 20; ++i) look(wound(all * i / 20), std::nullopt);
    for (int i = 0; i < 5; ++i) look(wound(all), takes ? std::optional(Limb::kTail) : std::nullopt);
    for (int i = 20; i >= 0; --i) {  // the turns slip off over the jaws
      Line slipped = wound(all);
      for (Vec3& place : slipped) place.z() -= 0.03 * (20 - i) / 20;
      look(slipped, takes ? std::optional(Limb::kTail) : std::nullopt);
    }
    look(wound(0), std::nullopt);
  }
  return seen;
}

TEST(ThrowWatch, SeesWhatIsTied) {
  EXPECT_EQ(knot_kind(tie({})), KnotKind::kNone);
  EXPECT_EQ(knot_kind(tie({1})), KnotKind::kHalfKnot);
  EXPECT_EQ(knot_kind(tie({1, -1})), KnotKind::kSquare);
  EXPECT_EQ(knot_kind(tie({1, 1})), KnotKind::kGranny);
  EXPECT_EQ(knot_kind(tie({2, -1, 1})), KnotKind::kSurgeons);
  EXPECT_EQ(tie({2})[0].turns, 2);
  EXPECT_TRUE(tie({1, -1}, false).empty()) << "wound and unwound, nothing taken";
  EXPECT_TRUE(tie({0.3}).empty()) << "not once round";
}

TEST(ThrowWatch, LettingGoBeforeTheTurnsAreOffMakesNoThrow) {
  ThrowWatch watch;
  Pose X;
  X.R << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  const Line tail{{0, 0, -0.01}, {0, 0, 0.001}}, line = wound(1);
  watch.step({line, tail, X, std::nullopt});
  watch.step({line, tail, X, Limb::kTail});
  EXPECT_TRUE(watch.caught());
  EXPECT_FALSE(watch.step({line, tail, X, std::nullopt}));
  EXPECT_FALSE(watch.caught());
}

TEST(ThrowWatch, ItsSenseIsThatOfTheLinking) {
  // What is seen while it is tied and what is read from where both lie when the tail is drawn through the turns.
  for (const double turns : {1.0, -1.0, 2.0}) {
    const std::vector<Throw> seen = tie({turns});
    ASSERT_EQ(seen.size(), 1U);
    const Line around = wound(turns);
    const Line tail{{0, 0, -0.03}, {0, 0, 0.0}, {0, 0, 0.03}, {0, 0, 0.06}};  // drawn up, through them
    double sum = 0;
    for (const double part : linking(around, tail)) sum += part;
    EXPECT_EQ(seen[0].sense, sum > 0 ? 1 : -1);
  }
}

}  // namespace
}  // namespace trocar::throws_test
