// The elastic rod against closed forms, against itself, and against everything that may be thrown at it.
#include "tissue/thin/elastic_rod.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "haptics/input_error.h"

namespace trocar::elastic_rod_test {
namespace {

constexpr double kLength = 0.040;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<Vec3> straight(std::size_t nodes = 41, double length = kLength) {
  std::vector<Vec3> path;
  for (std::size_t i = 0; i < nodes; ++i)
    path.push_back({length * static_cast<double>(i) / static_cast<double>(nodes - 1), 0, 0});
  return path;
}

/// Linear material, drawn without tension.
RodOptions plain() {
  RodOptions options;
  options.stiffening = options.pre_strain = 0;
  options.avulsion_n = 1e6;
  return options;
}

double area(const RodOptions& o) {
  return std::numbers::pi * (std::pow(o.outer_radius_m, 2) - std::pow(o.inner_radius_m(), 2));
}
double bending(const RodOptions& o) {
  return o.young_pa * std::numbers::pi / 4 * (std::pow(o.outer_radius_m, 4) - std::pow(o.inner_radius_m(), 4));
}

ElasticRod hung_at_start(const RodOptions& options, double stiffness = 1e6, std::size_t nodes = 41) {
  ElasticRod rod(straight(nodes), options);
  rod.anchor(RodEnd::kStart, {.stiffness_n_per_m = stiffness});
  return rod;
}

ElasticRod hung_at_both(const RodOptions& options, bool clamped = true, std::size_t nodes = 41) {
  ElasticRod rod(straight(nodes), options);
  rod.anchor(RodEnd::kStart, {.clamped = clamped});
  rod.anchor(RodEnd::kFinish, {.position = {kLength, 0, 0}, .clamped = clamped});
  return rod;
}

/// Constant force on a place: a spring so long that its force does not change.
RodSpring dead_load(double arc, const Vec3& force) {
  return {.arc_m = arc, .direction = -force.normalized(), .stiffness_n_per_m = 1e-6, .stretch_m = force.norm() / 1e-6};
}

TEST(ElasticRod, RefusesWhatIsNoRod) {
  EXPECT_THROW(ElasticRod(std::vector<Vec3>{{0, 0, 0}}, {}), InputError);
  EXPECT_THROW(ElasticRod(std::vector<Vec3>{{0, 0, 0}, {0, 0, 0}}, {}), InputError);
  EXPECT_THROW(ElasticRod(std::vector<Vec3>{{0, 0, 0}, {kNan, 0, 0}}, {}), InputError);
  RodOptions no_wall;
  no_wall.wall_m = 0;
  EXPECT_THROW(ElasticRod(straight(), no_wall), InputError);
}

TEST(ElasticRod, GradientOfABendIsItsFiniteDifference) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto frame_of = [](const Vec3& edge, double turn, const SegmentFrame& from) {
    SegmentFrame f{edge.normalized(), {}, {}, edge.norm()};
    const Vec3 d = carried_over(from.d1, from.t, f.t);
    f.d1 = std::cos(turn) * d + std::sin(turn) * f.t.cross(d);
    f.d2 = f.t.cross(f.d1);
    return f;
  };
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 ea(any(random), any(random), 1.5 + any(random)), eb(any(random), any(random), 1.5 + any(random));
    const SegmentFrame a = frame_of(ea, any(random), {}), b = frame_of(eb, any(random), {});
    const BendStrain here = bend_strain(a, b, 0);
    const BendGradient g = bend_gradient(a, b, here);
    EXPECT_NEAR(bend_strain(a, b, here[2] + 6 * std::numbers::pi)[2], here[2] + 6 * std::numbers::pi, 1e-9);
    constexpr double kStep = 1e-6;
    for (int c = 0; c < 3; ++c) {
      const Vec3 way = kStep * Vec3::Unit(c);
      const BendStrain da =
          (bend_strain(frame_of(ea + way, 0, a), b, here[2]) - bend_strain(frame_of(ea - way, 0, a), b, here[2])) /
          (2 * kStep);
      const BendStrain db =
          (bend_strain(a, frame_of(eb + way, 0, b), here[2]) - bend_strain(a, frame_of(eb - way, 0, b), here[2])) /
          (2 * kStep);
      EXPECT_LT((da - g.by_a.col(c)).norm(), 1e-7);
      EXPECT_LT((db - g.by_b.col(c)).norm(), 1e-7);
    }
    const BendStrain ta =
        (bend_strain(frame_of(ea, kStep, a), b, here[2]) - bend_strain(frame_of(ea, -kStep, a), b, here[2])) /
        (2 * kStep);
    const BendStrain tb =
        (bend_strain(a, frame_of(eb, kStep, b), here[2]) - bend_strain(a, frame_of(eb, -kStep, b), here[2])) /
        (2 * kStep);
    EXPECT_LT((ta - g.by_turn_a).norm(), 1e-7);
    EXPECT_LT((tb - g.by_turn_b).norm(), 1e-7);
  }
}

