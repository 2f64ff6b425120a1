// The self-test of a back-end: a sound board passes, and every fault that can be put in makes the right check fail.
#include "app/device_bench/board_checks.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include <nlohmann/json.hpp>

#include "app/cli/device/device_selftest.h"
#include "app/device_bench/board_run.h"
#include "app/device_bench/simulated_bench.h"
#include "haptics/device/replay_daq.h"

namespace trocar::board_checks_test {
namespace {

using Outcome = BoardCheck::Outcome;

std::set<std::string> names(const std::vector<BoardCheck>& checks, Outcome outcome) {
  std::set<std::string> found;
  for (const BoardCheck& check : checks) {
    if (check.outcome == outcome) found.insert(check.name);
  }
  return found;
}

std::string all_words(const std::vector<BoardCheck>& checks) {
  std::string words;
  for (const BoardCheck& check : checks)
    words += check.name + " " + outcome_name(check.outcome) + ": " + check.detail + "\n";
  return words;
}

std::vector<BoardCheck> with(const InjectedFault& fault) {
  SimulatedDaqConfig config;
  config.faults = {fault};
  SimulatedBench bench(config);
  return check_board(bench);
}

class SoundBoard : public ::testing::TestWithParam<std::pair<int, double>> {};

TEST_P(SoundBoard, PassesEveryCheck) {
  SimulatedDaqConfig config;
  config.seed = static_cast<std::uint64_t>(GetParam().first);
  config.rate_hz = GetParam().second;
  SimulatedBench bench(config);
  const auto checks = check_board(bench);
  EXPECT_EQ(checks.size(), 14u);
  EXPECT_EQ(names(checks, Outcome::kPassed).size(), checks.size()) << all_words(checks);
}

INSTANTIATE_TEST_SUITE_P(SeedsAndRates, SoundBoard,
                         ::testing::Values(std::pair{1, 1000.0}, std::pair{2, 2000.0}, std::pair{3, 4000.0},
                                           std::pair{40, 1000.0}, std::pair{500, 1000.0}));

class SoundDriver : public ::testing::TestWithParam<const char*> {};

TEST_P(SoundDriver, PassesEveryCheck) {
  SimulatedBench bench(SimulatedDaqConfig{}, GetParam());
  const auto checks = check_board(bench);
  EXPECT_EQ(checks.size(), 14u);
  EXPECT_EQ(names(checks, Outcome::kPassed).size(), checks.size()) << all_words(checks);
}

INSTANTIATE_TEST_SUITE_P(Backends, SoundDriver, ::testing::Values(kFakeHostmot2Backend, kEmulatedMc4000Backend),
                         [](const auto& backend) { return backend.index == 0 ? "Hostmot2" : "Mc4000"; });

struct Case {
  const char* check;
  InjectedFault fault;
};

class BrokenBoard : public ::testing::TestWithParam<Case> {};

TEST_P(BrokenBoard, FailsTheCheckThatIsForIt) {
  const auto checks = with(GetParam().fault);
  EXPECT_TRUE(names(checks, Outcome::kFailed).count(GetParam().check)) << all_words(checks);
  EXPECT_TRUE(names(checks, Outcome::kPassed).count("capabilities"));
}

using Kind = InjectedFaultKind;
INSTANTIATE_TEST_SUITE_P(EveryKind, BrokenBoard,
                         ::testing::Values(Case{"counts-follow", {Kind::kEncoderStuck, 0, 0, 2, 0}},
                                           Case{"rest-in-jig", {Kind::kEncoderJump, 0.05, 0, 4, 50}},
                                           Case{"valid-bits", {Kind::kChannelInvalid, 0.1, 0.01, 5, 0}},
                                           Case{"dac-readback", {Kind::kDacStuck, 0, 0, 1, 0}},
                                           Case{"counts-follow", {Kind::kDacStuck, 0, 0, 1, 0}},
                                           Case{"every-sync", {Kind::kMissedSync, 0.1, 0, 0, 3}},
                                           Case{"every-sync", {Kind::kSensorSilence, 0.1, 0.01, 0, 0}},
                                           Case{"delay", {Kind::kDelay, 0, 0, 0, 1}},
                                           Case{"counts-follow", {Kind::kWatchdog, 0, 0, 0, 0}},
                                           Case{"quiet-inputs", {Kind::kDriveFault, 0, 0, 3, 0}},
                                           Case{"quiet-inputs", {Kind::kOverTemperature, 0, 0, 3, 0}},
                                           Case{"emergency-stop", {Kind::kEmergencyStop, 0, 0, 0, 0}},
                                           Case{"enabling-switch", {Kind::kDeadmanOpen, 0, 0, 0, 0}},
                                           Case{"enabling-switch", {Kind::kHandLetsGo, 0, 0, 0, 0}}));

TEST(BrokenBoard, TheChannelIsNamedAndNoOther) {
  const auto checks = with({Kind::kEncoderStuck, 0, 0, 2, 0});
  for (const BoardCheck& check : checks) {
    if (check.name != "counts-follow") continue;
    EXPECT_NE(check.detail.find("joint 3"), std::string::npos) << check.detail;
    EXPECT_EQ(check.detail.find("joint 2"), std::string::npos) << check.detail;
  }
}

/// A board whose one promise is broken on its way through the seam.
class Spoilt : public DataAcquisition {
 public:
  enum class What { kLateByOne, kBackwards, kIgnoresDisarm, kNoName, kNoWatchdog };
  Spoilt(std::unique_ptr<DataAcquisition> board, What what) : board_(std::move(board)), what_(what) {}
  DaqCapabilities capabilities() const noexcept override {
    DaqCapabilities c = board_->capabilities();
    if (what_ == What::kNoName) c.name = "";
    return c;
  }
  DaqSample read() noexcept override {
    if (what_ == What::kNoWatchdog) board_->write(last_);
    return board_->read();
  }
  void write(const DacFrame& frame) noexcept override {
    DacFrame out = frame;
    if (what_ == What::kBackwards)
      for (auto& code : out.codes) code = -code;
    if (what_ == What::kLateByOne)
      std::swap(out, last_);
    else
      last_ = out;
    board_->write(out);
  }
  void arm(bool enabled) noexcept override {
    armed_ = enabled || (armed_ && what_ == What::kIgnoresDisarm);
    board_->arm(armed_);
  }

