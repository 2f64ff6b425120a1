// `trocar device home`: on a simulated device, on a card by the clock, and what is refused before anything moves.
#include "app/cli/device/device_home.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "haptics/device/hostmot2/fake_hostmot2.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::device_home_test {
namespace {

using test::message_of;

bool said(const HomeOutcome& outcome, const std::string& words) {
  return std::any_of(outcome.steps.begin(), outcome.steps.end(),
                     [&](const std::string& step) { return step.find(words) != std::string::npos; });
}

TEST(DeviceHome, HomesAgainAndAgainAndSaysEachStepOfEach) {
  HomeOptions options;
  options.method = "edges";
  options.repeat = 2;
  std::ostringstream out;
  const std::vector<HomeOutcome> all = home_device(options, out);
  ASSERT_EQ(all.size(), 2u);
  for (const HomeOutcome& outcome : all) {
    EXPECT_TRUE(outcome.homed);
    EXPECT_TRUE(outcome.torque_free);
    EXPECT_TRUE(said(outcome, "Self-test"));
    EXPECT_TRUE(said(outcome, "Turn the stylus in its jig"));
    EXPECT_TRUE(said(outcome, "Leave the stylus in its jig"));
    EXPECT_LT(outcome.error.cwiseAbs().maxCoeff(), 5) << outcome.error.transpose();
  }
}

TEST(DeviceHome, LearnsTheMarksInTheJig) {
  const test::TemporaryFolder folder;
  HomeOptions options;
  options.method = "index";
  options.learn = folder / "marks.toml";
  std::ostringstream out;
  const std::vector<HomeOutcome> learnt = home_device(options, out);
  ASSERT_EQ(learnt.size(), 1u);
  EXPECT_TRUE(learnt.front().homed) << "by the light's edges, after the marks";
  options.device = options.learn;
  options.learn.clear();
  const std::vector<HomeOutcome> homed = home_device(options, out);
  EXPECT_TRUE(homed.front().homed);
  EXPECT_LT(homed.front().error.cwiseAbs().maxCoeff(), 10) << homed.front().error.transpose();
}

TEST(DeviceHome, AnInterruptKeepsWhatWasDone) {
  HomeOptions options;
  options.repeat = 3;
  options.interrupted = [] { return true; };
  std::ostringstream out;
  const std::vector<HomeOutcome> all = home_device(options, out);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_FALSE(all.front().homed);
}

/// The driver of a card that is there, by the clock; nobody turns the stylus, whose receiver sees light all the while.
TEST(DeviceHome, OnARealCardALampThatIsStuckHomesNothing) {
  SimulatedDaq device(FakeHostmot2::device_config({}));
  FakeHostmot2 card(device, {}, hostmot2::standard_wiring());
  HomeOptions options;
  options.backend = kHostmot2Backend;
  options.card = card.address();
  options.limit_s = 2;
  std::ostringstream out;
  const std::vector<HomeOutcome> all = home_device(options, out);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_FALSE(all.front().homed) << "method and dark as for every real device";
  EXPECT_EQ(all.front().fault, "");
  EXPECT_TRUE(all.front().torque_free);
  EXPECT_TRUE(said(all.front(), "Turn the stylus in its jig")) << out.str();
  EXPECT_NEAR(all.front().seconds, 2, 0.01);
  EXPECT_FALSE(card.amplifiers_enabled());
}

TEST(DeviceHome, BoardsWithoutAnIndexAreRefusedAtOnce) {
  HomeOptions options;
  options.method = "index";
  options.backend = kEmulatedMc4000Backend;
  std::ostringstream out;
  EXPECT_CONTAINS(message_of<InputError>([&] { home_device(options, out); }), "tell of no index pulse");
  EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace trocar::device_home_test