TEST(ElasticRod, CantileverBendsLikeEulerAndBernoulli) {
  for (const std::size_t nodes : {11u, 21u, 41u}) {
    const RodOptions o = plain();
    ElasticRod rod = hung_at_start(o, 1e6, nodes);
    const double wanted = 0.01 * kLength;  // small, so that the linear theory holds
    std::vector<RodSpring> load{dead_load(kLength, {0, 0, -3 * bending(o) * wanted / std::pow(kLength, 3)})};
    rod.settle(load, 1e-10);
    EXPECT_NEAR(-rod.nodes().back().position.z() / wanted, 1, nodes == 11 ? 0.03 : 0.01) << nodes;
  }
}

TEST(ElasticRod, StretchesByForceOverEA) {
  const RodOptions o = plain();
  ElasticRod rod = hung_at_start(o);
  const double force = 0.05 * o.young_pa * area(o);
  std::vector<RodSpring> load{dead_load(kLength, {force, 0, 0})};
  rod.settle(load);
  EXPECT_NEAR((rod.nodes().back().position.x() - kLength) / (0.05 * kLength), 1, 0.005);
  EXPECT_NEAR(rod.segments()[20].tension_n, force, 1e-4 * force);
  EXPECT_LT((rod.anchor_load(RodEnd::kStart).force - Vec3(force, 0, 0)).norm(), 1e-4 * force);
}

TEST(ElasticRod, StiffensExponentiallyUpToItsMost) {
  RodOptions o = plain();
  o.stiffening = 4;
  for (const double strain : {0.2, 0.4, 0.9}) {
    ElasticRod rod = hung_at_start(o);
    const double bend = std::log(o.most_stiffening) / o.stiffening;
    const double law = strain < bend ? std::expm1(4 * strain) / 4 : 7.0 / 4 + 8 * (strain - bend);
    std::vector<RodSpring> load{dead_load(kLength, {law * o.young_pa * area(o), 0, 0})};
    rod.settle(load);
    EXPECT_NEAR(rod.nodes().back().position.x() / kLength - 1, strain, 0.005 * strain);
  }
}

/// Tip of an inextensible cantilever under a load across, in lengths: x along, y across. By shooting on the slope.
std::pair<double, double> elastica(double load) {
  const auto shoot = [&](double curvature, double& x, double& y) {
    double angle = 0, k = curvature;
    x = y = 0;
    constexpr int kSteps = 2000;
    constexpr double ds = 1.0 / kSteps;
    for (int i = 0; i < kSteps; ++i) {  // angle'' = -load cos angle, midpoint
      const double half = angle + 0.5 * ds * k, k_half = k - 0.5 * ds * load * std::cos(angle);
      angle += ds * k_half;
      k -= ds * load * std::cos(half);
      x += ds * std::cos(half);
      y += ds * std::sin(half);
    }
    return k;  // without moment at the tip it is zero
  };
  double low = 0, high = load, x = 0, y = 0;
  for (int i = 0; i < 80; ++i) {
    const double middle = (low + high) / 2;
    (shoot(middle, x, y) > 0 ? high : low) = middle;
  }
  return {x, y};
}

