#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "app/device_bench/thesis_kinematics.h"
#include "app/window/device/device_panel.h"
#include "haptics/device/transmission.h"
#include "haptics/input_error.h"
#include "haptics/kinematics/device_geometry.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::device_numbers_test {
namespace {

TickRecord record_at(const JointVector& q) {
  TickRecord record;
  record.q.head<kArmJoints>() = q;
  record.q[kPinchChannel] = 0.012;
  return record;
}

double value_of(const std::string& csv, const std::string& name) {
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);)
    if (line.rfind(name + ",", 0) == 0) return std::stod(line.substr(name.size() + 1));
  ADD_FAILURE() << "no " << name;
  return 0;
}

TEST(DeviceNumbers, NumbersKeepTheirColumns) {
  for (const double value : {0.0, -0.0, 1.0, -1.0, 12.345, -99.994, 179.99, -160.0})
    EXPECT_EQ(fixed_number(value, 8, 2).find('.'), fixed_number(value, 8, 2).size() - 3)
        << value << ": two decimals, always";
  EXPECT_EQ(fixed_number(5, 8, 2), "+5.00") << "with its sign";
  EXPECT_EQ(fixed_number(-0.001, 8, 2), "+0.00") << "what is shown as nothing does not flicker between signs";
  EXPECT_EQ(fixed_number(-0.02, 8, 2), "-0.02");
  EXPECT_EQ(fixed_number(std::numeric_limits<double>::infinity(), 6, 0), "inf");
  EXPECT_EQ(fixed_number(std::nan(""), 6, 0), "-");
}

TEST(DeviceNumbers, TooLargeANumberIsNeverCutToAWrongOne) { EXPECT_EQ(fixed_number(123456.7, 6, 2), ">>>>>>"); }

TEST(DeviceNumbers, ForwardKinematicsIsThatOfTheThesisSamples) {
  for (const thesis::Sample& sample : thesis::samples()) {
    if (!std::isfinite(sample.exact.x())) continue;
    const DeviceReading r = device_reading(record_at(sample.q), {});
    EXPECT_LT((r.X_WS.p - sample.exact).norm(), 0.2e-6) << sample.name << ": published to 0.1 um";
    EXPECT_NEAR((r.X_WS.R - sample.printed.R).cwiseAbs().maxCoeff(), 0, 0.02)
        << sample.name << ": printed with two-digit matrices";
  }
}

TEST(DeviceNumbers, MatricesAreRotations) {
  const DeviceReading r = device_reading(record_at(thesis::samples()[1].q), {});
  EXPECT_LT((r.R_WP * r.R_WP.transpose() - Mat3::Identity()).norm(), 1e-9);
  EXPECT_NEAR(r.R_WP.determinant(), 1, 1e-9);
}

TEST(DeviceNumbers, TorqueGivenIsWhatTheCodesStandFor) {
  HapticLoopConfig loop;
  TickRecord record = record_at(thesis::samples()[1].q);
  record.torque.setConstant(0.05);
  record.amplifiers_armed = true;
  record.out = dac_codes(loop.device, record.torque, loop.daq.dac_bits);
  const DeviceReading r = device_reading(record, loop);
  EXPECT_LT((r.delivered - record.torque).cwiseAbs().maxCoeff(), 5e-5) << "but for the quantisation";
  record.out.codes[2] = 0;
  EXPECT_NEAR(device_reading(record, loop).delivered[2], 0, 5e-3)
      << "a code of nothing gives nothing, whatever was asked";
  record.amplifiers_armed = false;
  EXPECT_EQ(device_reading(record, loop).delivered.norm(), 0);
}

TEST(DeviceNumbers, RowsHaveNamesAndUnitsThatPeopleRead) {
  TickRecord record = record_at(JointVector::Constant(30 * kDegree));
  record.torque[1] = 0.0123;
  const auto rows = joint_rows(device_reading(record, {}));
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(kChannels));
  EXPECT_EQ(rows[0][0], "q1");
  EXPECT_NE(rows[0][1].find("+30.00"), std::string::npos);
  EXPECT_NE(rows[1][3].find("+12.30"), std::string::npos) << "mN m";
  EXPECT_EQ(rows[6][0], "pinch");
  EXPECT_NE(rows[6][1].find("+12.00"), std::string::npos) << "mm";
  EXPECT_EQ(stylus_matrix(device_reading(record, {})).size(), 4u);
}

TEST(DeviceNumbers, CsvHoldsEverythingOnceWithItsUnit) {
  TickRecord record = record_at(thesis::samples()[1].q);
  record.det_a = 0.75;
  record.winding_c = 41;
  record.stylus.energy_j = 0.002;
  record.stylus.F_I_T.force = {0.1, -0.2, 0.3};
  const std::string csv = device_csv(device_reading(record, {}));
  EXPECT_EQ(csv.rfind("name,value,unit\n", 0), 0u);
  EXPECT_NEAR(value_of(csv, "q1"), thesis::samples()[1].q[0] / kDegree, 1e-6);
  EXPECT_DOUBLE_EQ(value_of(csv, "det_A"), 0.75);
  EXPECT_DOUBLE_EQ(value_of(csv, "winding"), 41);
  EXPECT_DOUBLE_EQ(value_of(csv, "energy"), 2) << "mJ";
  EXPECT_DOUBLE_EQ(value_of(csv, "tip_force_y"), -0.2);
  std::istringstream lines(csv);
  std::set<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 2) << line;
    EXPECT_TRUE(names.insert(line.substr(0, line.find(','))).second) << line;
  }
}

TEST(DeviceNumbers, EachCopyIsAFileOfItsOwn) {
  const test::TemporaryFolder folder;
  const DeviceReading r = device_reading(record_at(thesis::samples()[1].q), {});
  const auto first = save_device_csv(r, folder.path() / "new"), second = save_device_csv(r, folder.path() / "new");
  EXPECT_NE(first, second);
  std::ifstream in(second);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), device_csv(r));
}

TEST(DeviceNumbers, FolderThatCannotBeWrittenIsNamed) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "file") << "x";
  try {
    save_device_csv({}, folder.path() / "file");
    FAIL() << "a file taken for a folder";
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find("file"), std::string::npos);
  }
}

}  // namespace
}  // namespace trocar::device_numbers_test
