// The world as a whole: patch and frame with and without an organ, pick and drop, pairs, limits, determinism.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "haptics/input_error.h"
#include "tests/tissue/solid/bed_rig.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/world_rig.h"

namespace trocar::tissue_world_test {
namespace {

struct World : test::WorldRig {
  /// Moves the tip to `to` and the jaws to `opening` over `seconds`, at the tissue rate.
  void move(const Vec3& to, double opening, double seconds, bool present = true) {
    const Vec3 from = state.X_TI.p;
    const double from_opening = state.jaw_opening_m;
    const int steps = static_cast<int>(std::lround(seconds * 100));
    for (int i = 1; i <= steps; ++i) {
      const double s = double(i) / steps;
      state.X_TI.p = from + s * (to - from);
      state.V_TI_T.linear = (to - from) / seconds;
      state.jaw_opening_m = from_opening + s * (opening - from_opening);
      step(1, present);
    }
    state.V_TI_T.linear.setZero();
  }
  const ObjectState& object(std::size_t i) const { return world->frame().object[i]; }
};

Vec3 place(const TriangleSurface& surface, const MaterialPoint& at) {
  const auto& [a, b, c] = surface.triangles[std::size_t(at.triangle)];
  return interpolate(at.weight, {surface.vertices[std::size_t(a)], surface.vertices[std::size_t(b)],
                                 surface.vertices[std::size_t(c)]});
}

TEST(TissueWorld, WithoutInstrumentThereIsNothingToFeelAndTheBlocksRest) {
  World w;
  w.start();
  w.move(Vec3(0, 0, 0.010), 0.022, 0.5, false);
  EXPECT_EQ(w.patch->count, 0);
  EXPECT_EQ(w.object(0).motion, ObjectMotion::kResting);
  EXPECT_NEAR(w.object(0).X_TO.p.z(), 0.010, 1e-4);
  EXPECT_EQ(w.world->frame().object_count, 2);
  EXPECT_EQ(w.world->frame().stamp, 50u);
}

TEST(TissueWorld, AnOrganAloneIsCutIntoThePatch) {
  World w;
  const TriangleSurface organ = test::box(Vec3(-0.03, -0.03, -0.02), Vec3(0.03, 0.03, 0));
  w.setup.organ_T = &organ;
  w.setup.organ.stiffness_n_per_m = 123;
  w.setup.rigid = {};
  w.start();
  w.move(Vec3(0, 0, 0.005), 0.002, 0.1);
  EXPECT_GT(w.patch->count, 0);
  EXPECT_EQ(w.triangles_of(0), w.patch->count);
  EXPECT_EQ(w.patch->material[0].stiffness_n_per_m, 123);
  EXPECT_EQ(w.world->frame().object_count, 0);
}

TEST(TissueWorld, AnOrganThatGivesWayIsStoppedByTheOneBesideIt) {
  const SurfacePtr block = still_surface(test::divided_box({-0.03, -0.03, 0}, {0.03, 0.03, 0.03}, 0.005));
  const TriangleSurface both = test::joined(*block, test::divided_box({-0.1, -0.1, -0.031}, {0.1, 0.1, -0.001}, 0.02));
  auto soft = std::make_shared<SoftSetup>();
  soft->options.bed_n_per_m3 = 5e3;
  soft->lattice = build_lattice(*block, {.cell_m = soft->options.solid.edge_m}).lattice;
  const auto sunk = [&](const TriangleSurface& all) {
    TissueSetup setup;
    setup.organ_T = &all;
    setup.seen_T = block;
    setup.soft = soft;
    if (&all == &both) setup.adjacent = {ContactMaterial{}};
    std::vector<std::int32_t> material(all.triangles.size(), 1);
    std::fill_n(material.begin(), block->triangles.size(), 0);
    setup.triangle_material = material;
    setup.tools = {make_tool(InstrumentKind::kProbe)};
    TissueWorld world(setup);
    const auto patch = std::make_unique<ContactPatch>();
    HapticState state;
    state.contacts.count = 1;
    SolvedContact& contact = state.contacts.at[0];
    contact.place = {0, {1. / 3, 1. / 3, 1. / 3}};
    while (place(*block, contact.place).z() < 0.0299) ++contact.place.triangle;
    contact.normal_T = Vec3::UnitZ();
    contact.force_T = Vec3::UnitZ();
    contact.anchor.triangle = -1;
    contact.tool_T = place(*block, contact.place) - Vec3(0, 0, 0.012);
    for (int i = 0; i < 100; ++i) {
      state.stylus.t_s += 0.01;
      world.step(state, true, *patch);
    }
    double low = 0;
    for (const Vec3& vertex : world.surface()->vertices) low = std::min(low, vertex.z());
    return low;
  };
  EXPECT_LT(sunk(*block), -0.003);
  EXPECT_GT(sunk(both), -0.002);
}

TEST(TissueWorld, BoardAndBlocksAreFeltWithMaterialsOfTheirOwn) {
  World w;
  w.start();
  w.move(Vec3(0.016, 0.020, 0.010), 0.002, 0.3);
  EXPECT_EQ(w.triangles_of(kBoardMaterial), 2);
  EXPECT_EQ(w.triangles_of(kFirstFoamMaterial), 12);
  EXPECT_EQ(w.triangles_of(kFirstFoamMaterial + 1), 12);
  for (int i = 0; i < w.patch->count; ++i) {
    const PatchTriangle& t = w.patch->triangle[std::size_t(i)];
    if (t.material < kFirstFoamMaterial) continue;
    const Vec3 middle = w.object(t.material - kFirstFoamMaterial).X_TO.p;
    EXPECT_GT(t.normal.dot(w.patch->corners(i)[0] - middle), 0) << "outward";
  }
  EXPECT_EQ(w.patch->material[kBoardMaterial].stiffness_n_per_m, w.setup.rigid.board->material.stiffness_n_per_m);
}

TEST(TissueWorld, PickLiftAndDropTakesTheTimeOfTheFall) {
  World w;
  w.start();
  w.move(Vec3(0, 0, 0.008), 0.022, 0.3);
  EXPECT_EQ(w.world->frame().grip, GripState::kAround);
  EXPECT_EQ(w.triangles_of(kFirstFoamMaterial), 0) << "the pinch feels it now";
  w.move(Vec3(0, 0, 0.008), 0.0105, 0.3);
  EXPECT_EQ(w.world->frame().grip, GripState::kHolding);
  EXPECT_GT(w.patch->held.radius_m, 0);
  w.move(Vec3(0, 0, 0.038), 0.0105, 0.5);
  EXPECT_NEAR(w.object(0).X_TO.p.z(), 0.040, 1e-6);
  EXPECT_EQ(w.object(0).motion, ObjectMotion::kHeld);
  w.move(Vec3(0, 0, 0.038), 0.022, 0.02);
  int steps = 0;
  while (w.object(0).X_TO.p.z() > 0.0102 && steps < 50) {
    w.move(Vec3(0, 0, 0.038), 0.022, 0.01);
    ++steps;
  }
  EXPECT_NEAR(steps * 0.01, std::sqrt(2 * 0.030 / kGravity), 0.021) << "steps of 10 ms, and the jaws open over two";
  w.move(Vec3(0, 0, 0.038), 0.022, 0.3);
  EXPECT_EQ(w.object(0).motion, ObjectMotion::kResting);
  EXPECT_NEAR(w.object(0).X_TO.p.z(), 0.010, 1e-4);
}

TEST(TissueWorld, OnlyAGrasperTakesABlockAndOneThatIsExchangedLetsGo) {
  World w;
  w.setup.tools.push_back(make_tool(InstrumentKind::kScissors));
  w.state.instrument = 1;
  w.start();
  w.move(Vec3(0, 0, 0.008), 0.022, 0.3);
  w.move(Vec3(0, 0, 0.008), 0.0105, 0.3);
  EXPECT_EQ(w.world->frame().grip, GripState::kEmpty);
  EXPECT_EQ(w.patch->held.radius_m, 0);
  w.move(Vec3(0, 0, 0.008), 0.022, 0.3);
  w.state.instrument = 0;
  w.move(Vec3(0, 0, 0.008), 0.0105, 0.3);
  EXPECT_EQ(w.world->frame().grip, GripState::kHolding);
  w.state.instrument = 1;
  w.step(1);
  EXPECT_EQ(w.world->frame().grip, GripState::kEmpty);
}

TEST(TissueWorld, AHeldBlockPushesAnotherAndThePairIsListed) {
  World w;
  w.start();
  w.move(Vec3(0, 0, 0.008), 0.022, 0.3);
  w.move(Vec3(0, 0, 0.008), 0.0105, 0.3);
  bool met = false;
  for (int k = 1; k <= 100; ++k) {
    w.move(Vec3(0.00025 * k, 0, 0.009), 0.0105, 0.01);
    for (int i = 0; i < w.world->frame().pair_count; ++i) {
      const ContactPair& pair = w.world->frame().pair[std::size_t(i)];
      met = met || (pair.a == 0 && pair.b == 1);
    }
  }
  EXPECT_TRUE(met);
  EXPECT_NEAR(w.object(1).X_TO.p.x() - w.object(0).X_TO.p.x(), 0.014, 1e-3);
}

TEST(TissueWorld, TheJawsTakeOneBlockAndPushTheOther) {
  World w;
  w.setup.rigid.blocks = {test::foam_block(Vec3(0, -0.0071, 0.010)), test::foam_block(Vec3(0, 0.0071, 0.010))};
  w.start();
  w.move(Vec3(0, 0, 0.008), 0.028, 0.3);
  w.move(Vec3(0, 0, 0.008), 0.010, 0.5);
  int held = 0;
  for (std::size_t i = 0; i < 2; ++i) held += w.object(i).motion == ObjectMotion::kHeld;
  EXPECT_LE(held, 1);
  w.move(Vec3(0, 0, 0.050), 0.010, 0.5);
  int lifted = 0;
  for (std::size_t i = 0; i < 2; ++i) lifted += w.object(i).X_TO.p.z() > 0.030;
  EXPECT_LE(lifted, 1);
}

TEST(TissueWorld, ToolAndBoardMakeAPairWithItsForce) {
  World w;
  w.start();
  w.move(Vec3(0, 0.040, 0.001), 0.002, 0.3);
  bool met = false;
  for (int i = 0; i < w.world->frame().pair_count; ++i) {
    const ContactPair& pair = w.world->frame().pair[std::size_t(i)];
    if (pair.b != kPartyBoard || pair.a != kPartyJaw) continue;
    met = true;
    EXPECT_NEAR(pair.force_n, pair.depth_m * w.setup.rigid.board->material.stiffness_n_per_m, 1e-12);
    EXPECT_GT(pair.depth_m, 0);
    EXPECT_NEAR(pair.normal_T.z(), 1, 1e-12);
  }
  EXPECT_TRUE(met);
}

TEST(TissueWorld, RefusesMoreBlocksAndKindsThanItCanHold) {
  World w;
  w.setup.rigid.blocks.assign(kMaxObjects + 1, test::foam_block(Vec3(0, 0, 0.010)));
  EXPECT_THROW(w.start(), InputError);
  w.setup.rigid.blocks = {test::foam_block(Vec3(0, 0, 0.010), kMaxPatchMaterials - kFirstFoamMaterial)};
  EXPECT_THROW(w.start(), InputError);
}

TEST(TissueWorld, TheSameStatesGiveTheSameFrames) {
  const auto run = [] {
    World w;
    w.start();
    w.move(Vec3(0.002, 0.001, 0.008), 0.022, 0.3);
    w.move(Vec3(0.002, 0.001, 0.008), 0.0105, 0.3);
    w.move(Vec3(0.03, 0.01, 0.050), 0.0105, 0.4);
    w.move(Vec3(0.03, 0.01, 0.050), 0.022, 0.5);
    return std::array<Vec3, 3>{w.object(0).X_TO.p, w.object(0).X_TO.R.col(0), w.object(1).X_TO.p};
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace trocar::tissue_world_test