TEST(ElasticRod, BendsFarLikeTheElastica) {
  RodOptions o = plain();
  o.wall_m = o.outer_radius_m = 0.0008;  // so slender that it hardly stretches
  for (const double load : {1.0, 3.0, 8.0}) {
    const auto [x, y] = elastica(load);
    ElasticRod rod = hung_at_start(o);
    std::vector<RodSpring> springs{dead_load(kLength, {0, 0, load * bending(o) / (kLength * kLength)})};
    rod.settle(springs, 1e-9, 2000);
    const Vec3 tip = rod.nodes().back().position / kLength;
    EXPECT_NEAR(tip.x(), x, 0.02 * x) << load;
    EXPECT_NEAR(tip.z(), y, 0.02 * y) << load;
  }
}

TEST(ElasticRod, TwistsByMomentOverGJAndRemembersItsOwnTurns) {
  const RodOptions o = plain();
  ElasticRod rod = hung_at_both(o);
  // The far anchor turns once and a quarter about the axis in small steps.
  const double total = 2.5 * std::numbers::pi;
  for (int i = 1; i <= 100; ++i) {
    rod.anchor(RodEnd::kFinish, {.position = {kLength, 0, 0},
                                 .rotation = Eigen::AngleAxisd(total * i / 100, Vec3::UnitX()).toRotationMatrix()});
    rod.settle();
  }
  const double moment = bending(o) / (1 + o.poisson) * total / kLength;
  EXPECT_NEAR(rod.anchor_load(RodEnd::kStart).moment.x(), moment, 0.01 * moment);
  EXPECT_NEAR(rod.anchor_load(RodEnd::kFinish).moment.x(), -moment, 0.01 * moment);
}

TEST(ElasticRod, ADrawnBowIsAtRest) {
  std::vector<Vec3> bow;
  for (int i = 0; i <= 30; ++i) bow.push_back({0.02 * std::cos(0.1 * i), 0.02 * std::sin(0.1 * i), 0.002 * i});
  ElasticRod rod(bow, plain());
  rod.anchor(RodEnd::kStart, {.position = bow.front()});
  for (int i = 0; i < 200; ++i) rod.step();
  for (const RodNode& node : rod.nodes()) EXPECT_LT((node.position - node.drawn).norm(), 1e-9);
  EXPECT_LT(rod.energy_j(), 1e-15);
}

TEST(ElasticRod, SagsBetweenTwoEndsLikeABeamAndLikeAString) {
  RodOptions o = plain();
  o.gravity_m_s2 = {0, 0, -0.05};  // small, so that it stays a beam
  ElasticRod beam = hung_at_both(o);
  beam.settle({}, 1e-11);
  const double weight = beam.mass_kg() * 0.05;
  const double sag = -beam.place_at(kLength / 2).z() + beam.place_at(0).z();
  EXPECT_NEAR(sag, weight * std::pow(kLength, 3) / (384 * bending(o)), 0.03 * sag);

  RodOptions tight = o;
  tight.pre_strain = 0.5;  // tension 0.5 E A: a string, but for its stiffness at the ends
  tight.outer_radius_m = 0.0005;
  tight.wall_m = 0.0002;
  tight.gravity_m_s2 = {0, 0, -9.81};
  ElasticRod string = hung_at_both(tight, false);
  string.settle({}, 1e-11);
  const double tension = 0.5 * tight.young_pa * area(tight);
  const double dip = -string.place_at(kLength / 2).z() + string.place_at(0).z();
  EXPECT_NEAR(dip, string.mass_kg() * 9.81 * kLength / (8 * tension), 0.03 * dip);
}

TEST(ElasticRod, LosesEnergyAndComesToRest) {
  RodOptions o;
  o.prony = {PronyBranch{0.1, 0.3}, PronyBranch{}};
  ElasticRod rod = hung_at_both(o);
  const double at_rest = rod.energy_j();
  std::vector<Vec3> pulled;
  for (const RodNode& node : rod.nodes())
    pulled.push_back(node.position + Vec3(0, 0, 0.01 * std::sin(std::numbers::pi * node.arc_m / kLength)));
  rod.place(pulled);
  rod.step();
  double before = rod.energy_j();
  const double first = before;
  EXPECT_GT(first, 1.2 * at_rest);
  for (int i = 0; i < 500; ++i) {
    rod.step();
    EXPECT_LE(rod.energy_j(), before + 1e-6 * first) << i;
    before = rod.energy_j();
  }
  for (const RodNode& node : rod.nodes()) EXPECT_LT((node.position - node.drawn).norm(), 2e-4);
}

