// `trocar device monitor`: lines at ten a second, values that live, and an end.
#include "app/cli/device/device_monitor.h"

#include <gtest/gtest.h>

#include <chrono>
#include <sstream>
#include <vector>

#include <nlohmann/json.hpp>

#include "haptics/device/backends/make_backend.h"
#include "haptics/device/hostmot2/fake_hostmot2.h"
#include "haptics/input_error.h"

namespace trocar::device_monitor_test {
namespace {

using nlohmann::json;

MonitorOptions fast(double seconds) {
  MonitorOptions options;
  options.seconds = seconds;
  options.lockstep = true;
  return options;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<json> watch(MonitorOptions options, int& code) {
  options.json = true;
  std::ostringstream out, err;
  code = monitor(options, out, err);
  std::vector<json> values;
  for (const std::string& line : lines_of(out.str())) values.push_back(json::parse(line));
  return values;
}

TEST(Monitor, ShowsTheDeviceComeToLife) {
  int code = -1;
  const auto v = watch(fast(4), code);
  EXPECT_EQ(code, 0);
  ASSERT_EQ(v.size(), 40u);
  EXPECT_NEAR(v[9].at("t_s").get<double>(), 1.0, 1e-9);
  EXPECT_EQ(v[0].at("armed"), false);
  EXPECT_EQ(v.back().at("state"), "active");
  EXPECT_TRUE(v.back().at("fault").is_null());
  for (const char* seven : {"counts"}) EXPECT_EQ(v.back().at(seven).size(), 7u);
  EXPECT_EQ(v.back().at("q_rad").size(), 6u);
  EXPECT_GT(v.back().at("winding_c").get<double>(), v[0].at("winding_c").get<double>())
      << "carrying the arm warms the motors";
  double torque = 0;
  for (const json& t : v.back().at("torque_n_m")) torque += std::abs(t.get<double>());
  EXPECT_GT(torque, 0.05) << "the weight is carried";
}

TEST(Monitor, TheHandGoesRoundItsCircle) {
  int code = -1;
  const auto v = watch(fast(7), code);
  double low = 1, high = -1;
  for (std::size_t k = 30; k < v.size(); ++k) {
    const double y = v[k].at("stylus_m").at(1).get<double>();
    low = std::min(low, y);
    high = std::max(high, y);
  }
  EXPECT_NEAR(high - low, 0.030, 0.006);
}

TEST(Monitor, AFaultIsShownAndEndsWithFour) {
  MonitorOptions options = fast(3);
  options.injections = {"encoder-jump:2@2.0"};
  int code = -1;
  const auto v = watch(options, code);
  EXPECT_EQ(code, 4);
  EXPECT_EQ(v.back().at("fault"), "encoder-jump");
  EXPECT_EQ(v.back().at("fault_channel"), 2);
  EXPECT_EQ(v.back().at("state"), "fault");
  EXPECT_EQ(v.back().at("armed"), false);
  options.json = false;
  std::ostringstream out, err;
  EXPECT_EQ(monitor(options, out, err), 4);
  EXPECT_NE(lines_of(out.str()).back().find("fault encoder-jump on channel 2"), std::string::npos) << out.str();
}

TEST(Monitor, WithoutATerminalThereAreLinesAndNoEscapes) {
  std::ostringstream out, err;
  EXPECT_EQ(monitor(fast(1), out, err), 0);
  EXPECT_EQ(lines_of(out.str()).size(), 10u);
  EXPECT_EQ(out.str().find('\033'), std::string::npos);
}

TEST(Monitor, OnATerminalTheBlockIsDrawnOverItself) {
  MonitorOptions options = fast(1);
  options.terminal = true;
  std::ostringstream out, err;
  EXPECT_EQ(monitor(options, out, err), 0);
  const auto lines = lines_of(out.str());
  EXPECT_EQ(lines.size() % 10, 0u);
  const std::string up = "\033[" + std::to_string(lines.size() / 10) + "A";
  std::size_t ups = 0;
  for (std::size_t at = out.str().find(up); at != std::string::npos; at = out.str().find(up, at + 1)) ++ups;
  EXPECT_EQ(ups, 9u) << "nine times over the first: as many lines up as a block has";
}

TEST(Monitor, SameSeedSameBytesAndAnInterruptEndsIt) {
  std::ostringstream a, b, c, err;
  monitor(fast(1), a, err);
  monitor(fast(1), b, err);
  EXPECT_EQ(a.str(), b.str());
  MonitorOptions options = fast(100);
  int asked = 0;
  options.interrupted = [&] { return ++asked > 3; };
  EXPECT_EQ(monitor(options, c, err), 0);
  EXPECT_EQ(lines_of(c.str()).size(), 3u);
}

TEST(Monitor, KeepsTimeByTheClockUnlessInLockstep) {
  MonitorOptions options = fast(0.5);
  options.lockstep = false;
  std::ostringstream out, err;
  const auto begin = std::chrono::steady_clock::now();
  monitor(options, out, err);
  EXPECT_GE(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 0.49);
}

TEST(Monitor, EveryBackEndThatIsSimulatedComesToLife) {
  for (const std::string& backend : backend_names()) {
    if (!backend_abilities(backend).pace) continue;
    MonitorOptions options = fast(2);
    options.backend = backend;
    int code = -1;
    const auto v = watch(options, code);
    EXPECT_EQ(code, 0) << backend;
    ASSERT_EQ(v.size(), 20u) << backend;
    EXPECT_TRUE(v.back().at("fault").is_null()) << backend << v.back();
    EXPECT_TRUE(!backend_capabilities(backend, 1000).motors || v.back().at("state") == "active") << backend;
  }
}

/// The driver of a card that is there: by its own clock, amplifiers off, though the plant's hand holds the switch.
TEST(Monitor, ARealCardIsLookedAtWithItsAmplifiersOff) {
  SimulatedDaq device(FakeHostmot2::device_config({}));
  FakeHostmot2 card(device, {}, hostmot2::standard_wiring());
  card.set_hand_intent(card.sense().X_BS, 0.020);
  card.press_deadman(true);
  MonitorOptions options = fast(0.5);
  options.lockstep = false;
  options.backend = kHostmot2Backend;
  options.card = card.address();
  int code = -1;
  const auto v = watch(options, code);
  ASSERT_EQ(v.size(), 5u);
  for (const json& line : v) EXPECT_EQ(line.at("armed"), false) << line;
  EXPECT_FALSE(card.amplifiers_enabled());
  EXPECT_TRUE(v.back().at("digital_in").get<std::uint32_t>() & kDeadman) << "shown as it is, and not heard";
}

TEST(Monitor, ARealDeviceTakesNoLockstepAndNoFaults) {
  std::ostringstream out, err;
  MonitorOptions options = fast(1);
  options.backend = kHostmot2Backend;
  EXPECT_THROW(monitor(options, out, err), InputError) << "it has a clock of its own";
  options.lockstep = false;
  options.injections = {"encoder-jump@1"};
  EXPECT_THROW(monitor(options, out, err), InputError);
  options.injections.clear();
  options.card = "127.0.0.1:9";
  EXPECT_THROW(monitor(options, out, err), EnvironmentError) << "nobody answers";
  options.backend = "mc5000";
  EXPECT_THROW(monitor(options, out, err), InputError);
  EXPECT_EQ(out.str(), "");
}

TEST(Monitor, BadFilesAndFaultsAreRefused) {
  std::ostringstream out, err;
  MonitorOptions options = fast(1);
  options.device = "/nowhere/device.toml";
  EXPECT_THROW(monitor(options, out, err), InputError);
  options.device.clear();
  options.injections = {"earthquake@1"};
  EXPECT_THROW(monitor(options, out, err), InputError);
}

}  // namespace
}  // namespace trocar::device_monitor_test
