// The loop's memory: every change of state, at least 2 s before each of the latest, a fault's kept until the reset.
#include "haptics/control/safety_log.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/allocation_guard.h"

namespace trocar::safety_log_test {
namespace {

class SafetyLogTest : public ::testing::Test {
 protected:
  void feed(LoopState state, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      record.stylus.tick = record.stylus.period = next++;
      record.stylus.loop = state;
      record.in.counts[0] = static_cast<std::int32_t>(record.stylus.tick);
      log.add(record);
    }
  }
  void start() {
    feed(LoopState::kSelfTest, 100);
    feed(LoopState::kUnhomed, 500);
    feed(LoopState::kHomed, 200);
    feed(LoopState::kArmed, 20);
  }
  bool holds(std::uint64_t from, std::uint64_t to) const {
    const auto rows = log.rows();
    for (std::uint64_t tick = from; tick < to; ++tick) {
      if (std::none_of(rows.begin(), rows.end(), [&](const SafetyRow& r) { return r.tick == tick; })) return false;
    }
    return true;
  }

  SafetyLog log{1000};
  TickRecord record;
  std::uint64_t next = 0;
};

TEST_F(SafetyLogTest, NotesEveryChangeWithItsTickAndCause) {
  start();
  feed(LoopState::kActive, 3000);
  record.stylus.fault = {FaultCode::kOverspeed, 4, 3820, 16};
  feed(LoopState::kFault, 200);
  const auto changes = log.transitions();
  ASSERT_EQ(changes.size(), 6u);
  const LoopState states[] = {LoopState::kOff,   LoopState::kSelfTest, LoopState::kUnhomed, LoopState::kHomed,
                              LoopState::kArmed, LoopState::kActive,   LoopState::kFault};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    EXPECT_EQ(changes[i].from, states[i]);
    EXPECT_EQ(changes[i].to, states[i + 1]);
  }
  EXPECT_EQ(changes[5].tick, 3820u);
  EXPECT_EQ(changes[5].fault.code, FaultCode::kOverspeed);
  EXPECT_EQ(changes[5].fault.channel, 4);
}

TEST_F(SafetyLogTest, TwoSecondsBeforeAFaultStayWhateverFollows) {
  start();
  feed(LoopState::kActive, 30000);
  const std::uint64_t fault = next;
  feed(LoopState::kFault, 60000);
  EXPECT_TRUE(holds(fault - 2000, fault + 100));
  EXPECT_FALSE(holds(fault + 100, fault + 101)) << "it stands still";
  EXPECT_TRUE(holds(0, 820)) << "the start is still there";
  const auto rows = log.rows();
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end(), [](auto& a, auto& b) { return a.tick < b.tick; }));
  const SafetyRow& last = rows.back();
  EXPECT_EQ(last.state, LoopState::kFault);
  EXPECT_EQ(last.counts[0], static_cast<std::int32_t>(last.tick)) << "a row is its own tick's";
}

TEST_F(SafetyLogTest, AResetGoesOnWithTheNextBankAndKeepsTheFault) {
  start();
  feed(LoopState::kActive, 5000);
  const std::uint64_t fault = next;
  feed(LoopState::kFault, 1000);
  const std::uint64_t reset = next;
  start();
  feed(LoopState::kActive, 5000);
  EXPECT_TRUE(holds(fault - 2000, fault + 100));
  EXPECT_TRUE(holds(reset, reset + 820));
  EXPECT_EQ(log.transitions().size(), 11u);
}

TEST_F(SafetyLogTest, AResetThatIsRefusedWithinItsTickIsNotedWithItsNewCause) {
  start();
  feed(LoopState::kActive, 3000);
  record.stylus.fault = {FaultCode::kOverheat, 2, next, 121};
  feed(LoopState::kFault, 300);
  record.stylus.fault = {FaultCode::kEmergencyStop, -1, next, 1};
  feed(LoopState::kFault, 300);
  const auto changes = log.transitions();
  ASSERT_EQ(changes.size(), 7u);
  EXPECT_EQ(changes[6].from, LoopState::kFault);
  EXPECT_EQ(changes[6].to, LoopState::kFault);
  EXPECT_EQ(changes[6].fault.code, FaultCode::kEmergencyStop);
  EXPECT_EQ(changes[5].fault.code, FaultCode::kOverheat);
  EXPECT_TRUE(holds(1820, 3820)) << "the 2 s before the first are still there";
}

TEST_F(SafetyLogTest, ChangesCloseTogetherShareABankAndOldOnesAreUsedAgain) {
  start();
  for (int k = 0; k < 20; ++k) {
    feed(LoopState::kActive, 400);
    feed(LoopState::kHomed, 400);
  }
  EXPECT_TRUE(holds(next - 2000, next)) << "the latest 2 s lie in several banks";
  EXPECT_FALSE(holds(0, 1)) << "the oldest went";
  EXPECT_LE(log.rows().size(), 2100u * SafetyLog::kBanks);
}

TEST_F(SafetyLogTest, CountsWhatItCouldNotNote) {
  for (int k = 0; k < 50; ++k) {
    feed(LoopState::kHomed, 3);
    feed(LoopState::kArmed, 3);
  }
  EXPECT_EQ(log.transitions().size(), SafetyLog::kTransitions);
  EXPECT_EQ(log.transitions_lost(), 100 - SafetyLog::kTransitions);
}

TEST_F(SafetyLogTest, AddingAllocatesNothing) {
  std::uint64_t allocations = 0;
  for (int k = 0; k < 10; ++k) {
    const test::AllocationGuard guard;
    feed(k % 2 ? LoopState::kActive : LoopState::kHomed, 300);
    allocations += guard.allocations();
  }
  EXPECT_EQ(allocations, 0u);
}

TEST(SafetyLogRate, HoldsTwoSecondsAtFourKilohertzToo) {
  SafetyLog log(4000);
  TickRecord record;
  for (std::uint64_t tick = 0; tick < 20000; ++tick) {
    record.stylus.tick = tick;
    record.stylus.loop = LoopState::kActive;
    log.add(record);
  }
  const auto rows = log.rows();
  EXPECT_EQ(rows.back().tick, 19999u);
  EXPECT_GE(rows.size(), 8000u);
}

}  // namespace
}  // namespace trocar::safety_log_test
