// A real device's motors stay as warm as they were left, whichever program comes next.
#include "app/window/attempt/motor_memory.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include <nlohmann/json.hpp>

#include "haptics/device/backends/make_backend.h"
#include "haptics/device/hostmot2/fake_hostmot2.h"
#include "haptics/input_error.h"
#include "tests/app/window/attempt/runner_samples.h"

namespace trocar::motor_memory_test {
namespace {

MotorStates with_motor(std::size_t which, const MotorTemperatures& warm) {
  MotorStates motors;
  motors[which] = warm;
  return motors;
}

class MotorMemoryTest : public testing::Test {
 protected:
  /// As if it had been kept so much earlier by both clocks, or by the calendar alone before a restart.
  void age(double seconds, bool restarted = false) const {
    nlohmann::json json = nlohmann::json::parse(std::ifstream(memory_.file()));
    for (const char* clock : {"since_boot_s", "calendar_s"}) json[clock] = json.at(clock).get<double>() - seconds;
    if (restarted) json["boot"] = "another", json["since_boot_s"] = 1e6;
    std::ofstream(memory_.file()) << json;
  }

  RunnerFolder folder_;
  MotorMemory memory_{folder_.path() / "motors", "hostmot2", "10.0.0.9:27181"};
};

TEST_F(MotorMemoryTest, WhatWasNeverKeptIsCold) { EXPECT_EQ(memory_.now(), MotorStates{}); }

TEST_F(MotorMemoryTest, MotorsCoolFromWhereTheyWereLeft) {
  memory_.keep(with_motor(3, {104, 60}));
  const MotorTemperatures soon = memory_.now()[3];
  EXPECT_NEAR(soon.winding_c, 104, 3);
  EXPECT_NEAR(soon.case_c, 60, 0.5);
  EXPECT_EQ(memory_.now()[2], MotorTemperatures{});
  age(60);
  const MotorTemperatures later = memory_.now()[3];
  EXPECT_NEAR(later.winding_c, later.case_c, 2) << "a winding is as its case after five times its time of 12.4 s";
  EXPECT_GT(later.case_c, 55) << "which takes ten minutes";
  age(7 * 612);
  EXPECT_NEAR(memory_.now()[3].winding_c, 25, 0.1);
}

TEST_F(MotorMemoryTest, ARestartIsBridgedByTheCalendarAndACalendarSetBackCoolsNothing) {
  memory_.keep(with_motor(0, {90, 70}));
  age(60, true);
  EXPECT_LT(memory_.now()[0].winding_c, 75);
  memory_.keep(with_motor(0, {90, 70}));
  age(-3600, true);
  EXPECT_EQ(memory_.now(), with_motor(0, {90, 70}));
}

TEST_F(MotorMemoryTest, WhatCannotBeReadIsColdAndIsKeptAnew) {
  memory_.keep(with_motor(1, {90, 70}));
  for (const char* text : {"", "{", "[]", R"({"boot": "x", "calendar_s": 0, "motors_c": [[90, 70]]})",
                           R"({"boot": "x", "calendar_s": 0,
                               "motors_c": [[9e9, 7], [1, 1], [1, 1], [1, 1], [1, 1], [1, 1], [1, 1]]})"}) {
    std::ofstream(memory_.file()) << text;
    EXPECT_EQ(memory_.now(), MotorStates{}) << text;
  }
  memory_.keep(with_motor(1, {90, 70}));
  EXPECT_GT(memory_.now()[1].winding_c, 80);
}

TEST_F(MotorMemoryTest, EachDeviceHasItsOwn) {
  memory_.keep(with_motor(1, {90, 70}));
  EXPECT_EQ(MotorMemory(folder_.path() / "motors", "hostmot2", "10.0.0.8:27181").now(), MotorStates{});
  EXPECT_EQ(MotorMemory(folder_.path() / "motors", "mc4000", "../../x/y").file().parent_path(),
            folder_.path() / "motors");
}

TEST(TooHotToBegin, NamesTheMotorAndHowLongItTakes) {
  EXPECT_EQ(too_hot_to_begin(with_motor(2, {99.9, 99})), "");
  EXPECT_EQ(too_hot_to_begin(with_motor(2, {112, 60})), "motor 3 is at 112 C by the model: let it cool for 10 s");
  EXPECT_EQ(too_hot_to_begin(with_motor(kPinchChannel, {104, 104})).find("the pinch's motor is at 104 C"), 0u);
}

TEST(MotorsOfARealDevice, GoFromOneAttemptToTheNext) {
  const RunnerFolder folder;
  setenv("XDG_DATA_HOME", folder.path().c_str(), 1);
  SimulatedDaq device(FakeHostmot2::device_config({}));
  FakeHostmot2 card(device, {}, hostmot2::standard_wiring());
  AttemptRequest request = short_request(":memory:");
  request.setup.backend = kHostmot2Backend;
  request.setup.card = card.address();
  const MotorMemory memory(motor_folder(), request.setup.backend, request.setup.card);

  memory.keep(with_motor(4, {118, 118}));
  try {
    AttemptRunner run(request, find_assets());
    FAIL() << "it began with a hot motor";
  } catch (const EnvironmentError& error) {
    EXPECT_EQ(std::string(error.what()).find("motor 5 is at 118 C"), 0u) << error.what();
  }

  memory.keep(with_motor(4, {80, 80}));
  const auto kept_at = std::filesystem::last_write_time(memory.file());
  {
    AttemptRunner run(request, find_assets());
    EXPECT_NEAR(run.scene().loop.motors[4].winding_c, 80, 2);
    ASSERT_TRUE(wait_for([&] { return run.newest().seen; }));
    EXPECT_NEAR(run.newest().record.winding_c, 80, 2);
    run.abort();
    run.result();
  }
  EXPECT_GT(std::filesystem::last_write_time(memory.file()), kept_at);
  EXPECT_NEAR(memory.now()[4].case_c, 80, 2);
  unsetenv("XDG_DATA_HOME");
}

}  // namespace
}  // namespace trocar::motor_memory_test
