// Where the plumb line's foot lies while something is touched.
#include "app/window/run/tip_guide.h"

#include <gtest/gtest.h>

namespace trocar::tip_guide_test {
namespace {

TEST(TipGuide, TheFootLiesWhereTheTipTouchesAndNotWhereTheShaftLeans) {
  const Vec3 tip_T(0.02, 0.01, 0.03);
  StylusState stylus;
  stylus.X_TI.p = tip_T;
  EXPECT_FALSE(touched_at(stylus, tip_T)) << "touches nothing";
  stylus.contact = true;
  stylus.contact_point_T = tip_T - Vec3(0, 0, 0.003);
  ASSERT_TRUE(touched_at(stylus, tip_T));
  EXPECT_EQ(*touched_at(stylus, tip_T), stylus.contact_point_T);
  stylus.contact_point_T = tip_T + Vec3(0.03, 0, 0.04);  // a peg beside the way, half up the shaft
  EXPECT_FALSE(touched_at(stylus, tip_T));
}

}  // namespace
}  // namespace trocar::tip_guide_test
