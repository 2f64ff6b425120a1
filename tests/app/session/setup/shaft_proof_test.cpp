// The proof sees the whole instrument: shipped boards keep their room, a tub is refused with the reason, a walled organ
// is proved where there is room; and what a surface too fine for the contact patch is told.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/session/setup/patch_fit.h"
#include "app/session/setup/workspace_proof.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/scenarios/support/relief.h"
#include "tests/tissue/support/shapes.h"

namespace trocar::shaft_proof_test {
namespace {

Exercise touch() { return find_exercise("surface-touch", find_assets().exercises); }

Organ organ_of(const TriangleSurface& surface_RAS, const std::string& name) {
  Organ organ;
  organ.name = name;
  organ.manifest = name + ".organ.toml";
  organ.surface = surface_RAS;
  return organ;
}

Scene scene_of(const Organ& organ, const std::string& level = "L1") {
  AttemptSetup setup;
  setup.exercise = touch();
  setup.level = level;
  return build_scene(setup, organ, {"simulated", 1000, 16});
}

std::string refusal(const Organ& organ, const std::string& level = "L1") {
  try {
    scene_of(organ, level);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ShaftProof, TheShippedLiverHasRoomAtEveryLevelAsItLies) {
  const Organ organ = load_organ(find_organ("phantom-liver", find_assets().assets));
  for (const char* level : {"L1", "L3"}) {
    const LevelProof proof = prove_level(touch(), level, organ, 0);
    EXPECT_TRUE(proof.sound) << proof.why;
    EXPECT_GE(proof.worst.shaft_gap_m, ShaftRoom::kLeastGap);
    EXPECT_EQ(turned_words(proof.placement), "");
    const Pose before = place_organ(organ.surface, touch().layout);
    EXPECT_EQ(proof.placement.X_TO.p, before.p);
  }
}

TEST(ShaftProof, AWalledOrganIsProvedWhereTheInstrumentHasRoom) {
  const LevelProof proof = prove_level(touch(), "L1", organ_of(in_ras(walled_ground(0.070)), "walled"), 0);
  EXPECT_TRUE(proof.sound) << proof.why;
  EXPECT_GE(proof.worst.shaft_gap_m, ShaftRoom::kLeastGap);
}

TEST(ShaftProof, ABoardThatAsksTheTipAloneIsNotSound) {
  Reach reach;
  reach.shaft_gap_m = ShaftRoom::kLeastGap - 1e-6;
  EXPECT_NE(reach.broken({}).find("shaft would press"), std::string::npos) << reach.broken({});
  Reach worst;
  worst.add(reach);
  EXPECT_EQ(worst.shaft_gap_m, reach.shaft_gap_m);
}

TEST(ShaftProof, AKnownPlacementIsTakenAsItIs) {
  AttemptSetup setup;
  setup.exercise = touch();
  const Organ organ = organ_of(in_ras(walled_ground(0.070)), "walled");
  const Scene found = build_scene(setup, organ, {"simulated", 1000, 16});
  setup.placement = found.placement;
  const Scene given = build_scene(setup, organ, {"simulated", 1000, 16});
  for (std::size_t i = 0; i < found.board.targets.size(); ++i)
    EXPECT_EQ(given.board.targets[i].centre_T, found.board.targets[i].centre_T);
}

/// A ball of 80 mm: room for a board whatever its triangles.
Organ ball(int levels) { return organ_of(test::sphere(Vec3::Zero(), 0.08, levels), "ball"); }

TEST(PatchFit, TooFineASurfaceIsRefusedWithLimitMeasureAndAdvice) {
  const std::string message = refusal(ball(8));
  for (const char* part : {"ball.organ.toml", "too fine to be felt", "holds 512 triangles within 25 mm",
                           "here are up to ", "mm are needed", "import it again with --triangles "})
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
}

TEST(PatchFit, TheAdviceHolds) {
  const PatchFit fine = patch_fit(scene_of(ball(6)));
  ASSERT_FALSE(fine.whole()) << fine.most;
  EXPECT_TRUE(fine.felt()) << fine.reach_m;
  EXPECT_NE(fine.words().find("enough to feel it"), std::string::npos) << fine.words();
  EXPECT_LT(fine.advised, 32768);
  const PatchFit coarse = patch_fit(scene_of(ball(4)));  // 2048 triangles
  EXPECT_TRUE(coarse.whole()) << coarse.most;
  EXPECT_GE(coarse.advised, 1800) << "what fits needs no thinning but the reserve";
  EXPECT_EQ(coarse.reach_m, kPatchRadius);
  // As many triangles as advised, of the same shape, fit: their number near the tool goes with the number of all.
  EXPECT_LE(static_cast<double>(fine.most) * fine.advised / 32768, kMaxPatchTriangles);
}

}  // namespace
}  // namespace trocar::shaft_proof_test
