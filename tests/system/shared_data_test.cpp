// The whole program on real data and reference vectors; skipped, loudly, where the shared folder is missing.
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "tests/system/hands_acceptance.h"
#include "tests/system/table.h"

namespace trocar::test::shared_data_test {
namespace {

class SharedFolder : public HandsTest {
 protected:
  void SetUp() override {
    const char* elsewhere = std::getenv("TROCAR_SHARED");
    shared_ = std::filesystem::absolute(elsewhere != nullptr ? elsewhere : TROCAR_SOURCE_DIR "/../shared");
    if (std::filesystem::is_directory(shared_)) return;
    std::cerr << "SKIPPED: no shared data at " << shared_ << "; the program was NOT tested on them\n";
    GTEST_SKIP() << "no shared data at " << shared_;
  }

  std::filesystem::path shared_;
};

TEST_F(SharedFolder, EvaluationAgreesWithEveryColumnOfTheReference) {
  const auto file = shared_ / "reference" / "device_vectors.csv";
  const Table expected = read_table(file);
  ASSERT_EQ(expected.rows.size(), 100u);
  ASSERT_EQ(trocar({"device", "eval", "--csv", file.string(), "--out", "o.csv"}).exit_code, 0);
  const Table found = read_table(folder_ / "o.csv");
  ASSERT_EQ(found.rows.size(), expected.rows.size());
  ASSERT_EQ(expected.columns.size(), 49u);
  for (std::size_t column = 0; column < expected.columns.size(); ++column) {
    const std::size_t other = found.at(expected.columns[column]);
    for (std::size_t row = 0; row < expected.rows.size(); ++row) {
      EXPECT_NEAR(found.rows[row][other], expected.rows[row][column], 1e-9)
          << expected.columns[column] << ", row " << row;
    }
  }
}

TEST_F(SharedFolder, ALiverFromCtIsSoundAndSkillShowsOnIt) {
  const auto mask = shared_ / "data" / "ct_abdomen_totalseg" / "masks_v1" / "liver.nii.gz";
  const Json organ = json_of({"organ", "import", mask.string(), "-o", "liver", "--json"}, 0);
  EXPECT_EQ(organ["closed"], true);
  EXPECT_EQ(organ["manifold"], true);
  EXPECT_EQ(organ["self_intersections"], 0);
  EXPECT_NEAR(organ["volume_ml"].get<double>(), 1123.3, 0.01 * 1123.3);
  expect_skill_to_show("liver.organ.toml");
}

/// Upright its lower pole's hump lies under the shaft: of 13 tasks an expert could do 3.
TEST_F(SharedFolder, ASpleenFromCtHasRoomForTheWholeInstrument) {
  const auto mask = shared_ / "data" / "ct_abdomen_totalseg" / "masks_v1" / "spleen.nii.gz";
  json_of({"organ", "import", mask.string(), "--name", "spleen", "--triangles", "3000", "-o", "spleen", "--json"}, 0);
  const Json proofs = json_of({"check", "E02", "--organ", "spleen.organ.toml", "--unseen", "0", "--json"}, 0);
  ASSERT_EQ(proofs.size(), 4U);
  for (const Json& proof : proofs) {
    EXPECT_EQ(proof["sound"], true) << proof["why"];
    EXPECT_GE(proof["worst"]["shaft_gap_m"].get<double>(), 0.0015) << proof["level"];
  }
  // Not L3: its 0.3 N lie within the arm's own friction on this spleen's steep sides, and the expert holds them by
  // luck.
  const Json run = json_of(
      {"run", "E02", "--hand", "expert", "--level", "L1", "--organ", "spleen.organ.toml", "--db", ":memory:", "--json"},
      0);
  EXPECT_EQ(run["status"], "completed");
  EXPECT_EQ(run["passed"], true) << run["score"];
}

}  // namespace
}  // namespace trocar::test::shared_data_test
