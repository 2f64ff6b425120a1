// `trocar device eval` and `ik` as functions: published numbers at home and identities between their columns.
#include "app/cli/device/device_command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "app/cli/device/numeric_csv.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::device_command_test {
namespace {

const std::vector<std::string> kAngles{"q1_rad", "q2_rad", "q3_rad", "q4_rad", "q5_rad", "q6_rad"};
const std::vector<std::string> kRates{"qd1_rad_s", "qd2_rad_s", "qd3_rad_s", "qd4_rad_s", "qd5_rad_s", "qd6_rad_s"};
const std::vector<std::string> kWrench{"fx6_N", "fy6_N", "fz6_N", "mx6_Nm", "my6_Nm", "mz6_Nm"};
const std::vector<std::string> kTwist{"vx_m_s", "vy_m_s", "vz_m_s", "wx_rad_s", "wy_rad_s", "wz_rad_s"};
const std::vector<std::string> kTorque{"tau1_Nm", "tau2_Nm", "tau3_Nm", "tau4_Nm", "tau5_Nm", "tau6_Nm"};
const std::vector<std::string> kHolding{"taug1_Nm", "taug2_Nm", "taug3_Nm", "taug4_Nm", "taug5_Nm", "taug6_Nm"};

class DeviceTables : public ::testing::Test {
 protected:
  NumericCsv eval(const NumericCsv& in) {
    write_numeric_csv(folder_ / "in.csv", in);
    EXPECT_EQ(device_eval(folder_ / "in.csv", folder_ / "out.csv", err_), 0);
    return read_numeric_csv(folder_ / "out.csv");
  }
  static double cell(const NumericCsv& table, std::size_t row, const std::string& name) {
    return table.rows[row][table.require(name, "table")];
  }
  static Vec6 six(const NumericCsv& table, std::size_t row, const std::vector<std::string>& names) {
    Vec6 out;
    for (int i = 0; i < 6; ++i) out[i] = cell(table, row, names[static_cast<std::size_t>(i)]);
    return out;
  }
  static NumericCsv home_table() {
    const JointVector home = home_angles();
    return {kAngles, {std::vector<double>(home.begin(), home.end())}};
  }
  /// Twenty poses about home with rates and wrenches.
  static NumericCsv poses() {
    NumericCsv table{kAngles, {}};
    for (const auto* names : {&kRates, &kWrench})
      table.columns.insert(table.columns.end(), names->begin(), names->end());
    for (int i = 0; i < 20; ++i) {
      auto& row = table.rows.emplace_back();
      for (int j = 0; j < 18; ++j) row.push_back((j < 6 ? home_angles()[j] : 0) + 0.2 * std::sin(1.3 * i + 2.1 * j));
    }
    return table;
  }

  test::TemporaryFolder folder_;
  std::ostringstream err_;
};

TEST_F(DeviceTables, HomeHasThePublishedPoseAndHoldingTorques) {
  const NumericCsv out = eval(home_table());
  const double pose[3][4] = {{0, -1, 0, 0}, {0, 0, -1, -0.006}, {1, 0, 0, -0.272}};  // jig of the device reference
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) {
      const std::string name = "T" + std::to_string(i) + std::to_string(j);
      EXPECT_NEAR(cell(out, 0, name), pose[i][j], 1e-12) << name;
    }
  }
  const double holding[6] = {0.0224, -0.0224, 0, -0.0144, 0, 0};  // printed to four digits
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(six(out, 0, kHolding)[i], holding[i], 5e-5) << i;
  EXPECT_GT(cell(out, 0, "sigma_min_L0.2m"), 0.01);
}

TEST_F(DeviceTables, ColumnsThatAreNotAskedForAreNotMade) {
  const NumericCsv angles_only = eval(home_table());
  EXPECT_EQ(angles_only.columns.size(), 6u + 12 + 6 + 1);
  EXPECT_FALSE(angles_only.find("vx_m_s"));
  EXPECT_FALSE(angles_only.find("tau1_Nm"));
  EXPECT_EQ(eval(poses()).columns.size(), 6u + 12 + 12 + 12 + 6 + 1);
}

