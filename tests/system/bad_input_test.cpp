// Bad input: exit code 2 and a message that names the file and the place in it.
#include "tests/system/system_fixture.h"
#include "tests/tissue/support/nifti_fixture.h"

namespace trocar::test::bad_input_test {
namespace {

class BadInput : public SystemTest {
 protected:
  /// A label map of a cuboid marked 5.
  std::string small_map() const {
    NiftiFixture map({12, 12, 12});
    for (int k = 3; k < 9; ++k)
      for (int j = 3; j < 9; ++j)
        for (int i = 3; i < 9; ++i) map.at(i, j, k) = 5;
    return map.bytes();
  }
};

constexpr const char* kTetrahedron =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0\n100 0 0\n0 100 0\n0 0 100\n3 0 2 1\n3 0 1 3\n3 0 3 "
    "2\n3 1 2 3\n";

TEST_F(BadInput, MissingFilesAreNamed) {
  expect_refusal({"run", "nowhere.toml", "--hand", dip(), "--db", ":memory:"}, 2, "nowhere.toml");
  expect_refusal({"run", exercise_of(3, 12), "--hand", "nobody.toml", "--db", ":memory:"}, 2, "nobody.toml");
  expect_refusal(short_run({"--organ", "nowhere.organ.toml", "--db", ":memory:"}), 2, "nowhere.organ.toml");
  expect_refusal({"organ", "import", "nowhere.nii.gz", "-o", "x"}, 2, "nowhere.nii.gz: no such file");
  expect_refusal({"organ", "import", "nowhere.ply", "--unit", "mm", "-o", "x"}, 2, "nowhere.ply");
  expect_refusal({"organ", "info", "nowhere.organ.toml"}, 2, "nowhere.organ.toml");
  expect_refusal({"score", "nowhere.trec"}, 2, "nowhere.trec: no such recording");
  expect_refusal({"replay", "nowhere.trec"}, 2, "nowhere.trec: no such recording");
  expect_refusal({"device", "eval", "--csv", "nowhere.csv", "--out", "o.csv"}, 2, "nowhere.csv");
  expect_refusal({"check", "nowhere.toml"}, 2, "nowhere.toml");
}

TEST_F(BadInput, UnknownNamesComeWithTheKnownOnes) {
  const std::string exercise = exercise_of(3, 12), hand = dip();
  expect_refusal({"run", "juggling", "--hand", hand, "--db", ":memory:"}, 2,
                 "unknown exercise 'juggling': known are E01 reach-and-orient, E02 surface-touch, E03 limited-grasp");
  expect_refusal({"run", exercise, "--hand", "octopus", "--db", ":memory:"}, 2,
                 "unknown hand 'octopus': known are clumsy, clutch-cheat");
  expect_refusal(
      short_run({"--organ", "heart-of-gold", "--db", ":memory:"}), 2,
      "heart-of-gold: neither a file nor an organ that ships (phantom-abdomen, phantom-gallbladder, phantom-liver)");
  expect_refusal(short_run({"--level", "L9", "--db", ":memory:"}), 2, "no level 'L9': known are L1");
  expect_refusal(short_run({"--inject", "gremlin@3", "--db", ":memory:"}), 2,
                 "known are beam-dark, beam-lit, channel-invalid");
  expect_refusal(short_run({"--inject", "encoder-jump:7@3", "--db", ":memory:"}), 2, "channels are 0 to 6");
}

TEST_F(BadInput, ExerciseErrorsCarryLineAndColumn) {
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& message) {
    folder_.write("bad.toml", replaced(shipped_exercise(), from, to));
    expect_refusal({"run", "bad.toml", "--hand", dip(), "--db", ":memory:"}, 2, message);
  };
  const std::string text = shipped_exercise();
  const auto line = std::to_string(
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find("time_limit_s")), '\n'));
  refused("time_limit_s", "time_limits",
          "bad.toml:" + line + ":1: unknown key 'time_limits': did you mean 'time_limit_s'?");
  refused("time_limit_s = 120", "time_limit_s = nan", "bad.toml:" + line + ":16: 'time_limit_s' must be finite");
  refused("time_limit_s = 120", "time_limit_s = \"soon\"", "bad.toml:" + line + ":16:");
  refused("time_limit_s = 120", "time_limit_s = ", "bad.toml:" + line + ":");
}