TEST(ElasticRod, SwingsAsOftenAsAString) {
  RodOptions o = plain();
  o.pre_strain = 0.5;
  o.outer_radius_m = 0.0005;
  o.wall_m = 0.0002;
  o.mass_damping_per_s = 0;
  o.step_s = 1e-4;  // implicit Euler damps by omega h / 2 per radian
  ElasticRod rod = hung_at_both(o, false);
  std::vector<Vec3> pulled;
  for (const RodNode& node : rod.nodes())
    pulled.push_back(node.position + Vec3(0, 0, 1e-4 * std::sin(std::numbers::pi * node.arc_m / kLength)));
  rod.place(pulled);
  const double tension = 0.5 * o.young_pa * area(o);
  const double period = 2 * kLength * std::sqrt(rod.mass_kg() / kLength / tension);
  int crossings = 0, last = 0, first = 0;
  double before = 1;
  for (int i = 1; i < static_cast<int>(3 * period / o.step_s); ++i) {
    rod.step();
    const double z = rod.place_at(kLength / 2).z();
    if (z * before < 0) {
      if (crossings++ == 0) first = i;
      last = i;
    }
    before = z;
  }
  ASSERT_GE(crossings, 4);
  EXPECT_NEAR(2 * (last - first) * o.step_s / (crossings - 1) / period, 1, 0.05);
}

TEST(ElasticRod, ForcesOnItAddUpToItsMomentum) {
  RodOptions o;
  o.mass_damping_per_s = 0;
  ElasticRod rod = hung_at_both(o);
  for (int i = 0; i < 100; ++i) {
    rod.anchor(RodEnd::kStart, {.position = {0, 2e-5 * i, 0}, .velocity = {0, 2e-3, 0}});
    std::vector<RodSpring> springs{{.arc_m = 0.0133,
                                    .direction = Vec3::UnitZ(),
                                    .stiffness_n_per_m = 300,
                                    .stretch_m = rod.place_at(0.0133).z() - 0.006}};
    const Vec3 before = rod.momentum();
    rod.step(springs);
    const Vec3 sum = -springs[0].force_n * springs[0].direction - rod.anchor_load(RodEnd::kStart).force -
                     rod.anchor_load(RodEnd::kFinish).force;
    EXPECT_LT((sum - (rod.momentum() - before) / o.step_s).norm(), 1e-4 * std::max(0.01, springs[0].force_n)) << i;
  }
}

TEST(ElasticRod, MomentsOfAnchorsBalanceTheLoad) {
  const RodOptions o = plain();
  ElasticRod rod = hung_at_start(o);
  const Vec3 force(0, 0, -0.5 * bending(o) / (kLength * kLength));
  std::vector<RodSpring> load{dead_load(kLength, force)};
  rod.settle(load, 1e-11, 1000);
  const Wrench on = rod.anchor_load(RodEnd::kStart);
  const Vec3 moment = (rod.nodes().back().position - rod.nodes().front().position).cross(force);
  EXPECT_LT((on.force - force).norm(), 1e-3 * force.norm());
  EXPECT_LT((on.moment - moment).norm(), 1e-3 * moment.norm());
}

TEST(ElasticRod, TellsWhatHoldsItHowStiffItIsWithinAStep) {
  ElasticRod rod = hung_at_both({});
  for (int i = 0; i < 50; ++i) rod.step();
  ElasticRod moved = rod;
  rod.step();
  const Vec3 before = rod.anchor_load(RodEnd::kStart).force;
  const Mat3 stiffness = rod.anchor_stiffness(RodEnd::kStart);
  const Vec3 way(1e-5, 2e-5, 0);
  moved.anchor(RodEnd::kStart, {.position = way});
  moved.step();
  const Vec3 change = moved.anchor_load(RodEnd::kStart).force - before;
  EXPECT_LT((change + stiffness * way).norm(), 0.02 * change.norm());

  const double there = rod.compliance(0.02, Vec3::UnitZ());
  std::vector<RodSpring> push{dead_load(0.02, {0, 0, 0.001})};
  ElasticRod free = rod, pushed = rod;
  free.step();
  pushed.step(push);
  EXPECT_NEAR((pushed.place_at(0.02) - free.place_at(0.02)).z() / 0.001, there, 0.02 * there);
}

