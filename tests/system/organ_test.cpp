// Organs from outside: the phantom is drawn, imported and practised on.
#include "tests/system/hands_acceptance.h"

namespace trocar::test::organ_test {
namespace {

namespace fs = std::filesystem;

using OrganCommands = HandsTest;

TEST_F(OrganCommands, PhantomThenImportComesRound) {
  const Json phantom = json_of({"organ", "phantom", "--out", "ct", "--json"}, 0);
  EXPECT_EQ(phantom["synthetic"], true);
  const Json organ = json_of({"organ", "import", "ct/ct.nii.gz", "--labels", "ct/labels.nii.gz", "--label", "liver",
                              "--triangles", "3000", "-o", "mine", "--json"},
                             0);
  for (const char* key : {"name",
                          "surface",
                          "vertices",
                          "triangles",
                          "closed",
                          "manifold",
                          "self_intersections",
                          "components",
                          "genus",
                          "volume_ml",
                          "label_volume_ml",
                          "volume_error_pct",
                          "distance_mm",
                          "bbox_m",
                          "cut_at_border",
                          "lost",
                          "repairs",
                          "unit",
                          "frame",
                          "source",
                          "licence"}) {
    EXPECT_TRUE(organ.contains(key)) << key;
  }
  EXPECT_EQ(organ["name"], "liver");
  EXPECT_TRUE(organ["closed"].get<bool>() && organ["manifold"].get<bool>());
  EXPECT_EQ(organ["self_intersections"], 0);
  EXPECT_NEAR(organ["volume_error_pct"].get<double>(), 0, 1);
  EXPECT_NEAR(organ["volume_ml"].get<double>(), phantom["organs"][0]["volume_ml"].get<double>(), 20);
  const Json info = json_of({"organ", "info", "mine.organ.toml", "--json"}, 0);
  for (const char* key : {"name", "triangles", "closed", "manifold", "self_intersections", "genus", "bbox_m"}) {
    EXPECT_EQ(info[key], organ[key]) << key;
  }
  EXPECT_EQ(json_of(short_run({"--organ", "mine.organ.toml", "--db", ":memory:"}), 1)["organ"]["source"],
            "labels.nii.gz");
}

TEST_F(OrganCommands, TheShippedPhantomIsWhatTheCommandDraws) {
  ASSERT_EQ(trocar({"organ", "phantom", "--out", "ct"}).exit_code, 0);
  for (const char* file :
       {"phantom-liver.ply", "phantom-liver.organ.toml", "phantom-gallbladder.ply", "phantom-gallbladder.organ.toml"}) {
    EXPECT_TRUE(file_bytes(folder_ / "ct" / file) == file_bytes(fs::path(TROCAR_SOURCE_DIR) / "assets/organs" / file))
        << file;
  }
}

TEST_F(OrganCommands, ASurfaceThatIsNotTheManifestsIsRefused) {
  for (const char* part : {"phantom-liver.organ.toml", "phantom-liver.ply"}) {
    fs::copy_file(fs::path(TROCAR_SOURCE_DIR) / "assets/organs" / part, folder_ / part);
  }
  std::string bytes = file_bytes(folder_ / "phantom-liver.ply");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  folder_.write("phantom-liver.ply", bytes);
  expect_refusal({"organ", "info", "phantom-liver.organ.toml"}, 2, "phantom-liver.ply");
  expect_refusal(short_run({"--organ", "phantom-liver.organ.toml", "--db", ":memory:"}), 2, "phantom-liver.ply");
}

TEST_F(OrganCommands, SkillShowsOnTheShippedPhantom) { expect_skill_to_show("phantom-liver"); }

}  // namespace
}  // namespace trocar::test::organ_test
