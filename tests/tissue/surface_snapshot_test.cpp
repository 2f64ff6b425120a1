#include "tissue/surface_snapshot.h"

#include <gtest/gtest.h>

#include "tests/tissue/support/world_rig.h"

namespace trocar::surface_snapshot_test {
namespace {

TEST(SurfaceSnapshot, AnOrganThatStandsStillIsOneForAllSteps) {
  test::WorldRig rig;
  rig.setup.seen_T = still_surface({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{{0, 1, 2}}}});
  rig.start();
  const SurfacePtr before = rig.world->surface();
  rig.world->step({}, true, *rig.patch);
  EXPECT_EQ(rig.world->surface(), before) << "shared, not copied";
  EXPECT_EQ(before, rig.setup.seen_T);
}

TEST(SurfaceSnapshot, ThePatchTellsItsTopology) {
  test::WorldRig rig;
  rig.step();
  EXPECT_EQ(rig.patch->topology, 0u);
  auto cut = std::make_shared<SurfaceSnapshot>();
  cut->topology = 3;
  rig.setup.seen_T = cut;
  rig.start();
  rig.step();
  EXPECT_EQ(rig.patch->topology, 3u);
}

}  // namespace
}  // namespace trocar::surface_snapshot_test
