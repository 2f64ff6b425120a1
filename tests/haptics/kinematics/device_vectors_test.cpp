// The controller's models against 100 independently computed poses; needs the shared reference folder.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "haptics/control/gravity.h"
#include "haptics/kinematics/hybrid_arm.h"
#include "haptics/kinematics/inverse_kinematics.h"
#include "tests/haptics/haptics_fixtures.h"

namespace trocar::device_vectors_test {
namespace {

struct Row {
  std::vector<double> cell;
  Vec6 six(std::size_t first) const { return Eigen::Map<const Vec6>(cell.data() + first); }
  JointVector q() const { return six(0); }
};

class DeviceVectors : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("TROCAR_SHARED");
    const std::filesystem::path shared = folder ? folder : std::string(TROCAR_SOURCE_DIR) + "/../shared";
    const auto file = shared / "reference" / "device_vectors.csv";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "SKIPPED: no shared reference at " << file;
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
      std::stringstream cells(line);
      Row row;
      for (std::string cell; std::getline(cells, cell, ',');) row.cell.push_back(std::stod(cell));
      ASSERT_EQ(row.cell.size(), 49u);
      rows.push_back(row);
    }
    ASSERT_EQ(rows.size(), 100u);
  }
  std::vector<Row> rows;
};

// The table has 12 significant digits: an angle of 6 rad is known to 1e-11, and the shoulder multiplies that by up to
// 1 / det A, ten for most of the rows.
constexpr double kTable = 2e-10;

TEST_F(DeviceVectors, Pose) {
  for (const Row& row : rows) {
    const Pose X = arm_state(row.q()).X_WS;
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(X.R(int(r), int(c)), row.cell[6 + 4 * r + c], kTable);
      EXPECT_NEAR(X.p[int(r)], row.cell[6 + 4 * r + 3], kTable);
    }
  }
}

TEST_F(DeviceVectors, Twist) {
  for (const Row& row : rows) {
    const Vec6 twist = arm_state(row.q()).J_WS * row.six(18);
    EXPECT_LT((twist - row.six(24)).cwiseAbs().maxCoeff(), 1e-8);  // rates up to 2 rad/s through 1 / det A twice
  }
}

TEST_F(DeviceVectors, TorqueOfAWrenchInTheStylusFrame) {
  for (const Row& row : rows) {
    const ArmState arm = arm_state(row.q());
    Vec6 wrench;
    wrench << arm.X_WS.R * row.six(30).head<3>(), arm.X_WS.R * row.six(30).tail<3>();
    EXPECT_LT((arm.J_WS.transpose() * wrench - row.six(36)).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST_F(DeviceVectors, HoldingTorque) {
  for (const Row& row : rows) {
    EXPECT_LT((gravity_torque({}, arm_state(row.q())) - row.six(42)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST_F(DeviceVectors, Conditioning) {
  for (const Row& row : rows) EXPECT_NEAR(smallest_singular_value(arm_state(row.q()).J_WS, 0.2), row.cell[48], 1e-9);
}

TEST_F(DeviceVectors, InverseFindsTheAngles) {
  for (const Row& row : rows) {
    const auto q = inverse_within_limits(arm_state(row.q()).X_WS, row.q());
    ASSERT_TRUE(q.has_value());
    EXPECT_LT((*q - row.q()).cwiseAbs().maxCoeff(), 1e-9);
  }
}

}  // namespace
}  // namespace trocar::device_vectors_test