TEST_F(BadInput, AScriptThatIsNotFiniteOrMisspelledIsRefusedAtItsPlace) {
  folder_.write("nan.toml", replaced(kDip, "[0, 0, -6]", "[0, nan, -6]"));
  expect_refusal({"run", exercise_of(3, 12), "--hand", "nan.toml", "--db", ":memory:"}, 2, "nan.toml:4:");
  folder_.write("typo.toml", replaced(kDip, "seconds", "secnods"));
  expect_refusal({"run", exercise_of(3, 12), "--hand", "typo.toml", "--db", ":memory:"}, 2,
                 "typo.toml:6:1: unknown key 'secnods': did you mean 'seconds'?");
}

TEST_F(BadInput, ARefusedRunStoresNothing) {
  folder_.write("typo.toml", replaced(kDip, "seconds", "secnods"));
  expect_refusal({"run", exercise_of(3, 12), "--hand", "typo.toml", "--db", "never.db"}, 2, "typo.toml");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "never.db"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "data"));
}

TEST_F(BadInput, ATruncatedImageIsRefusedAndLeavesNoOrgan) {
  const std::string whole = small_map();
  folder_.write("whole.nii", whole);
  EXPECT_EQ(trocar({"organ", "import", "whole.nii", "--material", "liver", "-o", "whole"}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "whole.organ.toml"));
  for (const std::size_t kept : {whole.size() - 1, std::size_t{500}, std::size_t{300}, std::size_t{0}}) {
    folder_.write("cut.nii", whole.substr(0, kept));
    expect_refusal({"organ", "import", "cut.nii", "-o", "cut"}, 2, "cut.nii");
  }
  const std::string packed = file_bytes(TROCAR_SOURCE_DIR "/assets/organs/phantom-liver.ply").substr(0, 4000);
  folder_.write("cut.nii.gz", "\x1f\x8b" + packed);
  expect_refusal({"organ", "import", "cut.nii.gz", "-o", "cut"}, 2, "cut.nii.gz");
  folder_.write("cut.ply", packed);
  expect_refusal({"organ", "import", "cut.ply", "--unit", "m", "-o", "cut"}, 2, "cut.ply");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cut.organ.toml"));
}

TEST_F(BadInput, ALabelWithoutVoxelsIsRefused) {
  folder_.write("map.nii", small_map());
  expect_refusal({"organ", "import", "map.nii", "--label", "7", "-o", "x"}, 2, "label 7 marks no voxel; it holds 5");
  expect_refusal({"organ", "import", "map.nii", "--label", "spleen", "-o", "x"}, 2,
                 "\"spleen\": the file gives no such name; say which table");
  expect_refusal({"organ", "import", "map.nii", "--label", "flux capacitor", "-o", "x"}, 2, "--label flux capacitor");
  folder_.write("blank.nii", NiftiFixture({12, 12, 12}).bytes());
  expect_refusal({"organ", "import", "blank.nii", "-o", "x"}, 2, "blank.nii");
}

TEST_F(BadInput, ASurfaceWithoutAUnitIsRefusedWithAGuess) {
  folder_.write("tetrahedron.ply", kTetrahedron);
  expect_refusal({"organ", "import", "tetrahedron.ply", "-o", "x"}, 2,
                 "tetrahedron.ply: PLY carries no unit, say --unit mm, cm, m or um");
  expect_refusal({"organ", "import", "tetrahedron.ply", "--unit", "furlong", "-o", "x"}, 2, "furlong");
  // A tetrahedron is no organ: remeshed so that it does not cut itself it loses its ends. What is told to do keeps
  // them.
  expect_refusal({"organ", "import", "tetrahedron.ply", "--unit", "mm", "--triangles", "1000", "-o", "x", "--json"}, 2,
                 "78.3 mm long where it should be 100.0: where ends and edges are sharp, --wrap keeps more");
  const Json organ = json_of(
      {"organ", "import", "tetrahedron.ply", "--unit", "mm", "--wrap", "--triangles", "1000", "-o", "x", "--json"}, 0);
  EXPECT_EQ(organ["self_intersections"], 0);
  EXPECT_NEAR(organ["volume_ml"].get<double>(), 1000.0 / 6, 1.7);
}

}  // namespace
}  // namespace trocar::test::bad_input_test