TEST_F(DeviceTables, PowerAtTheStylusIsPowerAtTheJoints) {
  const NumericCsv out = eval(poses());
  ASSERT_EQ(out.rows.size(), 20u);
  for (std::size_t row = 0; row < out.rows.size(); ++row) {
    Mat3 R;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) R(i, j) = cell(out, row, "T" + std::to_string(i) + std::to_string(j));
    const Vec6 wrench = six(out, row, kWrench), twist = six(out, row, kTwist);
    const double at_stylus = (R * wrench.head<3>()).dot(twist.head<3>()) + (R * wrench.tail<3>()).dot(twist.tail<3>());
    EXPECT_NEAR(six(out, row, kTorque).dot(six(out, row, kRates)), at_stylus, 1e-14)
        << row;  // roundings of sums below 0.1 W
  }
}

TEST_F(DeviceTables, TwistIsTheDerivativeOfThePose) {
  constexpr double kStep = 1e-6;  // s: error of a central difference ~ step^2, of rounding ~ 1e-16 / step
  const NumericCsv in = poses();
  const NumericCsv out = eval(in);
  for (std::size_t row = 0; row < in.rows.size(); ++row) {
    NumericCsv around{kAngles, {{}, {}}};
    for (std::size_t j = 0; j < 6; ++j) {
      around.rows[0].push_back(in.rows[row][j] - kStep * in.rows[row][6 + j]);
      around.rows[1].push_back(in.rows[row][j] + kStep * in.rows[row][6 + j]);
    }
    const NumericCsv moved = eval(around);
    const char* position[3] = {"T03", "T13", "T23"};
    for (int i = 0; i < 3; ++i) {
      const double speed = (cell(moved, 1, position[i]) - cell(moved, 0, position[i])) / (2 * kStep);
      EXPECT_NEAR(six(out, row, kTwist)[i], speed, 1e-9) << row << ' ' << position[i];
    }
  }
}

TEST_F(DeviceTables, SomeOfSixColumnsAreRefused) {
  NumericCsv table = poses();
  table.columns[17] = "misnamed";
  write_numeric_csv(folder_ / "in.csv", table);
  EXPECT_THROW(device_eval(folder_ / "in.csv", folder_ / "out.csv", err_), InputError);
  table = poses();
  table.columns[6] = "misnamed";  // the first of its six: the other five must not be passed over
  write_numeric_csv(folder_ / "in.csv", table);
  EXPECT_THROW(device_eval(folder_ / "in.csv", folder_ / "out.csv", err_), InputError);
}

TEST_F(DeviceTables, EveryCandidateOfAPoseReachesIt) {
  const NumericCsv asked = eval(poses());
  ASSERT_EQ(device_ik(folder_ / "out.csv", folder_ / "ik.csv", err_), 0);
  const NumericCsv found = read_numeric_csv(folder_ / "ik.csv");
  EXPECT_EQ(found.rows.size(), 2 * asked.rows.size()) << "both signs of the arm plane are solutions";
  NumericCsv angles{kAngles, {}};
  for (const auto& row : found.rows) angles.rows.emplace_back(row.begin() + 3, row.end());
  const NumericCsv reached = eval(angles);
  for (std::size_t i = 0; i < found.rows.size(); ++i) {
    const auto row = static_cast<std::size_t>(found.rows[i][0]);
    for (const char* name : {"T00", "T01", "T02", "T03", "T10", "T11", "T12", "T13", "T20", "T21", "T22", "T23"}) {
      EXPECT_NEAR(cell(reached, i, name), cell(asked, row, name), 1e-9) << name << " of row " << row;
    }
  }
}

TEST_F(DeviceTables, AFarPoseIsNamedWithTheDistanceByWhichItMisses) {
  NumericCsv far{{"T00", "T01", "T02", "T03", "T10", "T11", "T12", "T13", "T20", "T21", "T22", "T23"},
                 {{1, 0, 0, 0, 0, 1, 0, 0.3, 0, 0, 1, -0.4}}};
  write_numeric_csv(folder_ / "in.csv", far);
  EXPECT_EQ(device_ik(folder_ / "in.csv", folder_ / "out.csv", err_), 2);
  // |p| = 500 mm, links of 146 and 128 mm.
  EXPECT_NE(err_.str().find("in.csv:2: no solution: out of reach by 226 mm"), std::string::npos) << err_.str();
  EXPECT_TRUE(read_numeric_csv(folder_ / "out.csv").rows.empty());
}

}  // namespace
}  // namespace trocar::device_command_test
