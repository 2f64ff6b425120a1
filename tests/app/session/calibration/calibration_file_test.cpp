// The calibration as a file: back as it went, refused where it is not what it says, and checked on a device.
#include "app/session/calibration/calibration_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <sstream>

#include <nlohmann/json.hpp>

#include "app/cli/device/device_calibrate.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::calibration_file_test {
namespace {

using Json = nlohmann::ordered_json;

AmplifierCalibration sample() {
  AmplifierCalibration found;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double x = 1.0 + 0.1 * static_cast<double>(i);
    found[i] = {0.431 * x, 1e-3 * x, -2e-3 * x, 3e-4 * x, 8.6e-4 * x, 3e-4 * x};
  }
  return found;
}

class CalibrationFile : public ::testing::Test {
 protected:
  void write(const std::string& text) { std::ofstream(folder_ / "c.json") << text; }
  void expect_refusal(const std::function<void(Json&)>& spoil, const std::string& words) {
    Json json = Json::parse(calibration_json(sample(), DeviceModel{}));
    spoil(json);
    write(json.dump());
    expect_refusal_of_the_file(words);
  }
  void expect_refusal_of_the_file(const std::string& words) {
    try {
      read_calibration(folder_ / "c.json");
      ADD_FAILURE() << "accepted; expected: " << words;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("c.json"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
  test::TemporaryFolder folder_;
};

TEST_F(CalibrationFile, ComesBackAsItWent) {
  write(calibration_json(sample(), DeviceModel{}));
  const AmplifierCalibration back = read_calibration(folder_ / "c.json"), went = sample();
  for (std::size_t i = 0; i < back.size(); ++i) {
    EXPECT_EQ(back[i].amps_per_volt, went[i].amps_per_volt);
    EXPECT_EQ(back[i].amps_per_volt_sd, went[i].amps_per_volt_sd);
    EXPECT_EQ(back[i].offset_v, went[i].offset_v);
    EXPECT_EQ(back[i].offset_sd_v, went[i].offset_sd_v);
    EXPECT_EQ(back[i].stiction_nm, went[i].stiction_nm);
    EXPECT_EQ(back[i].residual_nm, went[i].residual_nm);
  }
}

TEST_F(CalibrationFile, GainIsAlsoGivenOverNominal) {
  const Json json = Json::parse(calibration_json(sample(), DeviceModel{}));
  EXPECT_NEAR(json.at("channels").at(0).at("gain_over_nominal").get<double>(), 1.0, 1e-12);
  EXPECT_NEAR(json.at("channels").at(6).at("gain_over_nominal").get<double>(), 1.6, 1e-12);
  EXPECT_EQ(json.at("channels").at(6).at("channel"), "pinch");
  EXPECT_STREQ(calibration_channel(3), "joint 4");
}

TEST_F(CalibrationFile, RefusesWhatIsNoCalibration) {
  expect_refusal_of_the_file("cannot be read");
  for (const char* text : {"", "not json", "[1,2]", "{\"channels\":"}) {
    write(text);
    expect_refusal_of_the_file("no JSON object");
  }
  write("{}");
  expect_refusal_of_the_file("array of seven");
  write("{\"channels\": [], \"plant\": \"a\", \"channels\": []}");
  expect_refusal_of_the_file("\"channels\" comes twice");
  expect_refusal([](Json& j) { j["chanels"] = 1; }, "unknown key \"chanels\"");
  expect_refusal([](Json& j) { j["channels"][3]["offset_mv"] = 1; }, "channels[3]: unknown key \"offset_mv\"");
  expect_refusal([](Json& j) { j["channels"].erase(2); }, "array of seven");
  expect_refusal([](Json& j) { j["channels"][2] = 5; }, "channels[2]: not an object");
}

TEST_F(CalibrationFile, RefusesChannelsAndNumbersThatCannotBe) {
  expect_refusal([](Json& j) { j["channels"][1]["channel"] = "joint 1"; }, "\"joint 1\" where \"joint 2\" belongs");
  expect_refusal([](Json& j) { j["channels"][4].erase("offset_v"); }, "channels[4]: no \"offset_v\"");
  expect_refusal([](Json& j) { j["channels"][4]["offset_v"] = "small"; }, "channels[4].offset_v: not a finite number");
  expect_refusal([](Json& j) { j["channels"][0]["amps_per_volt"] = nullptr; },
                 "channels[0].amps_per_volt: not a finite");
  expect_refusal([](Json& j) { j["channels"][6]["amps_per_volt"] = 0; }, "channels[6].amps_per_volt: must be positive");
  expect_refusal([](Json& j) { j["channels"][6]["amps_per_volt"] = -0.4; }, "must be positive");
  expect_refusal([](Json& j) { j["channels"][6]["amps_per_volt"] = 431; },
                 "channels[6].amps_per_volt: no amplifier of this device");
  expect_refusal([](Json& j) { j["channels"][6]["amps_per_volt"] = 1e-300; }, "no amplifier of this device");
  expect_refusal([](Json& j) { j["channels"][2]["channel"] = 3; }, "channels[2].channel");
  expect_refusal([](Json& j) { j["channels"][3]["offset_v"] = 1.5; }, "channels[3].offset_v: must be under 1 V");
}

TEST_F(CalibrationFile, HoldsForItsOwnDeviceAndNotForAnother) {
  std::ostringstream out, err;
  CalibrateOptions find{2, 5, true, folder_ / "c.json", {}};
  ASSERT_EQ(device_calibrate(find, out, err), 0);
  CalibrateOptions check{2, 5, false, {}, folder_ / "c.json"};
  EXPECT_EQ(device_calibrate(check, out, err), 0) << "the same device renders what is asked";
  check.gain = 1;
  EXPECT_EQ(device_calibrate(check, out, err), 1) << "another gain: a fifth of the torque";
  check.gain = 5;
  check.out = folder_ / "d.json";
  EXPECT_THROW(device_calibrate(check, out, err), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "d.json"));
}

}  // namespace
}  // namespace trocar::calibration_file_test
