// An hour at work with everything going wrong now and then, on every back-end: simulated time, as fast as it goes. A
// minute of it in every run. After each trouble the operator resets, homes and closes the switch; the arm must work
// again.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "haptics/device/backends/simulated_board.h"
#include "haptics/haptic_loop.h"
#include "tests/haptics/haptics_fixtures.h"
#include "tests/support/repeats.h"

namespace trocar::hour_test {
namespace {

using test::Random;

constexpr double kBetween_s = 8, kAnswer_s = 0.003;

/// A trouble every few seconds, each of some length; which of the device's kinds it is, is drawn.
std::vector<InjectedFault> faults_of(double seconds, Random& random) {
  using K = InjectedFaultKind;
  constexpr K kKinds[] = {K::kEncoderJump,     K::kEncoderStuck,  K::kChannelInvalid, K::kDacStuck,   K::kMissedSync,
                          K::kHandNaN,         K::kEmergencyStop, K::kDeadmanOpen,    K::kDriveFault, K::kWatchdog,
                          K::kOverTemperature, K::kSensorSilence, K::kDelay};
  std::vector<InjectedFault> out;
  for (double at = 6; at < seconds; at += kBetween_s + random.between(0, 4)) {
    InjectedFault f{kKinds[random.below(std::size(kKinds))], at, random.between(0.005, 0.3), random.below(kChannels),
                    0};
    f.value = f.kind == K::kEncoderJump ? 60 + random.below(2000) : 1 + random.below(30);
    out.push_back(f);
  }
  return out;
}

class Hour : public testing::TestWithParam<std::string> {
 protected:
  /// Troubles of the board itself, from a tick on.
  void board_trouble(Random& random) {
    if (board.card) {
      const CardTroubles kinds[] = {{.loses_questions = 0.3},
                                    {.loses_answers = 0.5},
                                    {.repeats = 0.7},
                                    {.swaps = 0.4},
                                    {.cuts = 0.3},
                                    {.babbles = 0.9},
                                    {.silent = true},
                                    {.frozen = true},
                                    {.lies = true},
                                    {.no_kicks = true},
                                    {.quadrature_errors = 1 << random.below(kChannels)}};
      CardTroubles drawn = kinds[random.below(std::size(kinds))];
      drawn.seed = static_cast<std::uint64_t>(random.below(1000));
      silent = drawn.silent;
      board.card->trouble(drawn);
      if (random.below(8) == 0) board.card->power_cycle();
    }
    if (board.boards) {
      const BoardTroubles kinds[] = {{.sync_cable_out = true},
                                     {.gone = {true, false}},
                                     {.gone = {false, true}},
                                     {.gone = {true, true}},
                                     {.quadrature_errors = 1 << random.below(kChannels)}};
      const BoardTroubles drawn = kinds[random.below(std::size(kinds))];
      silent = drawn.gone[0];
      board.boards->trouble(drawn);
    }
  }
  void board_sound() {
    if (board.card) board.card->trouble({});
    if (board.boards) board.boards->trouble({});
    silent = false;
  }
  double load() const {
    const auto held = board.hold();
    return board.device->plant().motor_loads().cwiseAbs().maxCoeff();
  }
  /// What a person does: after a fault, the arm back into its jig, a reset, the switch let go; then homing and hand on.
  void operate(int tick) {
    const LoopState state = record.stylus.loop;
    in_state = state == last ? in_state + 1 : 0;
    last = state;
    if (state == LoopState::kActive || state == LoopState::kArmed || (state == LoopState::kHomed && in_state > 100)) {
      if (state == LoopState::kHomed || !holding) board.world->press_deadman(true), rest = board.world->sense().X_BS;
      holding = true;
      const double phase = 2e-3 * tick;
      const Pose goal{rest.R, rest.p + 0.01 * Vec3(std::sin(phase), std::cos(phase) - 1, std::sin(3 * phase))};
      board.world->set_hand_intent(goal, 0.02);
    } else if ((state == LoopState::kFault || state == LoopState::kUnhomed) && in_state % 2500 == 300) {
      board.world->press_deadman(false);
      holding = false;
      {
        const auto held = board.hold();
        board.device->release_hand();
        board.device->return_to_jig();
      }
      loop->reset_fault();
    }
  }

