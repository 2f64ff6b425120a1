// How a run ends when a part of it fails, on every back-end: the torque is off before anybody waits for anybody.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "app/session/lanes/haptic_task.h"
#include "app/session/lanes/lockstep_executor.h"
#include "app/session/lanes/threaded_executor.h"
#include "haptics/device/backends/simulated_board.h"

namespace trocar::torque_at_the_end_test {
namespace {

/// An arm that carries its weight on a board, with the task that runs it.
class TorqueAtTheEnd : public testing::TestWithParam<std::string> {
 protected:
  TorqueAtTheEnd() {
    const Pose jig = board.world->sense().X_BS;
    for (int k = 0; k < 2500; ++k) {
      if (k > 700) board.world->set_hand_intent(jig, 0.02);
      ++patch->stamp;
      const DacFrame out = loop.tick(board.daq->read(), *patch, record);
      board.daq->arm(record.amplifiers_armed);
      board.daq->write(out);
    }
  }
  void SetUp() override {
    ASSERT_EQ(record.stylus.loop, LoopState::kActive) << fault_name(record.stylus.fault.code);
    ASSERT_GT(load(), 0.01);
  }
  double load() const {
    const auto held = board.hold();
    return board.device->plant().motor_loads().cwiseAbs().maxCoeff();
  }
  bool off() const { return !board.world->sense().amplifiers_enabled && load() == 0; }
  HapticLoopConfig config() const {
    HapticLoopConfig out;
    out.daq = board.daq->capabilities();
    out.safety.max_patch_age_s = 0.2;
    out.safety.max_missed_in_a_row = 100000;  // the machine of the tests may be late
    out.safety.max_missed_share = 1e9;
    return out;
  }

  SimulatedBoard board = open_simulated_board(GetParam(), {});
  HapticLoop loop{config()};
  std::unique_ptr<ContactPatch> patch = std::make_unique<ContactPatch>();
  TickRecord record;
  std::unique_ptr<Channel<ContactPatch>> patches = make_channel<ContactPatch>(Timing::kLive);
  std::unique_ptr<Channel<HapticState>> states = make_channel<HapticState>(Timing::kLive);
  HapticTask haptic{*board.daq, loop, {*patches, *states}, 1e9};
};

/// Makes a patch each period until something happens to it.
class Tissue : public Task {
 public:
  Tissue(Outlet<ContactPatch>& patch, std::uint64_t stamp) : patch_(patch), stamp_(stamp) {}
  std::uint32_t period() const override { return 10; }
  void run(std::uint64_t tick) override {
    if (tick == 20) happens();
    patch_.begin(tick).stamp = ++stamp_;
    patch_.commit();
  }
  std::function<void()> happens = [] {};

 private:
  Outlet<ContactPatch>& patch_;
  std::uint64_t stamp_;
};

/// A task that hangs from its third call on, as one that waits for a disk, until what it waits for has come.
class Hanging : public Task {
 public:
  explicit Hanging(std::function<bool()> until) : until_(std::move(until)) {}
  std::uint32_t period() const override { return 10; }
  void run(std::uint64_t tick) override {
    if (tick >= 2) seen = wait(until_);
  }
  static bool wait(const std::function<bool()>& until) {
    for (int k = 0; k < 5000 && !until(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return until();
  }
  std::atomic<bool> seen = false;

 private:
  std::function<bool()> until_;
};

TEST_P(TorqueAtTheEnd, ATaskThatThrowsDoesNotLeaveItOnUntilTheSlowestHasEnded) {
  Tissue tissue(*patches, patch->stamp);
  tissue.happens = [] { throw std::runtime_error("No space left on device"); };
  Hanging recorder([this] { return off(); });
  ThreadedExecutor executor(1000);
  executor.add_lane("haptic", {&haptic}, 0);
  executor.add_lane("tissue", {&tissue}, 0);
  executor.add_lane("recorder", {&recorder}, 0);
  EXPECT_THROW(executor.run(), std::runtime_error);
  EXPECT_TRUE(recorder.seen) << "the recorder still hung when the torque went off";
  EXPECT_TRUE(off());
}

TEST_P(TorqueAtTheEnd, ATissueThatHangsIsAStalePatchAndTheLoopStopsByItself) {
  Tissue tissue(*patches, patch->stamp);
  bool seen = false;
  tissue.happens = [&] { seen = Hanging::wait([this] { return off(); }); };
  ThreadedExecutor executor(1000);
  executor.add_lane("haptic", {&haptic}, 0);
  executor.add_lane("tissue", {&tissue}, 0);
  executor.run();
  EXPECT_TRUE(seen) << "the tissue still hung when the torque went off";
  EXPECT_STREQ(fault_name(haptic.record().stylus.fault.code), "stale-patch");
  EXPECT_NEAR(haptic.record().stylus.fault.value, 0.2, 0.15) << "its age, in the loop's own time";
}

TEST_P(TorqueAtTheEnd, InLockstepItIsOffInTheTickInWhichATaskThrows) {
  struct Full final : Task {
    std::uint32_t period() const override { return 100; }
    void run(std::uint64_t tick) override {
      if (tick == 200) throw std::runtime_error("No space left on device");
    }
  } full;
  Tissue tissue(*patches, patch->stamp);
  LockstepExecutor executor;
  for (Task* task : {static_cast<Task*>(&haptic), static_cast<Task*>(&tissue), static_cast<Task*>(&full)})
    executor.add(*task);
  const double before = board.world->time_s();
  EXPECT_THROW(executor.run(), std::runtime_error);
  EXPECT_TRUE(off());
  EXPECT_NEAR(board.world->time_s() - before, 0.201, 1e-9) << "not one period later";
}

INSTANTIATE_TEST_SUITE_P(Backends, TorqueAtTheEnd, testing::ValuesIn(simulated_board_names()), [](const auto& backend) {
  std::string name = backend.param;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace trocar::torque_at_the_end_test
