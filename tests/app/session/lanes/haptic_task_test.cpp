#include "app/session/lanes/haptic_task.h"

#include <gtest/gtest.h>

#include "tests/haptics/loop_rig.h"

namespace trocar::haptic_task_test {
namespace {

TEST(HapticTask, GivesTheTissueTheStateAndTheContactsOfItsTick) {
  test::LoopRig rig;
  rig.start();
  rig.move(test::working_pose(), 1.5);
  rig.put_floor(0.002, 150);
  rig.patch->topology = 4;
  Pose deep = rig.goal;
  deep.p.z() -= 0.010;
  rig.move(deep, 0.5);
  DelayedChannel<ContactPatch> patches(0, *rig.patch);
  DelayedChannel<HapticState> states(0);
  HapticTask task(rig.daq, rig.loop, {patches, states}, 100);
  for (std::uint64_t tick = 0; tick < 20; ++tick) {
    task.run(tick);
    const HapticState& told = states.newest(tick);
    ASSERT_EQ(told.stylus.tick, task.record().stylus.tick);
    ASSERT_EQ(told.contacts.topology, 4u);
    ASSERT_EQ(told.contacts.count, 1);
    ASSERT_LT((told.contacts.at[0].force_T - told.stylus.F_I_T.force).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace trocar::haptic_task_test