 private:
  std::unique_ptr<DataAcquisition> board_;
  What what_;
  DacFrame last_;
  bool armed_ = false;
};

class SpoiltBench : public BoardBench {
 public:
  explicit SpoiltBench(Spoilt::What what) : what_(what), sound_(SimulatedDaqConfig{}) {}
  std::unique_ptr<DataAcquisition> open(const BoardActs& acts) override {
    if (acts.stop_pressed_s || acts.counters_at) return nullptr;  // nobody at the bench
    return std::make_unique<Spoilt>(sound_.open(acts), what_);
  }
  bool repeatable() const override { return false; }

 private:
  Spoilt::What what_;
  SimulatedBench sound_;
};

TEST(SpoiltBoard, FailsWhereItsPromiseIsBroken) {
  using What = Spoilt::What;
  const std::pair<What, const char*> cases[] = {{What::kLateByOne, "delay"},
                                                {What::kBackwards, "counts-follow"},
                                                {What::kIgnoresDisarm, "disarm"},
                                                {What::kNoName, "capabilities"},
                                                {What::kNoWatchdog, "watchdog"}};
  for (const auto& [what, check] : cases) {
    SpoiltBench bench(what);
    const auto checks = check_board(bench);
    EXPECT_TRUE(names(checks, Outcome::kFailed).count(check)) << check << "\n" << all_words(checks);
  }
}

TEST(SpoiltBoard, WhatTheBenchCannotDoIsLeftOutByName) {
  SpoiltBench bench(Spoilt::What::kNoName);
  const std::set<std::string> expected{"counter-wrap", "determinism", "emergency-stop"};
  EXPECT_EQ(names(check_board(bench), Outcome::kLeftOut), expected);
}

TEST(SimulatedBench, CountersBeginWhereTheyAreAsked) {
  SimulatedBench bench(SimulatedDaqConfig{});
  const DaqSample sample = bench.open({INT32_MAX - 2, {}, {}, false})->read();
  for (const std::int32_t count : sample.counts) EXPECT_NEAR(static_cast<double>(count), INT32_MAX - 2, 1);
}

TEST(BoardRun, CountsAcrossTheWrap) {
  SimulatedBench bench(SimulatedDaqConfig{});
  BoardRun plain(bench, {}), wrapped(bench, {INT32_MAX - 2, {}, {}, false});
  for (BoardRun* run : {&plain, &wrapped}) {
    run->arm_in_jig();
    run->forget();
    run->command(kPinchChannel, 0.5, 0.050);
  }
  ASSERT_EQ(plain.samples().size(), 50u);
  EXPECT_GT(plain.moved(49, kPinchChannel), 100);
  EXPECT_LT(wrapped.samples().back().counts[kPinchChannel], 0) << "the counter has wrapped";
  EXPECT_NEAR(wrapped.moved(49, kPinchChannel), plain.moved(49, kPinchChannel), 2);
  EXPECT_NEAR(plain.time_s(), 0.110, 1e-9);
}

TEST(BoardRun, ABenchThatCannotDoTheActsIsSaid) {
  SpoiltBench bench(Spoilt::What::kNoName);
  EXPECT_THROW(BoardRun(bench, {{}, 0.1, {}, false}), EnvironmentError);
}

TEST(SelfTestCommand, EndsWithFourWhenACheckFails) {
  std::ostringstream out, err;
  SelfTestOptions options;
  EXPECT_EQ(device_selftest(options, out, err), 0);
  EXPECT_NE(out.str().find("counter-wrap"), std::string::npos);
  EXPECT_EQ(out.str().find("FAIL"), std::string::npos) << out.str();
  options.injections = {"dac-stuck:3@0"};
  options.json = true;
  out.str("");
  EXPECT_EQ(device_selftest(options, out, err), 4);
  const auto json = nlohmann::json::parse(out.str());
  EXPECT_EQ(json.at("passed"), false);
  EXPECT_EQ(json.at("checks").size(), 14u);
  EXPECT_THROW(device_selftest({1, 1000, {"earthquake@1"}, false}, out, err), std::exception);
}

TEST(SelfTestCommand, SameSeedSameBytes) {
  std::ostringstream a, b, err;
  device_selftest({7, 1000, {}, true}, a, err);
  device_selftest({7, 1000, {}, true}, b, err);
  EXPECT_EQ(a.str(), b.str());
}

}  // namespace
}  // namespace trocar::board_checks_test
