// A frame holds gauze by its rim, leaves the edge that is cut into free, and stands clear of the organ.
#include <gtest/gtest.h>

#include "scenarios/layout/sheet_frame.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar::sheet_frame_test {
namespace {

/// A slope from z = 0 at the one edge to 10 mm at the other, beneath all of the sheet.
TriangleSurface slope() {
  TriangleSurface surface;
  surface.vertices = {{-0.1, -0.1, 0}, {0.1, -0.1, 0}, {0.1, 0.1, 0.010}, {-0.1, 0.1, 0.010}};
  surface.triangles = {{0, 1, 2}, {0, 2, 3}};
  return surface;
}

class SheetFrameTest : public testing::Test {
 protected:
  SheetFrameTest() {
    plan_.corner_m = {0.05, 0.05};
    plan_.along_m = {-0.1, 0};
    plan_.across_m = 0.1;
  }
  SheetFrame frame() const { return SheetFrame(plan_, HeightField(organ_)); }

  SheetPlan plan_;
  TriangleSurface organ_ = slope();
};

TEST_F(SheetFrameTest, ClipsHoldTheRimButForTheMiddleOfTheEdgeOppositeTheFirst) {
  for (const double at : {0.0, 0.02, 0.05, 0.1}) {
    EXPECT_TRUE(frame().clipped({at, 0})) << at;
    EXPECT_TRUE(frame().clipped({0, at})) << at;
    EXPECT_TRUE(frame().clipped({0.1, at})) << at;
  }
  EXPECT_TRUE(frame().clipped({0.034, 0.1}));
  EXPECT_FALSE(frame().clipped({0.036, 0.1}));
  EXPECT_FALSE(frame().clipped({0.05, 0.1}));
  EXPECT_FALSE(frame().clipped({0.05, 0.05}));
}

TEST_F(SheetFrameTest, StandsLevelAndClearOfTheHighestPlaceBeneath) {
  EXPECT_TRUE(frame().at({0, 0}).isApprox(Vec3(0.05, 0.05, 0.0375), 1e-9)) << frame().at({0, 0}).transpose();
  EXPECT_TRUE(frame().at({0.1, 0.1}).isApprox(Vec3(-0.05, -0.05, 0.0375), 1e-9));
}

}  // namespace
}  // namespace trocar::sheet_frame_test
