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

}  // namespace
}  // namespace trocar::surface_snapshot_test