TEST(ElasticRod, APushingSpringDoesNotPull) {
  ElasticRod rod = hung_at_both({});
  std::vector<RodSpring> away{
      {.arc_m = 0.02, .direction = Vec3::UnitZ(), .stiffness_n_per_m = 300, .stretch_m = -0.001, .pushes_only = true}};
  rod.step(away);
  EXPECT_EQ(away[0].force_n, 0);
  EXPECT_LT(std::abs(rod.place_at(0.02).z()), 1e-9);
  away[0].stretch_m = 0.001;
  rod.step(away);
  EXPECT_GT(away[0].force_n, 0.01);
  EXPECT_LT(rod.place_at(0.02).z(), -1e-5);
}

TEST(ElasticRod, CutEndsRunBackByThePreStrain) {
  RodOptions o;
  o.pre_strain = 0.15;
  ElasticRod rod = hung_at_both(o);
  for (int i = 0; i < 20; ++i) rod.step();
  const auto at = rod.sever(0.0203);
  ASSERT_TRUE(at);
  EXPECT_NEAR(*at, 0.0203, 1e-4);
  ASSERT_EQ(rod.parts().size(), 2u);
  for (int i = 0; i < 300; ++i) rod.step();
  const Vec3 gap = rod.nodes()[rod.parts()[1].first].position - rod.nodes()[rod.parts()[0].last].position;
  EXPECT_NEAR(gap.x(), kLength - kLength / 1.15, 0.01 * gap.x());
  EXPECT_LT(rod.anchor_load(RodEnd::kStart).force.norm(), 1e-3);
}

TEST(ElasticRod, CutsKeepMassPlacesAndNames) {
  ElasticRod rod = hung_at_both({});
  const double mass = rod.mass_kg();
  const Vec3 place = rod.place_at(0.0351);
  ASSERT_TRUE(rod.sever(0.0103));
  ASSERT_TRUE(rod.sever(0.0107));
  EXPECT_NEAR(rod.mass_kg(), mass, 1e-12);
  EXPECT_LT((rod.place_at(0.0351) - place).norm(), 1e-12);
  EXPECT_EQ(rod.parts().size(), 3u);
  EXPECT_EQ(rod.nodes().size(), 45u);
  std::vector<std::int32_t> ids;
  for (const RodNode& node : rod.nodes()) ids.push_back(node.id);
  std::sort(ids.begin(), ids.end());
  for (std::size_t i = 0; i < ids.size(); ++i) EXPECT_EQ(ids[i], static_cast<std::int32_t>(i));
  int cut = 2;
  for (int i = 0; i < 40; ++i) cut += rod.sever(0.0105).has_value() ? 1 : 0;
  EXPECT_LT(cut, 8) << "slivers";
  EXPECT_FALSE(rod.sever(kNan));
}

TEST(ElasticRod, ComesOffItsAnchorAtTheLimitAndNotBelow) {
  RodOptions o;
  o.avulsion_n = 4.5;
  for (const double pull : {4.3, 4.7}) {
    ElasticRod rod = hung_at_start(o, 2000);
    std::vector<RodEvent> seen;
    for (int i = 0; i < 600; ++i) {
      std::vector<RodSpring> load{dead_load(kLength, {pull * std::min(1.0, i / 300.0), 0, 0})};
      rod.step(load);
      seen.insert(seen.end(), rod.events().begin(), rod.events().end());
    }
    ASSERT_EQ(seen.size(), pull > 4.5 ? 1u : 0u) << pull;
    EXPECT_EQ(rod.anchored(RodEnd::kStart), pull < 4.5);
    if (seen.empty()) continue;
    EXPECT_EQ(seen[0].kind, RodEvent::Kind::kAvulsed);
    EXPECT_NEAR(seen[0].pull_n, 4.5, 0.1);
    rod.anchor(RodEnd::kStart, {});
    EXPECT_FALSE(rod.anchored(RodEnd::kStart)) << "it does not grow on again";
  }
}

