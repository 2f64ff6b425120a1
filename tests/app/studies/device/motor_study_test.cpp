// The motor study against the motor's equations, and `trocar device fk`.
#include "app/studies/device/motor_study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include <nlohmann/json.hpp>

#include "app/cli/device/device_forward.h"
#include "app/cli/device/numeric_csv.h"
#include "app/studies/study_files.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/hybrid_arm.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::motor_study_test {
namespace {

constexpr double kOhm = 2.32, kPerAmp = 0.0232;  // table 3.4

TEST(MotorStudy, MeetsEveryBarQuickAndFull) {
  for (const bool quick : {true, false}) {
    const StudyResult study = motor_study({quick, 1});
    EXPECT_GE(study.cases.size(), 10u);
    for (const StudyCase& c : study.cases) {
      EXPECT_TRUE(c.met) << c.name << ": " << c.value << ' ' << c.unit << ", asked for " << c.bar;
      EXPECT_FALSE(c.definition.empty()) << c.name;
    }
  }
}

TEST(MotorStudy, SteadyStateIsThatOfThePermanentMagnetMotor) {
  for (const double volts : {1.0, 3.0, 5.0, 24.0}) {
    const double stall = volts / kOhm * kPerAmp;
    for (const double share : {0.0, 0.3, 0.7, 0.95}) {
      const MotorPoint at = loaded_motor(volts, share * stall);
      // U = R i + k w and torque = k i; the run stops at 1 rad/s2, 4.4 ms of time constant away from the end: 5e-3
      // rad/s.
      EXPECT_NEAR(at.torque_nm, share * stall, 2e-6 + 1e-6 * stall) << volts << " V";
      EXPECT_NEAR(at.current_a * kPerAmp, at.torque_nm, 1e-12);
      EXPECT_NEAR(at.speed_rad_s, volts * (1 - share) / kPerAmp, 0.02) << volts << " V, " << share;
    }
  }
}

TEST(MotorStudy, AMotorLoadedBeyondStallStands) {
  const MotorPoint at = loaded_motor(5, 0.06);
  EXPECT_EQ(at.speed_rad_s, 0);
  EXPECT_NEAR(at.torque_nm, 0.05, 1e-4);
}

TEST(MotorStudy, CommandSetsTheCurrentAndSpeedDoesNotTouchIt) {
  for (const double speed : {-300.0, 0.0, 300.0, 600.0})
    EXPECT_NEAR(driven_motor(5, speed).current_a, 2.155, 1e-6) << speed;
  EXPECT_LT(driven_motor(5, 1000).current_a, 1.0) << "the supply ends it";
  EXPECT_NEAR(driven_motor_at_leads(5, 100).current_a, (5 - kPerAmp * 100) / kOhm, 1e-6);
}

TEST(MotorStudy, CurvesAreWholeAndTheSameEveryTime) {
  const StudyResult one = motor_study({true, 1}), two = motor_study({true, 1});
  EXPECT_EQ(summary_json(one), summary_json(two));
  ASSERT_EQ(one.curves.size(), 6u) << "figures 3.27 to 3.30, the command at rest and in motion";
  for (std::size_t i = 0; i < one.curves.size(); ++i) {
    EXPECT_EQ(curves_csv(one.curves[i]), curves_csv(two.curves[i]));
    for (const auto& series : one.curves[i].series) EXPECT_EQ(series.y.size(), one.curves[i].x.size());
    EXPECT_EQ(curves_svg(one.curves[i]).find("e+"), std::string::npos)
        << one.curves[i].file << ": ticks are plain numbers";
  }
}

TEST(DeviceForward, ListsEightSolutionsOfTheThesisExample) {
  std::ostringstream out, err;
  EXPECT_EQ(device_forward({{30, 20, 25, -60, -50, 120}, true, {}, {}}, out, err), 0);
  const auto json = nlohmann::json::parse(out.str());
  ASSERT_EQ(json.at("solutions").size(), 8u);
  EXPECT_TRUE(json.at("in_limits"));
  int trivial = 0;
  for (const auto& s : json.at("solutions")) {
    EXPECT_LT(s.at("residual").get<double>(), 1e-14);
    trivial += s.at("trivial").get<bool>();
  }
  EXPECT_EQ(trivial, 4);
  const auto& pose = json.at("solutions").at(0).at("X_WS");
  EXPECT_NEAR(pose.at(3).get<double>(), 0.0406612, 5e-8);  // device reference
  EXPECT_NEAR(pose.at(7).get<double>(), -0.1321386, 5e-8);
  EXPECT_NEAR(pose.at(11).get<double>(), -0.1930649, 5e-8);
}

TEST(DeviceForward, ThePlainListSaysWhatEachSolutionIs) {
  std::ostringstream out, err;
  EXPECT_EQ(device_forward({{30, 20, 25, -60, -50, 480}, false, {}, {}}, out, err), 0);
  for (const char* words : {"40.6612", "the device", "trivial", "unwrapped"}) {
    EXPECT_NE(out.str().find(words), std::string::npos) << words;
  }
  EXPECT_EQ(out.str().find("outside the limits"), std::string::npos) << "theta6 has no stop";
  std::ostringstream bent;
  device_forward({{30, 20, 25, -130, -50, 0}, false, {}, {}}, bent, err);
  EXPECT_NE(bent.str().find("outside the limits"), std::string::npos);
}

TEST(DeviceForward, TableOfConfigurationsBecomesEightRowsEach) {
  test::TemporaryFolder folder;
  std::ostringstream out, err;
  const NumericCsv in{{"q1_rad", "q2_rad", "q3_rad", "q4_rad", "q5_rad", "q6_rad"},
                      {{0.5, 0.6, 0.7, -1, -1.4, 0}, {0.9, 0.8, 0.7, -0.5, -1.2, 7}}};
  write_numeric_csv(folder / "in.csv", in);
  EXPECT_EQ(device_forward({{}, false, folder / "in.csv", folder / "out.csv"}, out, err), 0);
  const NumericCsv table = read_numeric_csv(folder / "out.csv");
  ASSERT_EQ(table.rows.size(), 16u);
  const JointVector q = (JointVector() << 0.9, 0.8, 0.7, -0.5, -1.2, 7).finished();
  EXPECT_NEAR(table.rows[8][table.require("T03", "out")], arm_state(q).X_WS.p.x(), 1e-12);
}

TEST(DeviceForward, RefusesWhatItCannotUse) {
  std::ostringstream out, err;
  EXPECT_THROW(device_forward({{}, false, {}, {}}, out, err), InputError);
  EXPECT_THROW(device_forward({{1, 2, 3}, false, {}, {}}, out, err), InputError);
  EXPECT_THROW(device_forward({{1, 2, 3, 4, 5, std::nan("")}, false, {}, {}}, out, err), InputError);
  EXPECT_THROW(device_forward({{1, 2, 3, 4, 5, 6}, false, "x.csv", "y.csv"}, out, err), InputError);
  EXPECT_THROW(device_forward({{}, false, "x.csv", {}}, out, err), InputError);
  EXPECT_THROW(device_forward({{}, false, "/nonexistent/x.csv", "y.csv"}, out, err), InputError);
}

}  // namespace
}  // namespace trocar::motor_study_test
