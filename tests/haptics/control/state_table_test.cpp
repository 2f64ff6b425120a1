// Every state against every event: the one table of what the loop's states do, and a random walk that keeps to it.
#include <algorithm>
#include <functional>
#include <set>
#include <string>

#include "tests/haptics/control/supervisor_fixture.h"

namespace trocar::state_table_test {
namespace {

using test::kMaxCounts;
using test::kPeriod;
using test::Random;
using test::SupervisorTest;
using Delta = SupervisorTest::Delta;

constexpr LoopState kStates[] = {LoopState::kOff,   LoopState::kSelfTest, LoopState::kUnhomed, LoopState::kHomed,
                                 LoopState::kArmed, LoopState::kActive,   LoopState::kFault};

class StateTable : public SupervisorTest {
 protected:
  void bring(LoopState state) {
    supervisor = Supervisor(SafetyLimits{}, kMaxCounts, kPeriod);
    if (state == LoopState::kSelfTest) step(0);
    if (state == LoopState::kUnhomed) pass_self_test();
    if (state == LoopState::kHomed || state == LoopState::kArmed) home(), step(0);
    if (state == LoopState::kArmed) step(kDeadman);
    if (state == LoopState::kActive || state == LoopState::kFault) activate(), steps(500, kDeadman);
    if (state == LoopState::kFault) supervisor.raise(FaultCode::kNonFinite, tick, -1, 0);
    ASSERT_EQ(supervisor.state(), state);
  }
  void invalid_channel(std::uint32_t digital) {
    DaqSample sample;
    sample.digital_in = digital;
    sample.valid = 0x3F;
    supervisor.observe(tick++, sample, {});
  }
};

TEST_F(StateTable, IsAsTheDesignHasIt) {
  // A letter a state: O off, T self-test, U unhomed, H homed, R armed, A active, F fault; after one tick but where a
  // time is named. The columns are the states in which the event comes, in that order.
  const auto letter = [](LoopState s) { return "OTUHRAF"[std::ranges::find(kStates, s) - kStates]; };
  const Delta jump{0, 0, 0, 31, 0, 0, 0};
  struct Event {
    const char* name;
    std::function<void()> happens;
    const char* next;
  };
  const Event events[] = {
      {"nothing", [&] { step(0); }, "TTUHHHF"},
      {"the deadman is held", [&] { step(kDeadman); }, "TTURRAF"},
      {"the beam is there", [&] { step(kHomeBeam); }, "TTUHHHF"},
      {"both", [&] { step(kHomeBeam | kDeadman); }, "TTURRAF"},
      {"0.2 s of nothing", [&] { steps(200, 0); }, "UUUHHHF"},
      {"0.55 s of the beam", [&] { steps(550, kHomeBeam); }, "UUHHHHF"},
      {"0.8 s of the beam", [&] { steps(800, kHomeBeam); }, "HHHHHHF"},
      {"30 ms of the deadman", [&] { steps(30, kDeadman); }, "TTUAAAF"},
      {"11 s of a deadman never opened", [&] { steps(11000, kDeadman); }, "FUUAAAF"},
      {"an encoder counts",
       [&] {
         step(kDeadman, {0, 0, 0, 1, 0, 0, 0});
       },
       "TTURRAF"},
      {"emergency stop", [&] { step(kDeadman | kEmergencyStop); }, "FFFFFFF"},
      {"watchdog", [&] { step(kDeadman | kWatchdogFired); }, "FFFFFFF"},
      {"drive fault", [&] { step(kDeadman | kDriveFault << 2); }, "FFFFFFF"},
      {"drive hot", [&] { step(kDeadman | kDriveHot << 2); }, "FFFFFFF"},
      {"DAC mismatch", [&] { step(kDeadman | kDacMismatch << 2); }, "FFFFFFF"},
      {"hand without a number", [&] { step(kDeadman | kHandFault); }, "FFFFFFF"},
      {"a channel is not valid", [&] { invalid_channel(kDeadman); }, "FFFFFFF"},
      {"an encoder jumps", [&] { step(kDeadman, jump); }, "FFFFFFF"},
      {"no news", [&] { step(kDeadman, {}, 0); }, "FFFFFFF"},
      {"a gap of 25 periods", [&] { step(kDeadman, {}, 26); }, "FFFFFFF"},
      {"a hard fault is raised", [&] { supervisor.raise(FaultCode::kNonFinite, tick, -1, 0); }, "FFFFFFF"},
      {"a soft fault is raised", [&] { supervisor.raise(FaultCode::kStalePatch, tick, -1, 1); }, "FFFFFFF"},
      {"the operator resets", [&] { supervisor.reset_fault(); }, "OTUHRAT"}};
  for (const Event& event : events) {
    std::string next;
    for (const LoopState state : kStates) {
      bring(state);
      event.happens();
      next += letter(supervisor.state());
      const bool may = supervisor.state() == LoopState::kArmed || supervisor.state() == LoopState::kActive ||
                       (supervisor.state() == LoopState::kFault && is_soft(supervisor.fault().code));
      EXPECT_TRUE(may || !supervisor.armed()) << event.name << " in " << loop_state_name(state);
      EXPECT_TRUE(supervisor.armed() || supervisor.ramp() == 0) << event.name << " in " << loop_state_name(state);
    }
    EXPECT_EQ(next, event.next) << event.name;
  }
}

TEST_F(StateTable, ARandomWalkNeverLeavesIt) {
  using L = LoopState;
  const std::set<std::pair<L, L>> ways{{L::kOff, L::kSelfTest},  {L::kSelfTest, L::kUnhomed}, {L::kUnhomed, L::kHomed},
                                       {L::kHomed, L::kArmed},   {L::kArmed, L::kActive},     {L::kArmed, L::kHomed},
                                       {L::kActive, L::kHomed},  {L::kOff, L::kFault},        {L::kSelfTest, L::kFault},
                                       {L::kUnhomed, L::kFault}, {L::kHomed, L::kFault},      {L::kArmed, L::kFault},
                                       {L::kActive, L::kFault}};
  Random random(11);
  supervisor = Supervisor(SafetyLimits{}, kMaxCounts, kPeriod);
  std::set<std::pair<L, L>> walked;
  std::uint32_t held = 0;
  double ramp = 0;
  for (int k = 0; k < 400000; ++k) {
    if (random.below(200) == 0) held = random.below(4) ? kHomeBeam | (random.below(2) ? kDeadman : 0u) : 0u + kDeadman;
    std::uint32_t digital = held;
    if (random.below(4000) == 0) digital |= 1u << random.below(32);
    const std::uint32_t elapsed = random.below(9000) ? 1 : static_cast<std::uint32_t>(random.below(40));
    const L before = supervisor.state();
    step(digital, {random.below(20000) ? 0 : random.below(64) - 32, 0, 0, 0, 0, 0, 0}, elapsed);
    const L now = supervisor.state();
    if (now != before) {
      EXPECT_TRUE(ways.contains({before, now})) << loop_state_name(before) << " to " << loop_state_name(now);
      walked.insert({before, now});
    }
    EXPECT_LE(supervisor.ramp() - ramp, kPeriod / SafetyLimits{}.ramp_s * (1 + 1e-9)) << "never faster than the start";
    if (now == L::kFault && !is_soft(supervisor.fault().code)) {
      ASSERT_FALSE(supervisor.armed());
    }
    ramp = supervisor.ramp();
    if (now == L::kFault && random.below(50) == 0) supervisor.reset_fault();
    if (supervisor.state() == L::kSelfTest) ramp = 0;
  }
  EXPECT_GE(walked.size(), ways.size() - 2) << "every way was gone but those out of OFF and ARMED into a fault";
}

}  // namespace
}  // namespace trocar::state_table_test