TEST(ElasticRod, TearsBetweenTwoHandsThatPull) {
  RodOptions o;
  ElasticRod rod(straight(), o);
  bool torn = false;
  for (int i = 0; i < 400; ++i) {
    std::vector<RodSpring> load{dead_load(0.01, {-8.0 * std::min(1.0, i / 300.0), 0, 0}),
                                dead_load(0.03, {8.0 * std::min(1.0, i / 300.0), 0, 0})};
    rod.step(load);
    for (const RodEvent& event : rod.events()) {
      torn = true;
      EXPECT_EQ(event.kind, RodEvent::Kind::kTorn);
      EXPECT_GT(event.arc_m, 0.009);
      EXPECT_LT(event.arc_m, 0.031);
    }
    if (torn) break;
  }
  EXPECT_TRUE(torn);
  EXPECT_EQ(rod.parts().size(), 2u);
}

TEST(ElasticRod, RelaxesByItsBranches) {
  RodOptions o = plain();
  o.prony = {PronyBranch{0.4, 0.3}, PronyBranch{}};
  ElasticRod rod = hung_at_both(o);
  const double stretch = 0.002;
  rod.anchor(RodEnd::kFinish, {.position = {kLength + stretch, 0, 0}});
  const double rigid = o.young_pa * area(o) / kLength * stretch;
  std::vector<double> force;
  for (int i = 0; i < 300; ++i) {
    rod.step();
    force.push_back(-rod.anchor_load(RodEnd::kFinish).force.x());
  }
  // Anchors of 2000 N/m give by a little; instantaneous 1 / (1 - 0.4), decay by tau.
  const double series = force.back() / rigid;
  EXPECT_NEAR(series, 1, 0.05);
  EXPECT_NEAR(force[9] / force.back(), 1 + 0.4 / 0.6 * std::pow(0.3 / 0.31, 10), 0.06);
}

TEST(ElasticRod, HoldsKeepItUntilTheyAreFreed) {
  RodOptions o = plain();
  o.gravity_m_s2 = {0, 0, -9.81};
  ElasticRod rod = hung_at_start(o);
  rod.hold(0.005, kLength, 5);
  for (int i = 0; i < 300; ++i) rod.step();
  EXPECT_GT(rod.nodes().back().position.z(), -1e-4);
  rod.free(0.02, kLength);
  for (int i = 0; i < 300; ++i) rod.step();
  EXPECT_LT(rod.nodes().back().position.z(), -1e-3);
}

TEST(ElasticRod, ASplintIsStraightAndHeavy) {
  const RodOptions o = plain();
  ElasticRod plain_rod = hung_at_start(o), splinted = hung_at_start(o);
  const double mass = splinted.mass_kg();
  const int number = splinted.splint(0.0095, 0.0205, 5e-5);
  EXPECT_NEAR(splinted.mass_kg() - mass, 5e-5, 1e-12);
  std::vector<RodSpring> a{dead_load(kLength, {0, 0, -0.005})}, b = a;
  plain_rod.settle(a);
  splinted.settle(b);
  const auto turn = [](const ElasticRod& rod) {
    return std::acos(std::clamp(rod.segments()[9].frame.t.dot(rod.segments()[20].frame.t), -1.0, 1.0));
  };
  EXPECT_LT(turn(splinted), 0.05 * turn(plain_rod));
  splinted.take_splint(number);
  EXPECT_NEAR(splinted.mass_kg(), mass, 1e-12);
}

TEST(ElasticRod, ComesBackFromAnyScramble) {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-0.03, 0.03);
    ElasticRod rod = hung_at_both({.avulsion_n = 1e9});
    std::vector<Vec3> scrambled;
    for (const RodNode& node : rod.nodes())
      scrambled.push_back(node.position + Vec3(any(random), any(random), any(random)));
    rod.place(scrambled);
    for (int i = 0; i < 100; ++i) rod.step();
    for (const RodNode& node : rod.nodes()) EXPECT_LT((node.position - node.drawn).norm(), 1e-3) << seed;
  }
}

