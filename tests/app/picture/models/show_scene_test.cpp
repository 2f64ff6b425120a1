#include "app/window/pages/show_scene.h"

#include <gtest/gtest.h>

#include "app/picture/models/show_scene.h"

namespace trocar::show_scene_test {
namespace {

const SceneView& still() {
  static const SceneView view = show_scene("abdomen");
  return view;
}

TEST(ShowView, IsTheSameAtTheSameTime) {
  const SceneView a = show_view(still(), 3.7), b = show_view(still(), 3.7);
  EXPECT_EQ(a.X_TI.p, b.X_TI.p);
  EXPECT_EQ(a.breath_T, b.breath_T);
  EXPECT_EQ(a.organ, still().organ) << "shared, not copied";
}

TEST(ShowView, OrgansBreatheAndInstrumentsWaver) {
  double breath = 0, tip = 0, step = 0;
  for (double t = 0; t < 20; t += 0.1) {
    const SceneView now = show_view(still(), t), next = show_view(still(), t + 0.02);
    breath = std::max(breath, now.breath_T.norm());
    tip = std::max(tip, (now.X_TI.p - still().X_TI.p).norm());
    step = std::max(step, (next.X_TI.p - now.X_TI.p).norm());
    EXPECT_GE(now.jaw_opening_m, 0);
  }
  EXPECT_GT(breath, 0.002);
  EXPECT_LT(breath, 0.008);
  EXPECT_GT(tip, 0.002);
  EXPECT_LT(tip, 0.012) << "it stays in the picture";
  EXPECT_LT(step / 0.02, 0.02) << "m/s: nothing hurries";
}

TEST(ShowView, HasNoHeadUpDisplay) { EXPECT_TRUE(show_view(still(), 1).hud.title.empty()); }

}  // namespace
}  // namespace trocar::show_scene_test
