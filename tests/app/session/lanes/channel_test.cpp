// Channels between tasks: declared delay in lockstep, newest whole value live.
#include "app/session/lanes/channel.h"

#include <gtest/gtest.h>

namespace trocar::channel_test {
namespace {

TEST(DelayedChannel, ShowsAValueWhenItsDelayHasPassed) {
  DelayedChannel<int> channel(5, -1);
  EXPECT_EQ(channel.newest(0), -1);
  channel.write(10, 42);
  EXPECT_EQ(channel.newest(14), -1);
  EXPECT_EQ(channel.newest(15), 42);
  channel.write(20, 43);
  EXPECT_EQ(channel.newest(24), 42);
  channel.write(30, 44);
  EXPECT_EQ(channel.newest(30), 43) << "the earlier one had become visible before the next was begun";
  EXPECT_EQ(channel.newest(35), 44);
}

TEST(DelayedChannel, WithoutDelayAValueIsSeenInItsOwnTick) {
  DelayedChannel<int> channel(0);
  for (int tick = 0; tick < 5; ++tick) {
    channel.write(static_cast<std::uint64_t>(tick), 10 + tick);
    EXPECT_EQ(channel.newest(static_cast<std::uint64_t>(tick)), 10 + tick);
  }
}

TEST(DelayedChannel, AValueBegunIsNotSeenBeforeItIsCommitted) {
  DelayedChannel<int> channel(0, 1);
  channel.begin(0) = 2;
  EXPECT_EQ(channel.newest(0), 1);
  channel.commit();
  EXPECT_EQ(channel.newest(0), 2);
}

TEST(LiveChannel, ShowsTheNewestCommittedValueWhateverTheTicks) {
  const auto channel = make_channel<int>(Timing::kLive, 5);
  EXPECT_EQ(channel->newest(0), 0);
  channel->write(1000, 1);
  channel->begin(2000) = 2;
  EXPECT_EQ(channel->newest(0), 1);
  channel->commit();
  EXPECT_EQ(channel->newest(0), 2);
}

TEST(MakeChannel, GivesTheFormThatTheTimingAsksFor) {
  const auto lockstep = make_channel<int>(Timing::kLockstep, 3);
  lockstep->write(0, 7);
  EXPECT_EQ(lockstep->newest(2), 0);
  EXPECT_EQ(lockstep->newest(3), 7);
}

}  // namespace
}  // namespace trocar::channel_test
