// `trocar device eval` and `ik` on tables, from outside: strict reading, and agreement of the two with each other.
#include <cmath>
#include <sstream>

#include "tests/system/table.h"

namespace trocar::test::device_table_test {
namespace {

using DeviceTable = SystemTest;

constexpr const char* kHeader = "q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\n";

TEST_F(DeviceTable, ARaggedLineIsNamed) {
  folder_.write("q.csv", std::string(kHeader) + "0,0,0,0,0,0\n0,0,0,0,0\n");
  expect_refusal({"device", "eval", "--csv", "q.csv", "--out", "o.csv"}, 2,
                 "q.csv:3:1: 5 fields where the header has 6");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "o.csv"));
}

TEST_F(DeviceTable, WhatIsNoFiniteNumberIsNamedWithItsColumn) {
  for (const char* bad : {"nan", "inf", "-inf", "1e999", "zero", "", "0x10", "1 2"}) {
    folder_.write("q.csv", std::string(kHeader) + "0,0,0,0,0,0\n0,0," + bad + ",0,0,0\n");
    expect_refusal({"device", "eval", "--csv", "q.csv", "--out", "o.csv"}, 2, "q.csv:3:3:");
    expect_refusal({"device", "eval", "--csv", "q.csv", "--out", "o.csv"}, 2, "q3_rad");
  }
}

TEST_F(DeviceTable, AMissingColumnOrAnEmptyFileIsNamed) {
  folder_.write("q.csv", "q1_rad,q2_rad,q3_rad,q4_rad,q6_rad\n0,0,0,0,0\n");
  expect_refusal({"device", "eval", "--csv", "q.csv", "--out", "o.csv"}, 2, "no column 'q5_rad'");
  folder_.write("q.csv", "q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,qd1_rad_s\n0,0,0,0,0,0,0\n");
  expect_refusal({"device", "eval", "--csv", "q.csv", "--out", "o.csv"}, 2, "no column 'qd2_rad_s'");
  folder_.write("q.csv", "");
  expect_refusal({"device", "eval", "--csv", "q.csv", "--out", "o.csv"}, 2, "q.csv:1:1: empty file");
  folder_.write("t.csv", "T00,T01\n1,0\n");
  expect_refusal({"device", "ik", "--csv", "t.csv", "--out", "o.csv"}, 2, "no column 'T02'");
}

TEST_F(DeviceTable, AMatrixThatIsNoRotationIsRefusedAtItsLine) {
  folder_.write("t.csv", "T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n2,0,0,0,0,1,0,0,0,0,1,0\n");
  expect_refusal({"device", "ik", "--csv", "t.csv", "--out", "o.csv"}, 2,
                 "t.csv:2:1: T00..T22 is not a rotation matrix");
}

TEST_F(DeviceTable, EvaluationThenInversionFindsTheAnglesAgain) {
  const double home[6] = {0.74, 0.83, 0.79, -0.6, -1.4, 1.5};  // inside the joint ranges, theta6 within [0, 2 pi)
  std::ostringstream angles;
  angles << kHeader;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 6; ++j) angles << (j ? "," : "") << home[j] + 0.25 * std::sin(1.7 * i + 2.3 * j);
    angles << '\n';
  }
  folder_.write("q.csv", angles.str());
  ASSERT_EQ(trocar({"device", "eval", "--csv", "q.csv", "--out", "pose.csv"}).exit_code, 0);
  const Outcome inverted = trocar({"device", "ik", "--csv", "pose.csv", "--out", "all.csv"});
  ASSERT_EQ(inverted.exit_code, 0) << inverted.err;
  const Table asked = read_table(folder_ / "q.csv"), found = read_table(folder_ / "all.csv");
  EXPECT_EQ(found.columns,
            (Translator{"row", "solution", "in_limits", "q1_rad", "q2_rad", "q3_rad", "q4_rad", "q5_rad", "q6_rad"}));
  for (std::size_t row = 0; row < asked.rows.size(); ++row) {
    double nearest = 1e9;
    for (const auto& candidate : found.rows) {
      if (candidate[0] != static_cast<double>(row)) continue;
      double distance = 0;
      for (std::size_t j = 0; j < 6; ++j)
        distance = std::max(distance, std::abs(candidate[3 + j] - asked.rows[row][j]));
      nearest = std::min(nearest, distance);
    }
    EXPECT_LT(nearest, 1e-9) << "row " << row;  // well-conditioned poses: a few hundred roundings
  }
}

TEST_F(DeviceTable, APoseOutOfReachIsNamedWithItsDistance) {
  folder_.write("t.csv", "T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n1,0,0,0.9,0,1,0,0.1,0,0,1,0.1\n");
  const Outcome outcome = trocar({"device", "ik", "--csv", "t.csv", "--out", "o.csv"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("t.csv:2: no solution: out of reach by"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace trocar::test::device_table_test
