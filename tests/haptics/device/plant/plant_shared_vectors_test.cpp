// The plant against 100 independently computed poses; needs the shared reference folder.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "haptics/device/plant/device_plant.h"

namespace trocar::plant_shared_vectors_test {
namespace {

std::filesystem::path vectors_file() {
  const char* folder = std::getenv("TROCAR_SHARED");
  const std::filesystem::path shared = folder ? folder : std::string(TROCAR_SOURCE_DIR) + "/../shared";
  return shared / "reference" / "device_vectors.csv";
}

using Row = std::vector<double>;

std::vector<Row> read_rows() {
  std::ifstream in(vectors_file());
  std::string line;
  std::getline(in, line);  // titles
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    std::stringstream cells(line);
    Row row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    if (row.size() == 49) rows.push_back(row);
  }
  return rows;
}

Vec6 six(const Row& row, std::size_t first) { return Eigen::Map<const Vec6>(row.data() + first); }

class PlantVectors : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(vectors_file())) GTEST_SKIP() << "SKIPPED: no shared reference at " << vectors_file();
    rows = read_rows();
    ASSERT_EQ(rows.size(), 100u);
  }
  std::vector<Row> rows;
  DevicePlant plant{nominal_parameters()};
};

// Columns: q 0-5, T 6-17, qd 18-23, twist 24-29, wrench (stylus frame) 30-35, tau 36-41, tau_g 42-47. The file has
// 12 significant digits: 1e-11 relative, 1e-10 with the conditioning of the poses.
TEST_F(PlantVectors, StylusPose) {
  for (const Row& row : rows) {
    plant.place(six(row, 0), 0.02);
    const Pose X = plant.motion().X_BS;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(X.R(r, c), row[6 + 4 * r + c], 1e-10);
      EXPECT_NEAR(X.p[r], row[6 + 4 * r + 3], 1e-10);
    }
  }
}

TEST_F(PlantVectors, TwistAndRates) {
  for (const Row& row : rows) {
    plant.place(six(row, 0), 0.02);
    plant.set_joint_rates(six(row, 18));
    const Twist V = plant.motion().V_BS;
    Vec6 twist;
    twist << V.linear, V.angular;
    EXPECT_LT((twist - six(row, 24)).cwiseAbs().maxCoeff(), 1e-8) << "q " << six(row, 0).transpose();
    EXPECT_LT((plant.rates() - six(row, 18)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST_F(PlantVectors, TorqueOfAWrench) {
  for (const Row& row : rows) {
    plant.place(six(row, 0), 0.02);
    const Mat3 R = plant.motion().X_BS.R;
    const Vec6 local = six(row, 30);
    Vec6 wrench;
    wrench << R * local.head<3>(), R * local.tail<3>();
    EXPECT_LT((plant.joint_jacobian().transpose() * wrench - six(row, 36)).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST_F(PlantVectors, HoldingTorque) {
  for (const Row& row : rows) {
    plant.place(six(row, 0), 0.02);
    EXPECT_LT((plant.holding_torque() - six(row, 42)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

}  // namespace
}  // namespace trocar::plant_shared_vectors_test
