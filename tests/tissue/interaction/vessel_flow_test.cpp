// Blood through networks of vessels against closed forms, and what opens, narrows and closes them.
#include "tissue/interaction/vessel_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tissue/mesh/surface/vessel_graph.h"

namespace trocar::vessel_flow_test {
namespace {

constexpr double kRadius = 0.5e-3, kLength = 0.02;  // m
const VesselFlowOptions kNoJet = {.exit_loss = 0, .spasm = 1};

BloodPressures pressures(double arterial_pa) {
  return {.arterial_pa = arterial_pa, .portal_pa = 2700, .venous_pa = 2000, .outside_pa = 1600};
}

double tube(double radius_m, double length_m) {
  return 8 * VesselFlowOptions{}.viscosity_pa_s * length_m / (std::numbers::pi * std::pow(radius_m, 4));
}

/// An inlet, a vessel, a node with a bed or an outlet behind it.
struct Single {
  explicit Single(const VesselFlowOptions& options = kNoJet) : flow(options) {
    flow.add_node({.supply = Supply::kArterial});
    flow.add_node({.supply = Supply::kVenous});
    flow.add_vessel({0, 1, kRadius, kLength});
  }
  double out(bool at_from = true) const { return flow.open_ends()[at_from ? 0 : 1].flow_m3_per_s; }
  VesselFlow flow;
};

TEST(VesselFlow, SeriesAndParallelAsPoiseuilleHasThem) {
  VesselFlow flow(kNoJet);
  for (const Supply supply : {Supply::kArterial, Supply::kNone, Supply::kNone, Supply::kVenous})
    flow.add_node({supply});
  flow.add_vessel({0, 1, 1e-3, 0.03});
  flow.add_vessel({1, 2, 0.5e-3, 0.02});
  flow.add_vessel({2, 1, 0.4e-3, 0.01});  // beside it, the other way round
  flow.add_vessel({2, 3, 0.8e-3, 0.05});
  flow.solve(pressures(12000));
  const double parallel = 1 / (1 / tube(0.5e-3, 0.02) + 1 / tube(0.4e-3, 0.01));
  const double all = 10000 / (tube(1e-3, 0.03) + parallel + tube(0.8e-3, 0.05));
  EXPECT_NEAR(flow.flow_m3_per_s(0) / all, 1, 1e-9);
  EXPECT_NEAR(flow.flow_m3_per_s(3) / all, 1, 1e-9);
  EXPECT_NEAR(flow.flow_m3_per_s(1) / (all * parallel / tube(0.5e-3, 0.02)), 1, 1e-9);
  EXPECT_NEAR(flow.flow_m3_per_s(2) / (-all * parallel / tube(0.4e-3, 0.01)), 1, 1e-9);
  EXPECT_NEAR(flow.pressure_pa(1), 12000 - all * tube(1e-3, 0.03), 1e-6);
}

TEST(VesselFlow, ABedOfCapillariesDrainsToTheVeins) {
  VesselFlow flow(kNoJet);
  flow.add_node({.supply = Supply::kArterial});
  flow.add_node({.capillary_m3_per_pa_s = 3e-12});
  flow.add_vessel({0, 1, kRadius, kLength});
  flow.solve(pressures(12000));
  EXPECT_NEAR(flow.flow_m3_per_s(0) * (tube(kRadius, kLength) + 1 / 3e-12) / 10000, 1, 1e-9);
}

TEST(VesselFlow, BothEndsOfACutVesselBleedAgainstTheOutside) {
  Single s;
  s.flow.cut(0, 0.25);
  s.flow.solve(pressures(12000));
  EXPECT_NEAR(s.out() * tube(kRadius, 0.25 * kLength) / (12000 - 1600), 1, 1e-9);
  EXPECT_NEAR(s.out(false) * tube(kRadius, 0.75 * kLength) / (2000 - 1600), 1, 1e-9);
  s.flow.cut(0, 0.75);  // what lies between is out of it
  s.flow.solve(pressures(12000));
  EXPECT_EQ(s.flow.open_ends().size(), 2U);
  EXPECT_NEAR(s.out() * tube(kRadius, 0.25 * kLength) / (12000 - 1600), 1, 1e-9);
  EXPECT_NEAR(s.out(false) * tube(kRadius, 0.25 * kLength) / (2000 - 1600), 1, 1e-9);
}

TEST(VesselFlow, AJetLosesItsKineticEnergy) {
  const VesselFlowOptions options;
  Single s(options);
  s.flow.cut(0, 0.5);
  s.flow.solve(pressures(12000));
  const double area = std::numbers::pi * std::pow(options.spasm * kRadius, 2), q = s.out();
  const double speed = q / area;
  EXPECT_NEAR(tube(kRadius, kLength / 2) * q + options.density_kg_per_m3 * speed * speed / 2, 12000 - 1600, 1e-5);
  EXPECT_NEAR(s.flow.open_ends()[0].speed_m_per_s, speed, 1e-9);
  EXPECT_NEAR(jet_flow(12000 - 1600, tube(kRadius, kLength / 2),
                       jet_loss(1, options.density_kg_per_m3, options.spasm * kRadius)) /
                  q,
              1, 1e-9);
  EXPECT_EQ(jet_flow(-1, 1, 1), 0);
}

TEST(VesselFlow, NoGasGoesIntoAnOpenEnd) {
  Single s;
  s.flow.cut(0, 0.5);
  s.flow.solve({.arterial_pa = 1000, .venous_pa = 1500, .outside_pa = 1600});
  EXPECT_EQ(s.out(), 0);
  EXPECT_EQ(s.out(false), 0);
}

TEST(VesselFlow, AClipClosesAPartialOneLeaks) {
  Single open, half, most, closed;
  half.flow.clip(0, 0.2, 0.5);
  most.flow.clip(0, 0.2, 0.9);
  closed.flow.clip(0, 0.2, 1);
  for (Single* s : {&open, &half, &most, &closed}) {
    s->flow.cut(0, 0.5);
    s->flow.solve(pressures(12000));
  }
  EXPECT_EQ(closed.out(), 0);
  EXPECT_GT(closed.out(false), 0) << "the other end is not clipped";
  const double clip = tube(kRadius, VesselFlowOptions{}.closure_m) / (0.1 * 0.1);
  EXPECT_NEAR(most.out() * (tube(kRadius, kLength / 2) + clip) / (12000 - 1600), 1, 1e-9);
  EXPECT_LT(most.out(), half.out());
  EXPECT_LT(half.out(), open.out());
  EXPECT_GT(most.out(), 0);
}

TEST(VesselFlow, AClipThatIsTakenOffLeavesNothing) {
  Single never, once;
  once.flow.clip(0, 0.3, 1);
  once.flow.clip(0, 0.2, 1);
  for (Single* s : {&never, &once}) s->flow.cut(0, 0.5);
  for (Single* s : {&never, &once}) s->flow.solve(pressures(12000));
  EXPECT_EQ(once.out(), 0);
  once.flow.unclip(0, 0.2);
  once.flow.unclip(0, 0.7);
  once.flow.solve(pressures(12000));
  EXPECT_EQ(once.out(), 0) << "the other one holds";
  once.flow.unclip(0, 0.3);
  for (Single* s : {&never, &once}) s->flow.solve(pressures(12000));
  EXPECT_GT(never.out(), 0);
  EXPECT_NEAR(once.out() / never.out(), 1, 1e-9);
}

TEST(VesselFlow, AClipHolds300MillimetresOfMercuryAndNoMore) {
  Single s;
  s.flow.clip(0, 0.2, 1);
  s.flow.cut(0, 0.5);
  s.flow.solve(pressures(1600 + 300 * kMmHg));
  EXPECT_EQ(s.out(), 0);
  s.flow.solve(pressures(1600 + 310 * kMmHg));
  const double clip = tube(kRadius, VesselFlowOptions{}.closure_m) / (0.1 * 0.1);
  EXPECT_NEAR(s.out() * (tube(kRadius, kLength / 2) + clip) / (10 * kMmHg), 1, 1e-9) << "what is above leaks";
  s.flow.solve(pressures(12000));
  EXPECT_EQ(s.out(), 0) << "and holds again";
}

TEST(VesselFlow, AClipBeforeACutStopsWhatComesThroughAWholeVessel) {
  Single s;
  s.flow.clip(0, 0.5, 1);
  s.flow.solve(pressures(12000));
  EXPECT_EQ(s.flow.flow_m3_per_s(0), 0);
  s.flow.cut(0, 0.8);
  s.flow.solve(pressures(12000));
  EXPECT_EQ(s.out(), 0);
}

TEST(VesselFlow, JawsThatHoldItStopItUntilTheyLetGo) {
  Single s;
  s.flow.cut(0, 0.5);
  s.flow.solve(pressures(12000));
  const double open = s.out();
  s.flow.pinch(0, 0.3, 1);
  s.flow.solve(pressures(12000));
  EXPECT_EQ(s.out(), 0);
  EXPECT_GT(s.out(false), 0) << "the other stump is not held";
  s.flow.pinch(0, 0.3, 0);
  s.flow.solve(pressures(12000));
  EXPECT_NEAR(s.out(), open, 1e-9 * open);
}

TEST(VesselFlow, ASealTakesAShareOfTheLumenOrAll) {
  Single s;
  s.flow.cut(0, 0.5);
  s.flow.seal(0, 0.49, 0.6);
  s.flow.solve(pressures(12000));
  EXPECT_GT(s.out(), 0);
  const double before = s.out();
  s.flow.seal(0, 0.49, 0.3);
  s.flow.solve(pressures(12000));
  EXPECT_EQ(s.out(), before) << "less heat does not open it";
  s.flow.seal(0, 0.49, 1);
  s.flow.solve(pressures(12000));
  EXPECT_EQ(s.out(), 0);
}

TEST(VesselFlow, APressTakesItsPressureFromTheDriveUntilNothingIsLeft) {
  Single s;
  s.flow.cut(0, 0.5);
  s.flow.press(0, 4000);
  s.flow.solve(pressures(12000));
  EXPECT_NEAR(s.out() * tube(kRadius, kLength / 2) / (12000 - 1600 - 4000), 1, 1e-9);
  EXPECT_EQ(s.out(false), 0) << "the veins have 400 Pa";
  s.flow.press(0, 12000 - 1600 + 1);
  s.flow.solve(pressures(12000));
  EXPECT_EQ(s.out(), 0);
  s.flow.press(0, 0);
  s.flow.solve(pressures(12000));
  EXPECT_NEAR(s.out() * tube(kRadius, kLength / 2) / (12000 - 1600), 1, 1e-9);
}

TEST(VesselFlow, APressedWholeVesselIsAStarlingResistor) {
  Single s;
  s.flow.press(0, 5000);
  s.flow.solve(pressures(12000));
  EXPECT_NEAR(s.flow.flow_m3_per_s(0) * tube(kRadius, kLength) / (12000 - (1600 + 5000)), 1, 1e-9);
  s.flow.press(0, 11000);
  s.flow.solve(pressures(12000));
  EXPECT_EQ(s.flow.flow_m3_per_s(0), 0);
}

TEST(VesselFlow, WhatComesInGoesOutAndACutUpstreamTakesFromDownstream) {
  VesselFlow flow;  // jets and spasm
  flow.add_node({.supply = Supply::kArterial});
  flow.add_node({});
  for (int i = 0; i < 3; ++i) flow.add_node({.capillary_m3_per_pa_s = 1e-11});
  flow.add_vessel({0, 1, 1.5e-3, 0.05});
  for (int i = 0; i < 3; ++i) flow.add_vessel({1, 2 + i, 0.5e-3, 0.02});
  const auto bed = [&](int node) { return 1e-11 * (flow.pressure_pa(node) - 2000); };
  flow.solve(pressures(12000));
  const double whole = bed(2);
  EXPECT_NEAR((bed(2) + bed(3) + bed(4)) / flow.flow_m3_per_s(0), 1, 1e-9);
  flow.cut(3, 0.5);
  flow.solve(pressures(12000));
  const double lost = flow.open_ends()[0].flow_m3_per_s;
  EXPECT_GT(lost, 0);
  EXPECT_NEAR((bed(2) + bed(3) + bed(4) + lost + flow.open_ends()[1].flow_m3_per_s) / flow.flow_m3_per_s(0), 1, 1e-8);
  EXPECT_LT(bed(2), whole);
}

TEST(VesselFlow, APieceWithoutASupplyHasThePressureOutside) {
  VesselFlow flow;
  flow.add_node({});
  flow.add_node({});
  flow.add_vessel({0, 1, kRadius, kLength});
  flow.cut(0, 0.5);
  flow.solve(pressures(12000));
  EXPECT_NEAR(flow.pressure_pa(0), 1600, 1e-6);
  EXPECT_NEAR(flow.open_ends()[0].flow_m3_per_s, 0, 1e-15);
}

TEST(VesselFlow, TakesATreeOfCentrelines) {
  VesselGraph graph;
  graph.nodes = {{{0, 0, 0}, 2e-3}, {{0, 0, 0.03}, 1e-3}, {{0.01, 0, 0.04}, 0.5e-3}, {{-0.01, 0, 0.04}, 0.5e-3}};
  graph.edges = {{0, 1}, {1, 2}, {1, 3}};
  VesselFlow flow = vessel_flow(graph, {.supply = Supply::kArterial, .capillary_m3_per_pa_s = 2e-12});
  EXPECT_EQ(flow.vessels(), 3U);
  EXPECT_NEAR(flow.vessel(0).radius_m, 1.5e-3, 1e-12);
  flow.solve(pressures(12000));
  EXPECT_NEAR(flow.pressure_pa(0), 12000, 0) << "the root is the inlet";
  EXPECT_NEAR(flow.flow_m3_per_s(0), 2 * 2e-12 * (flow.pressure_pa(2) - 2000), 1e-14);
}

TEST(VesselFlow, RefusesVesselsThatCannotBe) {
  VesselFlow flow;
  flow.add_node({});
  flow.add_node({});
  EXPECT_THROW(flow.add_vessel({0, 2, kRadius, kLength}), std::invalid_argument);
  EXPECT_THROW(flow.add_vessel({0, 0, kRadius, kLength}), std::invalid_argument);
  EXPECT_THROW(flow.add_vessel({0, 1, 0, kLength}), std::invalid_argument);
  EXPECT_THROW(flow.add_vessel({0, 1, kRadius, std::nan("")}), std::invalid_argument);
}

TEST(Circulation, ThePulseHasTheMeanAndTheHeightThatItShould) {
  const CirculationOptions options;
  Circulation circulation(options);
  double sum = 0, low = 1e9, high = 0;
  constexpr int kSteps = 8000;  // 100 beats
  for (int i = 0; i < kSteps; ++i) {
    circulation.step(0.01, 0);
    const double p = circulation.pressures().arterial_pa;
    sum += p / kSteps;
    low = std::min(low, p);
    high = std::max(high, p);
  }
  EXPECT_NEAR(sum, options.mean_arterial_pa, 1);
  EXPECT_NEAR(high - low, options.pulse_pressure_pa, 0.01 * options.pulse_pressure_pa);
}

TEST(Circulation, PressureHoldsUntilAThirdOfTheBloodIsLostAndThenFalls) {
  const CirculationOptions options;
  const auto mean = [&](double lost_m3) {
    Circulation circulation(options);
    circulation.step(0.01, lost_m3);
    return circulation.mean_arterial_pa();
  };
  EXPECT_EQ(mean(0), options.mean_arterial_pa);
  EXPECT_NEAR(mean(1.5e-3), options.mean_arterial_pa, 1e-6);
  EXPECT_NEAR(mean(2.0e-3) - options.pneumoperitoneum_pa, (options.mean_arterial_pa - options.pneumoperitoneum_pa) / 2,
              1e-6);
  EXPECT_NEAR(mean(2.6e-3), options.pneumoperitoneum_pa, 1e-9);
  Circulation weak;
  weak.step(0.01, 0.75e-3);
  EXPECT_NEAR(60 * weak.heart_hz(), 99.3, 0.5) << "ATLS: 100 a minute where class II begins";
  weak.step(0.01, 1.5e-3);
  EXPECT_NEAR(60 * weak.heart_hz(), 123.6, 0.5);
}

}  // namespace
}  // namespace trocar::vessel_flow_test