  SimulatedBoard board;
  std::unique_ptr<HapticLoop> loop;
  TickRecord record;
  Pose rest;
  LoopState last = LoopState::kOff;
  int in_state = 0;
  bool holding = false, silent = false;
};

TEST_P(Hour, EveryTroubleTakesTheTorqueAndTheArmWorksAgainAfterIt) {
  const double seconds = test::repeats("DEVICE_HOUR_S", 60);
  Random random(25);
  SimulatedDaqConfig device;
  device.hand.tremor_m = 0;
  device.faults = faults_of(seconds, random);
  board = open_simulated_board(GetParam(), device, kAnswer_s);
  HapticLoopConfig config;
  config.daq = board.daq->capabilities();
  config.safety.max_patch_age_s = 0.2;
  loop = std::make_unique<HapticLoop>(config);
  const auto patch = std::make_unique<ContactPatch>();
  int activations = 0, hard_ticks = 0, trouble_ends = -3, faults = 0;
  LoopState before = LoopState::kOff;
  std::array<std::int32_t, kChannels> counts{};
  const int ticks = static_cast<int>(seconds * 1000);
  for (int k = 0; k < ticks + 12000; ++k) {
    operate(k);
    if (k < ticks && record.stylus.loop == LoopState::kActive && random.below(12000) == 0) {
      board_trouble(random);
      trouble_ends = k + 1 + random.below(300);
    }
    if (k == trouble_ends) board_sound();
    const bool reached = !silent && k >= trouble_ends + 3;  // a board that is back has heard what it is told
    if (k % 10 == 0) ++patch->stamp;
    if (silent) board.world->miss_sync();  // its own time goes on
    const DaqSample sample = board.daq->read();
    const DacFrame out = loop->tick(sample, *patch, record);
    board.daq->arm(record.amplifiers_armed);
    board.daq->write(out);
    const LoopState now = record.stylus.loop;
    // Whatever a read gives, its age is bounded: no news, no torque.
    if (sample.elapsed_periods == 0) {
      ASSERT_FALSE(record.amplifiers_armed) << "tick " << k;
      if (k > 0) {
        ASSERT_EQ(sample.counts, counts) << "tick " << k;
      }
    }
    counts = sample.counts;
    ASSERT_TRUE(record.torque.allFinite()) << k;
    for (const std::int32_t code : out.codes) {
      ASSERT_TRUE(code == 0 || now == LoopState::kActive || now == LoopState::kFault) << k;
    }
    hard_ticks = record.amplifiers_armed ? 0 : hard_ticks + 1;
    if (hard_ticks >= (reached ? 2 : 20)) {
      // Amplifiers of a board that nobody reaches stay on behind converters at zero: their offsets are left.
      ASSERT_LE(load(), reached ? 0 : 0.02) << "tick " << k << ", " << fault_name(record.stylus.fault.code) << " for "
                                            << hard_ticks << ", trouble until " << trouble_ends;
    }
    activations += now == LoopState::kActive && before != LoopState::kActive;
    faults += now == LoopState::kFault && before != LoopState::kFault;
    before = now;
  }
  EXPECT_EQ(record.stylus.loop, LoopState::kActive) << fault_name(record.stylus.fault.code);
  EXPECT_GT(activations, seconds / 30) << "the arm came back each time";
  EXPECT_GT(faults, seconds / 40) << "and had reason to go";
  RecordProperty("activations", activations);
  RecordProperty("faults", faults);
  std::printf("%s: %.0f s, %d faults, %d times at work\n", GetParam().c_str(), seconds, faults, activations);
}

INSTANTIATE_TEST_SUITE_P(Backends, Hour, testing::ValuesIn(simulated_board_names()), [](const auto& backend) {
  std::string name = backend.param;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace trocar::hour_test
