// The pinch of thesis 5.2 in both designs, with what is wrong with each, on every back-end: a grasp through the whole
// loop, twice to the bit.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "haptics/device/backends/make_backend.h"
#include "haptics/device/transmission.h"
#include "haptics/haptic_loop.h"

namespace trocar::pinch_hardware_test {
namespace {

struct PinchCase {
  PinchDesign design;
  DeviceModel model;
  PlantParameters plant;
};

PinchCase geared() {
  PinchCase c{PinchDesign::kGeared, {}, draw_parameters(1)};
  Transmission& t = c.model.transmission[kPinchChannel];
  t.ratio = 0.004;
  t.max_motor_torque = 10 * t.ratio;
  c.model.pinch.design = c.design;
  c.plant.channel[kPinchChannel].ratio = 0.004;
  c.plant.channel[kPinchChannel].friction.coulomb = 0.15;
  c.plant.options.pinch.backlash = 1e-4;
  return c;
}

PinchCase potentiometer() {
  PinchCase c{PinchDesign::kPotentiometer, {}, draw_parameters(1)};
  Transmission& t = c.model.transmission[kPinchChannel];
  t.counts_per_turn = 2 * std::numbers::pi * t.ratio * 4096 / 0.030;
  t.max_motor_torque = 8 * t.ratio;
  c.model.pinch = {.design = c.design, .noise_counts = 5};
  c.plant.options.pinch = {
      .counts_per_m = 4096 / 0.030, .noise_counts = 0.7, .dead_every = 0.007, .dead_wide = 5e-5, .driver_lag = 0.003};
  return c;
}

/// Homed, armed, then the fingers close on a block and open again.
struct Grasp {
  std::vector<DaqSample> in;
  std::vector<DacFrame> out;
  double worst_m = 0;     ///< of the opening that the loop believes
  double held_n = 0;      ///< that the fingers feel while they hold, mean
  double asked_n = 0;     ///< of the block, at the opening as the loop sees it, mean
  double unrest_m_s = 0;  ///< of the jaws while they are held
  double most_n = 0;      ///< asked of the motor
  LoopState state = LoopState::kOff;
};

Grasp grasp(const std::string& backend, const PinchCase& c, double stiffness = 300, double close_to = 0.009) {
  BackendOptions options;
  options.simulated.seed = 1;
  options.simulated.plant = c.plant;
  options.simulated.hand.tremor_m = 0;
  const Backend board = make_backend(backend, options);
  HapticLoopConfig config;
  config.daq = board.daq->capabilities();
  config.device = c.model;
  HapticLoop loop(config);
  const auto patch = std::make_unique<ContactPatch>();
  TickRecord record;
  Grasp g;
  const HandSense home = board.world->sense();
  double fingers = home.jaw_opening_m, before = fingers;
  int held = 0;
  for (int k = 0; k < 5000; ++k) {
    const double t = k * 1e-3, way = std::clamp((t - 2.2) / 0.8, 0.0, 1.0) - std::clamp((t - 4.2) / 0.6, 0.0, 1.0);
    fingers = home.jaw_opening_m + way * (close_to - home.jaw_opening_m);
    if (t > 0.75) board.world->set_hand_intent(home.X_BS, fingers);
    if (t > 2) patch->grip = {0.012, stiffness};
    const DaqSample in = board.daq->read();
    const DacFrame out = loop.tick(in, *patch, record);
    board.daq->arm(record.amplifiers_armed);
    board.daq->write(out);
    g.in.push_back(in), g.out.push_back(out);
    const HandSense now = board.world->sense();
    if (record.stylus.loop == LoopState::kActive)
      g.worst_m = std::max(g.worst_m, std::abs(record.q[kPinchChannel] - now.jaw_opening_m));
    g.most_n = std::max(g.most_n, std::abs(record.torque[kPinchChannel]));
    if (t > 3.6 && t < 4.2) {
      g.held_n += now.force_on_finger_n, g.asked_n += record.stylus.grip_force_n, ++held;
      g.unrest_m_s = std::max(g.unrest_m_s, std::abs(now.jaw_opening_m - before) * 1e3);
    }
    before = now.jaw_opening_m;
  }
  g.held_n /= held, g.asked_n /= held;
  g.state = record.stylus.loop;
  return g;
}

class Designs : public ::testing::TestWithParam<std::tuple<const char*, bool>> {};

TEST_P(Designs, GraspTheSameTwiceToTheBitAndFeelTheBlock) {
  const auto& [backend, with_gears] = GetParam();
  const PinchCase c = with_gears ? geared() : potentiometer();
  const Grasp first = grasp(backend, c), again = grasp(backend, c);
  std::printf("opening off by %.3f mm, %.2f N at the fingers for %.2f N of the block, unrest %.2f mm/s\n",
              1e3 * first.worst_m, first.held_n, first.asked_n, 1e3 * first.unrest_m_s);
  EXPECT_EQ(first.state, LoopState::kActive);
  ASSERT_EQ(first.in.size(), again.in.size());
  for (std::size_t k = 0; k < first.in.size(); ++k) {
    ASSERT_EQ(first.in[k].counts, again.in[k].counts) << k;
    ASSERT_EQ(first.in[k].digital_in, again.in[k].digital_in) << k;
    ASSERT_EQ(first.out[k].codes, again.out[k].codes) << k;
  }
  // Jig 0.1 mm, half the play of the gears, or tremble and worn places of the potentiometer.
  EXPECT_LT(first.worst_m, 0.25e-3);
  EXPECT_GT(first.asked_n, 0.3);
  EXPECT_NEAR(first.held_n, first.asked_n, 0.35 * first.asked_n + 0.2) << "friction of the slide hides what it can";
  EXPECT_LT(first.unrest_m_s, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Pinch, Designs,
                         ::testing::Combine(::testing::Values(kSimulatedBackend, kFakeHostmot2Backend,
                                                              kEmulatedMc4000Backend),
                                            ::testing::Bool()),
                         [](const auto& c) {
                           const std::string name = std::get<0>(c.param);
                           return (name == kSimulatedBackend      ? std::string("Simulated")
                                   : name == kFakeHostmot2Backend ? "Hostmot2"
                                                                  : "Mc4000") +
                                  (std::get<1>(c.param) ? "Geared" : "Potentiometer");
                         });

TEST(Pinch, AsksNoMoreThanItsDesignGives) {
  for (PinchCase c : {geared(), potentiometer()}) {
    c.model.transmission[kPinchChannel].max_motor_torque = 1.5 * c.model.transmission[kPinchChannel].ratio;
    const Grasp g = grasp(kSimulatedBackend, c, 550, 0.002);
    EXPECT_LE(g.most_n, 1.5 + 1e-9);
    EXPECT_GT(g.asked_n, 2) << "the block asked for more";
    EXPECT_EQ(g.state, LoopState::kActive) << "saturated, not at fault";
  }
}

TEST(PlantGear, PlayHidesTheSlideFromTheMotorAndCarriesItBeyond) {
  PlantParameters p = nominal_parameters();
  p.options.pinch.backlash = 2e-4;
  PlantGear gear(p);
  gear.place(0.010);
  EXPECT_EQ(gear.advance(0, 0.01005, 0, 0.02, 1e-4), 0) << "within the play";
  EXPECT_EQ(gear.at(), 0.010);
  // The slide pushes against the flank: the motor's side goes along, momentum is shared.
  const double mass = p.channel[kPinchChannel].rotor_inertia / (0.008 * 0.008), before = 0.02 * 1.0;
  const double after = gear.advance(0, 0.0101, 1.0, 0.02, 1e-6);
  EXPECT_NEAR(0.02 * after + mass * gear.rate(), before, 1e-3 * before);
  EXPECT_GT(gear.rate(), 0.5);
}

TEST(PlantPotentiometer, StandsStillWhereItIsWornAndTremblesElsewhere) {
  PlantPotentiometer pot({.counts_per_m = 1e5, .dead_every = 0.01, .dead_wide = 1e-4}, 1);
  EXPECT_EQ(pot.read(0.0095), 950);
  EXPECT_EQ(pot.read(0.01003), 950) << "worn at 10 mm: the reading stays";
  EXPECT_EQ(pot.read(0.01006), 1006);
  PlantPotentiometer trembling({.counts_per_m = 1e5, .noise_counts = 1}, 1);
  double sum = 0, squares = 0;
  for (int k = 0; k < 4000; ++k) {
    const double off = trembling.read(0.005) - 500;
    sum += off, squares += off * off;
  }
  EXPECT_NEAR(sum / 4000, 0, 0.06);
  EXPECT_NEAR(std::sqrt(squares / 4000), 1.04, 0.06) << "with the rounding";
}

}  // namespace
}  // namespace trocar::pinch_hardware_test
