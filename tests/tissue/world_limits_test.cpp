// The world's patch and frame in detail: materials, identities, what is held, crushed, slipping, or far away.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>

#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/world_rig.h"

namespace trocar::world_limits_test {
namespace {

struct Scene : test::WorldRig {
  Scene() { state.X_TI.p = Vec3(0, 0, 0.008); }
  /// Closes until the block pushes back with this force.
  void squeeze(double force_n, int steps = 1) {
    state.jaw_opening_m = patch->grip.thickness_m - force_n / patch->grip.stiffness_n_per_m;
    step(steps);
  }
  void grasp() {
    step(30);
    squeeze(1.0, 5);
    ASSERT_EQ(frame().grip, GripState::kHolding);
  }
  void raise(double height, int steps) {
    for (int i = 0; i < steps; ++i) {
      state.X_TI.p.z() += height / steps;
      step();
    }
  }
  const TissueFrame& frame() const { return world->frame(); }
};

TEST(WorldPatch, MaterialsAreThoseOfOrganBoardAndEachFoam) {
  Scene s;
  s.setup.organ = {88, 0.3, 0.4, 0.2, 0.01};
  s.setup.rigid.board->material = {210, 0.7, 0.5, 0.31, 0.22};
  s.step();
  EXPECT_EQ(s.patch->material[0].stiffness_n_per_m, 88);
  EXPECT_EQ(s.patch->material[0].stribeck_m_s, 0.01);
  const ContactMaterial& board = s.patch->material[kBoardMaterial];
  EXPECT_EQ(board.stiffness_n_per_m, 210);
  EXPECT_EQ(board.damping_s_per_m, 0.7);
  EXPECT_EQ(board.mu_static, 0.31);
  EXPECT_EQ(board.mu_dynamic, 0.22);
  for (int kind = 0; kind < 2; ++kind) {
    const ContactMaterial& material = s.patch->material[std::size_t(kFirstFoamMaterial + kind)];
    EXPECT_EQ(material.stiffness_n_per_m, 300 + 100 * kind);
    EXPECT_LE(material.mu_dynamic, material.mu_static);
  }
}

TEST(WorldPatch, TrianglesKeepTheirNamesFromPatchToPatch) {
  Scene s;
  s.state.X_TI.p = Vec3(0.016, 0.020, 0.010);
  const auto names = [&] {
    std::set<std::int32_t> ids;
    for (int i = 0; i < s.patch->count; ++i) ids.insert(s.patch->triangle[std::size_t(i)].id);
    EXPECT_EQ(static_cast<int>(ids.size()), s.patch->count) << "no name twice";
    return ids;
  };
  s.step(30);
  const std::set<std::int32_t> before = names();
  EXPECT_EQ(before.size(), 2u + 12 + 12);
  EXPECT_GE(*before.begin(), kFirstRigidId) << "below are those of an organ";
  const std::uint64_t stamp = s.patch->stamp;
  s.step(5);
  EXPECT_EQ(names(), before);
  EXPECT_EQ(s.patch->stamp, stamp + 5);
}

TEST(WorldPatch, OnlyBlocksWithinReachOfTheToolAreInIt) {
  Scene s;
  s.state.X_TI.p = Vec3(0.075, 0, 0.010);
  s.step();
  EXPECT_EQ(s.triangles_of(kBoardMaterial), 2);
  EXPECT_EQ(s.triangles_of(kFirstFoamMaterial), 0) << "68 mm from the shaft";
  EXPECT_EQ(s.triangles_of(kFirstFoamMaterial + 1), 0) << "36 mm from the shaft";
  s.state.X_TI.p = Vec3(0.055, 0, 0.010);
  s.step();
  EXPECT_EQ(s.triangles_of(kFirstFoamMaterial + 1), 12) << "16 mm from the shaft";
  EXPECT_EQ(s.patch->reach_m, kPatchRadius);
}

TEST(WorldPatch, TheTriangleThatDoesNotFitIsCountedOverTheRun) {
  Scene s;
  const TriangleSurface organ = test::sphere(Vec3(0, 0, 0), 0.020, 4);
  ASSERT_GT(organ.triangles.size(), std::size_t(kMaxPatchTriangles));
  s.setup.organ_T = &organ;
  s.state.X_TI.p = Vec3(0, 0, 0.021);
  s.step();
  EXPECT_EQ(s.patch->count, kMaxPatchTriangles);
  EXPECT_GT(s.patch->dropped, 0);
  const std::uint64_t once = s.world->dropped();
  EXPECT_EQ(once, static_cast<std::uint64_t>(s.patch->dropped));
  s.step();
  EXPECT_EQ(s.world->dropped(), once + static_cast<std::uint64_t>(s.patch->dropped));
  s.step(1, false);
  EXPECT_EQ(s.patch->dropped, 0) << "nothing is felt, nothing is missing";
}

TEST(WorldFrame, TellsWhatTheBlocksAreAndWhenItWasMade) {
  Scene s;
  s.state.t_s = 4;
  s.step(3);
  EXPECT_NEAR(s.frame().t_s, 4.03, 1e-12);
  EXPECT_EQ(s.frame().stamp, 3u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(s.frame().object[i].kind, int(i));
    EXPECT_EQ(s.frame().object[i].colour, 7 - int(i));
    EXPECT_LT((s.frame().object[i].size_m - Vec3(0.014, 0.014, 0.020)).norm(), 1e-15);
    EXPECT_FALSE(s.frame().object[i].crushed);
  }
}

TEST(WorldFrame, AGapInTheStatesCountsAsFiftyMilliseconds) {
  Scene s;
  s.setup.rigid.blocks = {test::foam_block(Vec3(0.2, 0, 0.5))};
  s.step();
  s.state.t_s += 10;
  s.step();
  EXPECT_NEAR(s.frame().object[0].X_TO.p.z(), 0.5 - kGravity * 0.06 * 0.06 / 2, 1e-12);
  EXPECT_NEAR(s.frame().object[0].velocity_T.z(), -kGravity * 0.06, 1e-12);
  EXPECT_EQ(s.frame().object[0].motion, ObjectMotion::kMoving);
  const double height = s.frame().object[0].X_TO.p.z();
  s.world->step({s.state}, true, *s.patch);
  EXPECT_EQ(s.frame().object[0].X_TO.p.z(), height) << "the same time again: no step";
}

TEST(WorldFrame, BlocksRestOnABoardOfAnyHeight) {
  Scene s;
  s.setup.rigid.board->top_z_m = -0.030;
  s.setup.rigid.blocks = {test::foam_block(Vec3(0, 0, -0.018)), test::foam_block(Vec3(0.15, 0, -0.018))};
  s.state.X_TI.p = Vec3(0.03, 0.03, 0);
  s.step(100);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(s.frame().object[i].X_TO.p.z(), -0.020, 1e-4) << "on the board, and on the table level with it";
    EXPECT_EQ(s.frame().object[i].motion, ObjectMotion::kResting);
  }
  for (int i = 0; i < s.patch->count; ++i) {
    const PatchTriangle& t = s.patch->triangle[std::size_t(i)];
    if (t.material != kBoardMaterial) continue;
    for (const Vec3& v : s.patch->corners(i)) EXPECT_EQ(v.z(), -0.030);
    EXPECT_EQ(t.normal, Vec3::UnitZ());
  }
}

TEST(WorldGrip, TheHeldCapsuleStandsWhereTheBlockIsShown) {
  Scene s;
  s.grasp();
  s.raise(0.040, 40);
  const HeldObject& held = s.patch->held;
  EXPECT_NEAR(held.radius_m, 0.007, 1e-12);
  EXPECT_NEAR((held.from_I - held.to_I).norm(), 0.006, 1e-12);
  const Vec3 middle = s.state.X_TI * Vec3((held.from_I + held.to_I) / 2);
  EXPECT_LT((middle - s.frame().object[0].X_TO.p).norm(), 1e-12);
  EXPECT_EQ(s.frame().grip_object, 0);
  s.step(1, false);
  EXPECT_EQ(s.patch->held.radius_m, 0) << "the instrument has left the scene";
  EXPECT_EQ(s.frame().grip, GripState::kEmpty);
  s.step(60, false);
  EXPECT_NEAR(s.frame().object[0].X_TO.p.z(), 0.010, 2e-4) << "and the block has fallen";
}

TEST(WorldGrip, ACrushedBlockIsThinnerForTheEyeAndSofterForTheFingers) {
  Scene s;
  s.grasp();
  s.squeeze(1.45, 3);
  EXPECT_FALSE(s.frame().object[0].crushed);
  s.squeeze(1.6, 3);
  EXPECT_TRUE(s.frame().object[0].crushed);
  EXPECT_NEAR(s.frame().object[0].size_m.y(), 0.75 * 0.014, 1e-9);
  EXPECT_NEAR(s.patch->grip.thickness_m, 0.75 * 0.014, 1e-9);
  EXPECT_NEAR(s.patch->grip.stiffness_n_per_m, 150, 1e-9);
  EXPECT_FALSE(s.frame().object[1].crushed);
}

TEST(WorldGrip, TheFrameCountsTheSlip) {
  Scene s;
  s.grasp();
  s.raise(0.040, 40);
  EXPECT_EQ(s.frame().slipped_m, 0);
  const double height = s.frame().object[0].X_TO.p.z();
  s.squeeze(0.3, 20);
  EXPECT_EQ(s.frame().grip, GripState::kSlipping);
  EXPECT_TRUE(s.frame().held());
  EXPECT_NEAR(s.frame().slipped_m, 0.040 * (1 - 0.3 / 0.5) * 0.2, 1e-9);
  EXPECT_NEAR(height - s.frame().object[0].X_TO.p.z(), s.frame().slipped_m, 1e-12);
}

TEST(WorldPairs, AHeldBlockMeetsThePortOnlyInItsTube) {
  for (const double along : {0.050, 0.120}) {
    Scene s;
    s.setup.rigid.port = PortTube{Vec3(0, 0, along), Vec3::UnitZ(), 0.006, 0.020};
    s.grasp();
    s.raise(0.040, 40);
    int met = 0;
    for (int i = 0; i < s.frame().pair_count; ++i) {
      const ContactPair& pair = s.frame().pair[std::size_t(i)];
      met += pair.a == 0 && pair.b == kPartyPort;
      EXPECT_NEAR(pair.normal_T.norm(), 1, 1e-9);
      EXPECT_GE(pair.depth_m, 0);
    }
    EXPECT_EQ(met, along < 0.1 ? 1 : 0) << along;
  }
}

}  // namespace
}  // namespace trocar::world_limits_test
