// Where a contact patch ends, in numbers and words.
#include <gtest/gtest.h>

#include "app/session/setup/patch_fit.h"
#include "scenarios/files/exercise_loader.h"

namespace trocar::patch_words_test {
namespace {

TEST(PatchWords, WholeUpToTheLastTriangleAndFeltUpToWhatIsNeeded) {
  PatchFit fit;
  fit.most = kMaxPatchTriangles;
  EXPECT_TRUE(fit.whole());
  fit.most = kMaxPatchTriangles + 1;
  EXPECT_FALSE(fit.whole());
  fit.reach_m = fit.needed_m = 0.007;
  EXPECT_TRUE(fit.felt());
  fit.reach_m = 0.00699;
  EXPECT_FALSE(fit.felt());
}

TEST(PatchWords, SayLimitMeasureAndWhatToImport) {
  const PatchFit refused{900, 0.0042, 0.007, 1350}, felt{600, 0.0213, 0.007, 2450};
  EXPECT_EQ(refused.words(),
            "a contact patch holds 512 triangles within 25 mm of the tool, here are up to 900; it ends 4.2 mm from the "
            "tool's axis, 7.0 mm are "
            "needed: import it again with --triangles 1350");
  EXPECT_EQ(felt.words(),
            "a contact patch holds 512 triangles within 25 mm of the tool, here are up to 600; it ends 21.3 mm from "
            "the tool's axis, 7.0 mm are "
            "needed: enough to feel it; --triangles 2450 would fit in whole");
}

TEST(PatchWords, WithoutTargetsNothingIsMeasuredAndTheAdviceIsTheReserve) {
  AttemptSetup setup;
  setup.exercise = find_exercise("surface-touch", find_assets().exercises);
  setup.organ = "phantom-liver";
  Scene scene = build_scene(setup, find_assets(), {"simulated", 1000, 16});
  ASSERT_FALSE(scene.board.targets.empty());
  const PatchFit with = patch_fit(scene);
  EXPECT_GT(with.most, 0);
  EXPECT_LE(with.reach_m, kPatchRadius);
  scene.board.targets.clear();
  const PatchFit none = patch_fit(scene);
  EXPECT_EQ(none.most, 0);
  EXPECT_EQ(none.reach_m, kPatchRadius);
  EXPECT_EQ(none.needed_m, with.needed_m);
  EXPECT_EQ(none.advised % 50, 0);
  const double wanted = 0.9 * static_cast<double>(scene.organ_T->triangles.size());
  EXPECT_LE(none.advised, wanted);
  EXPECT_GT(none.advised, wanted - 50);
}

}  // namespace
}  // namespace trocar::patch_words_test
