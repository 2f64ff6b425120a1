// What closes a duct, and where it opens to the outside.
#include "tissue/thin/lumen.h"

#include <gtest/gtest.h>

#include "tests/tissue/thin/rod_rig.h"
#include "tissue/thin/rod_section.h"

namespace trocar::lumen_test {
namespace {

TEST(Lumen, IsOpenUntilSomethingClosesIt) {
  ElasticRod rod = test::hung_duct();
  Lumen lumen;
  for (const LumenSegment& segment : lumen.segments(rod)) {
    EXPECT_EQ(segment.state, LumenState::kOpen);
    EXPECT_EQ(segment.open, 1);
    EXPECT_EQ(segment.flow, 1);
    EXPECT_NEAR(segment.radius_m, 0.001, 1e-12);
    EXPECT_NEAR(segment.length_m, 0.001, 1e-9);
  }
  for (const LumenEnd& end : lumen.ends(rod)) EXPECT_FALSE(end.outside);
}

TEST(Lumen, AClipClosesItsSegmentsAloneAndHoldsAPressure) {
  ElasticRod rod = test::hung_duct();
  Lumen lumen;
  const int number = lumen.clip(0.0101, 0.0109, 1, 39997, 0);
  const auto segments = lumen.segments(rod);
  for (std::size_t i = 0; i < segments.size(); ++i) EXPECT_EQ(segments[i].open, i == 10 ? 0 : 1) << i;
  EXPECT_EQ(segments[10].state, LumenState::kClipped);
  EXPECT_GE(segments[10].holds_pa, 300 * 133.322);
  lumen.open(number);
  EXPECT_EQ(lumen.segments(rod)[10].open, 1);
}

TEST(Lumen, HalfAClipLeaksAndHoldsNothing) {
  ElasticRod rod = test::hung_duct();
  Lumen lumen;
  lumen.clip(0.0101, 0.0109, 0.6, 39997, 0);
  const LumenSegment segment = lumen.segments(rod)[10];
  EXPECT_NEAR(segment.open, 0.4, 1e-12);
  EXPECT_NEAR(segment.flow, 0.16, 1e-12);
  EXPECT_EQ(segment.holds_pa, 0);
}

TEST(Lumen, PressedOnlyAsLongAsItIsPressed) {
  ElasticRod rod = test::hung_duct();
  Lumen lumen;
  lumen.press(0.02, 0.022, 0.5, 0);
  EXPECT_NEAR(lumen.segments(rod)[20].open, open_area(0.5), 1e-12);
  EXPECT_LT(lumen.segments(rod)[20].flow, lumen.segments(rod)[20].open) << "a slit resists more than its area says";
  lumen.begin();
  EXPECT_EQ(lumen.segments(rod)[20].open, 1);
}

TEST(Lumen, EndsOfACutOpenOutsideAndASealStaysWithItsSide) {
  ElasticRod rod = test::hung_duct();
  Lumen lumen;
  lumen.seal(0.0175, 0.0195, 1);
  rod.sever(0.0205);
  const auto ends = lumen.ends(rod);
  ASSERT_EQ(ends.size(), 4u);
  EXPECT_FALSE(ends[0].outside);
  EXPECT_TRUE(ends[1].outside);
  EXPECT_TRUE(ends[2].outside);
  EXPECT_FALSE(ends[3].outside);
  EXPECT_GT(ends[1].outward_T.x(), 0.9);
  EXPECT_LT(ends[2].outward_T.x(), -0.9);
  int cut = 0, sealed = 0;
  for (const LumenSegment& segment : lumen.segments(rod)) {
    cut += segment.state == LumenState::kCut;
    sealed += segment.state == LumenState::kSealed;
    if (segment.state == LumenState::kSealed) {
      EXPECT_LT(segment.segment, ends[1].node);
    }
  }
  EXPECT_EQ(cut, 1);
  EXPECT_EQ(sealed, 3);
}

TEST(Lumen, SectionKeepsItsRoundAndClosesItsArea) {
  const RodOptions rod;
  EXPECT_NEAR(rod_section(rod, 0).half_width_m, rod.outer_radius_m, 1e-15);
  EXPECT_NEAR(rod_section(rod, 1).half_thickness_m, rod.wall_m, 1e-15);
  EXPECT_NEAR(4 * rod_section(rod, 1).half_width_m, 2 * std::numbers::pi * rod.outer_radius_m, 1e-12);
  EXPECT_EQ(open_area(1), 0);
  EXPECT_EQ(open_flow(0), 1);
  EXPECT_EQ(flatness_between(rod, 2 * rod.outer_radius_m), 0);
  EXPECT_EQ(flatness_between(rod, 2 * rod.wall_m), 1);
  double before = 1;
  for (double f = 0.05; f <= 1; f += 0.05) {
    EXPECT_LT(open_flow(f), before);
    before = open_flow(f);
  }
}

}  // namespace
}  // namespace trocar::lumen_test