TEST(ElasticRod, NanCountsAsNotThere) {
  ElasticRod rod = hung_at_both({}), other = rod;
  std::vector<RodSpring> bad{{.arc_m = kNan, .stiffness_n_per_m = 10, .stretch_m = 1},
                             {.arc_m = 0.01, .stiffness_n_per_m = 10, .stretch_m = kNan},
                             {.arc_m = 0.01, .direction = {kNan, 0, 0}, .stiffness_n_per_m = 10, .stretch_m = 1}};
  rod.anchor(RodEnd::kStart, {.position = {kNan, 0, 0}});
  rod.place(std::vector<Vec3>(41, Vec3::Constant(kNan)));
  for (int i = 0; i < 20; ++i) {
    rod.step(bad);
    other.step();
  }
  for (std::size_t i = 0; i < 41; ++i) EXPECT_EQ(rod.nodes()[i].position, other.nodes()[i].position);
  EXPECT_EQ(bad[1].force_n, 0);
  EXPECT_EQ(rod.held_steps(), 0u);
}

/// Anything at all: pulls, teleports, cuts, holds; afterwards left alone.
std::vector<Vec3> after_anything(unsigned seed, int steps) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto chance = [&](double share) { return any(random) < 2 * share - 1; };
  ElasticRod rod = hung_at_both({.prony = {PronyBranch{0.1, 0.3}, PronyBranch{}}});
  for (int i = 0; i < steps; ++i) {
    std::vector<RodSpring> springs;
    for (int s = 0; s < 3; ++s)
      if (chance(0.5))
        springs.push_back({.arc_m = 0.03 * (any(random) + 1),
                           .direction = Vec3(any(random), any(random), 2).normalized(),
                           .stiffness_n_per_m = 500 * (1 + any(random)),
                           .stretch_m = 0.01 * any(random),
                           .pushes_only = chance(0.5)});
    if (chance(0.02)) springs.push_back({.arc_m = 0.02, .stiffness_n_per_m = 1e4, .stretch_m = 0.5});
    if (chance(0.2)) rod.anchor(RodEnd::kStart, {.position = 0.002 * Vec3(any(random), any(random), any(random))});
    if (chance(0.001)) rod.sever(0.04 * std::abs(any(random)));
    if (chance(0.01)) rod.hold(0, 0.01, 100);
    if (chance(0.01)) rod.free(0, 0.04);
    rod.step(springs);
  }
  for (int i = 0; i < 50; ++i) rod.step();
  std::vector<Vec3> places;
  for (const RodNode& node : rod.nodes()) places.push_back(node.position);
  return places;
}

TEST(ElasticRod, StaysFiniteThroughFiveThousandRandomSteps) {
  for (unsigned seed = 0; seed < 5; ++seed)
    for (const Vec3& place : after_anything(seed, 1000)) {
      EXPECT_TRUE(place.allFinite());
      EXPECT_LT(place.norm(), 50) << "flung away";
    }
}

TEST(ElasticRod, SameInputSameBytes) {
  const std::vector<Vec3> once = after_anything(7, 300), again = after_anything(7, 300);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i], again[i]);
}

TEST(ElasticRod, IsMadeOfTheTissuesNumbers) {
  TissueSolid duct;
  duct.young_pa = 350000;
  duct.rupture_n_per_m = 480;
  const RodOptions o = rod_options(duct, 0.0015, 0.0005);
  EXPECT_EQ(o.young_pa, 350000);
  EXPECT_NEAR(o.avulsion_n, 4.52, 0.01);
}

TEST(ElasticRod, PointsAtEqualDistances) {
  const std::vector<Vec3> corner{{0, 0, 0}, {0.01, 0, 0}, {0.01, 0.02, 0}};
  const std::vector<Vec3> points = evenly_spaced(corner, 0.0011);
  ASSERT_EQ(points.size(), 28u);
  EXPECT_EQ(points.front(), corner.front());
  EXPECT_EQ(points.back(), corner.back());
  EXPECT_LT((points[9] - Vec3(0.01, 0, 0)).norm(), 1e-9);
}

}  // namespace
}  // namespace trocar::elastic_rod_test
