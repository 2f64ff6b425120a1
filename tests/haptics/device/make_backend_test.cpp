#include "haptics/device/backends/make_backend.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"

namespace trocar::make_backend_test {
namespace {

TEST(MakeBackend, TheSimulatedOneHasAWorldASensorAndNoClockOfItsOwn) {
  BackendOptions options;
  options.simulated.rate_hz = 2000;
  options.sensor.rate_hz = 50;
  options.sensor.lag_s = 0.1;
  const Backend backend = make_backend("simulated", options);
  EXPECT_STREQ(backend.daq->capabilities().name, "simulated");
  EXPECT_EQ(backend.daq->capabilities().rate_hz, 2000);
  EXPECT_EQ(backend.sensor->config().rate_hz, 50);
  EXPECT_EQ(backend.sensor->delay(), 5u);
  EXPECT_TRUE(backend.can.pause && backend.can.pace);
  ASSERT_NE(backend.world, nullptr);
  backend.daq->read();
  EXPECT_DOUBLE_EQ(backend.world->time_s(), 1.0 / 2000) << "the world is the one behind the seam";
}

TEST(MakeBackend, EveryNameIsMadeAsItsCapabilitiesSay) {
  for (const std::string& name : backend_names()) {
    if (name == kHostmot2Backend || name == kMc4000Backend) continue;  // need a card, boards
    const DaqCapabilities said = backend_capabilities(name, 1000), made = make_backend(name, {}).daq->capabilities();
    EXPECT_EQ(name, made.name);
    EXPECT_STREQ(said.name, made.name);
    EXPECT_EQ(said.rate_hz, made.rate_hz);
    EXPECT_EQ(said.dac_bits, made.dac_bits);
  }
}

TEST(MakeBackend, AnUnknownNameIsRefusedWithThoseThatThereAre) {
  try {
    make_backend("mc5000", {});
    FAIL() << "made";
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "--backend mc5000: unknown; known are simulated, pointer, hostmot2, hostmot2-fake, mc4000, mc4000-emulated");
  }
}

TEST(MakeBackend, ARecordingIsOneWithoutWorldAndSensor) {
  DaqSample sample;
  sample.counts[3] = 77;
  const Backend backend = replay_backend({sample}, {"simulated", 1000, 16});
  EXPECT_STREQ(backend.daq->capabilities().name, "replay");
  EXPECT_EQ(backend.daq->read().counts[3], 77);
  EXPECT_EQ(backend.world, nullptr);
  EXPECT_EQ(backend.sensor, nullptr);
}

}  // namespace
}  // namespace trocar::make_backend_test
