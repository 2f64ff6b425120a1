// The gravity, force and transparency studies in their quick form: bars, the thesis' failures, same seed same bytes.
#include <gtest/gtest.h>

#include <cmath>

#include "app/cli/device/identify_command.h"
#include "app/session/calibration/calibration_file.h"
#include "app/studies/contact/transparency_study.h"
#include "app/studies/device/force_study.h"
#include "app/studies/device/gravity_study.h"
#include "app/studies/study_files.h"
#include "haptics/control/gravity.h"
#include "haptics/input_error.h"
#include "scenarios/files/device_file.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <sstream>

namespace trocar::compensation_study_test {
namespace {

constexpr StudyRequest kQuick{true, 1};

const StudyCase& the_case(const StudyResult& study, const std::string& start) {
  for (const StudyCase& c : study.cases) {
    if (c.name.rfind(start, 0) == 0) return c;
  }
  ADD_FAILURE() << "no case " << start;
  return study.cases.front();
}

void expect_whole(const StudyResult& study) {
  EXPECT_NE(study.plant.find("simulated plant"), std::string::npos);
  for (const StudyCase& c : study.cases) {
    EXPECT_TRUE(std::isfinite(c.value)) << c.name;
    EXPECT_FALSE(c.definition.empty()) << c.name;
    EXPECT_FALSE(c.bar.empty()) << c.name;
  }
  for (const StudyCurves& c : study.curves) {
    for (const auto& series : c.series) EXPECT_EQ(series.y.size(), c.x.size()) << c.file << ", " << series.name;
    EXPECT_NE(c.title.find("simulated plant"), std::string::npos) << c.title;
  }
}

TEST(GravityStudy, MeetsItsBarsWhereTheThesisLawFalls) {
  const StudyResult study = gravity_study(kQuick);
  expect_whole(study);
  for (const StudyCase& c : study.cases) EXPECT_TRUE(c.met) << c.name << ": " << c.value << ' ' << c.unit;
  EXPECT_GT(*the_case(study, "drift of a released stylus, identified").thesis, 20) << "mm";
  EXPECT_GT(*the_case(study, "weight left over, identified").thesis, 0.05);
  EXPECT_LT(the_case(study, "weight left over, identified").value, the_case(study, "weight left over, nominal").value);
}

TEST(ForceStudy, MeetsItsBarsAndIsTheSameEveryTime) {
  const StudyResult study = force_study(kQuick);
  expect_whole(study);
  ASSERT_EQ(study.cases.size(), 30u);
  for (const StudyCase& c : study.cases) EXPECT_TRUE(c.met) << c.name << ": " << c.value << ' ' << c.unit;
  EXPECT_EQ(*the_case(study, "1 N along -Y6, whole chain: direction").thesis, 11.43);
  EXPECT_EQ(*the_case(study, "1 N m about -X6, static map: direction").thesis, 1.32);
  EXPECT_GT(the_case(study, "1 N along +Z6, held by a hand: direction").value,
            the_case(study, "1 N along +Z6, whole chain: direction").value)
      << "a fixture that is zeroed and comes from both sides flatters";
  EXPECT_EQ(summary_json(study), summary_json(force_study(kQuick)));
}

TEST(ForceStudy, HoldsForOtherDevices) {
  for (const std::uint64_t seed : {3u}) {  // whose amplifiers, not calibrated, turn a force by 8 deg
    for (const StudyCase& c : force_study({true, seed}).cases)
      EXPECT_TRUE(c.met) << seed << ", " << c.name << ": " << c.value;
  }
}

TEST(TransparencyStudy, CompensationTakesMostOfTheResistanceAway) {
  const StudyResult study = transparency_study(kQuick);
  expect_whole(study);
  // 70 % of the friction fed forward leaves 30 %: 3.33 times at best where there is friction alone.
  for (const std::string axis : {"X6", "Y6"}) {
    const StudyCase& c = the_case(study, axis + " at 0.10");
    EXPECT_GT(c.value, 2.7) << axis;
    EXPECT_LT(c.value, 3.6) << axis;
  }
  const StudyCase& vertical = the_case(study, "Z6 at 0.10");
  EXPECT_TRUE(vertical.met) << vertical.value;
  EXPECT_NE(vertical.bar.find("weight"), std::string::npos);
  EXPECT_TRUE(the_case(study, "motion at rest").met) << "no limit cycle";
  for (const StudyCurves& c : study.curves) {
    for (std::size_t k = 0; k < c.x.size(); ++k) EXPECT_LT(c.series[2].y[k], c.series[0].y[k]) << c.file;
  }
}

TEST(IdentifyCommand, WritesAFileThatHoldsTheArm) {
  IdentifyOptions options;
  options.quick = options.json = true;
  options.out = std::filesystem::temp_directory_path() / "trocar_identified.toml";
  std::ostringstream out, err;
  EXPECT_EQ(identify_command(options, out, err), 0);
  const auto json = nlohmann::json::parse(out.str());
  EXPECT_EQ(json.at("parameters").size(), 54u);
  EXPECT_LT(json.at("condition_number").get<double>(), 60);
  EXPECT_NEAR(json.at("stylus_weight_n").get<double>(), 0.76, 0.05);
  EXPECT_EQ(json.at("prediction_error").size(), 6u);
  const DeviceModel found = load_device(options.out), nominal;
  EXPECT_LT((gravity_parameters(found) - gravity_parameters(nominal)).norm(), 0.05);
  EXPECT_NE(gravity_parameters(found), gravity_parameters(nominal));
}

TEST(IdentifyCommand, RefusesBadRequests) {
  std::ostringstream out, err;
  IdentifyOptions heavy;
  heavy.payload_kg = 0.5;
  EXPECT_THROW(identify_command(heavy, out, err), InputError);
  IdentifyOptions nowhere;
  nowhere.quick = true;
  nowhere.out = "/nowhere/device.toml";
  EXPECT_THROW(identify_command(nowhere, out, err), EnvironmentError);
  IdentifyOptions unweighed;
  unweighed.quick = true;
  unweighed.calibration_out = std::filesystem::temp_directory_path() / "trocar_unweighed.json";
  EXPECT_THROW(identify_command(unweighed, out, err), InputError) << "no sensor, no calibration";
}

TEST(IdentifyCommand, ASensorSaysWhatTheDrivesGiveAndLeavesACalibration) {
  IdentifyOptions options;
  options.quick = options.json = true;
  options.sensor = "serial";
  options.calibration_out = std::filesystem::temp_directory_path() / "trocar_weighed.json";
  std::ostringstream out, err;
  EXPECT_EQ(identify_command(options, out, err), 0) << err.str();
  const auto json = nlohmann::json::parse(out.str());
  EXPECT_EQ(json.at("drives").at("sensor"), "serial");
  EXPECT_EQ(json.at("drives").at("left_out"), 0);
  const AmplifierCalibration written = read_calibration(options.calibration_out);
  for (std::size_t j = 0; j < kArmJoints; ++j) {
    const double nominal = nominal_transmissions()[j].amps_per_volt;
    EXPECT_NEAR(written[j].amps_per_volt, nominal * json.at("drives").at("scale")[j].get<double>(), 1e-12) << j;
  }
  EXPECT_EQ(written[kPinchChannel].amps_per_volt, nominal_transmissions()[kPinchChannel].amps_per_volt);
}

}  // namespace
}  // namespace trocar::compensation_study_test
