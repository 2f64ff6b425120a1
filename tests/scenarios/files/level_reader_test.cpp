// Levels: what they inherit, what they override, what each kind of exercise asks of them, and every refusal at its
// place.
#include "scenarios/files/level_reader.h"

#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/scenarios/support/bad_exercise.h"

namespace trocar::level_reader_test {
namespace {

using test::refusal;

std::string shipped_text() {
  return read_text_file(std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises/surface-touch.toml");
}

/// The shipped exercise with these levels instead of its own.
std::string with_levels(const std::string& levels) {
  std::string text = shipped_text();
  const auto from = text.find("[[levels]]"), to = text.find("[rubric]");
  return text.replace(from, to - from, levels + "\n");
}

const std::string kFirst =
    "[[levels]]\nname = \"L1\"\nmapping = \"direct\"\nmotion_scale = 1.0\nforce_scale = \"auto\"\n"
    "band_n = [0.4, 0.8]\nforce_display = \"always\"\nexpert_time_s = 40\n";

std::string level(const std::string& name, const std::string& keys) {
  return kFirst + "[[levels]]\nname = \"" + name + "\"\nlike = \"L1\"\n" + keys;
}

TEST(Levels, TakeOverWhatTheyDoNotName) {
  const Exercise e = parse_exercise(with_levels(level("L2", "band_n = [0.5, 0.7]\nforce_display = \"band\"\n")), "a");
  ASSERT_EQ(e.levels.size(), 2u);
  EXPECT_EQ(e.levels[1].name, "L2");
  EXPECT_EQ(e.levels[1].force_display, "band");
  EXPECT_EQ(e.levels[1].bands, (std::vector<WantedForce>{{0.5, 0.7}}));
  EXPECT_DOUBLE_EQ(e.levels[1].band_high_n, 0.7);
  EXPECT_DOUBLE_EQ(e.levels[1].motion_scale, 1);
  EXPECT_LT(e.levels[1].force_scale, 0);
  EXPECT_DOUBLE_EQ(e.levels[1].time_limit_s, 120);
  EXPECT_DOUBLE_EQ(e.levels[0].band_low_n, 0.4) << "the first keeps its own";
}

TEST(Levels, OverrideMappingScaleTimeAndGuides) {
  const Exercise e = parse_exercise(
      with_levels(level("L3",
                        "mapping = \"fulcrum\"\nport_mm = [10, 0, 120]\nmotion_scale = 2\nforce_scale = 0.5\n"
                        "time_limit_s = 200\nguides = false\n")),
      "a");
  const ExerciseLevel& l = e.levels[1];
  EXPECT_EQ(l.mapping, Mapping::kFulcrum);
  EXPECT_TRUE(l.port_m.isApprox(Vec3(0.010, 0, 0.120), 1e-12));
  EXPECT_DOUBLE_EQ(l.motion_scale, 2);
  EXPECT_DOUBLE_EQ(l.force_scale, 0.5);
  EXPECT_DOUBLE_EQ(l.time_limit_s, 200);
  EXPECT_FALSE(l.guides);
  EXPECT_TRUE(e.levels[0].guides);
}

TEST(Levels, ChainOneLikeAnother) {
  const std::string third = "mapping = \"fulcrum\"\nport_mm = [0, 0, 120]\nforce_display = \"after\"\n";
  const Exercise e =
      parse_exercise(with_levels(level("L3", third) + "[[levels]]\nname = \"exam\"\nlike = \"L3\"\n"), "a");
  ASSERT_EQ(e.levels.size(), 3u);
  EXPECT_TRUE(e.levels[2].exam);
  EXPECT_FALSE(e.levels[1].exam);
  EXPECT_EQ(e.levels[2].mapping, Mapping::kFulcrum);
  EXPECT_TRUE(e.levels[2].port_m.isApprox(e.levels[1].port_m));
}

TEST(Levels, DropThePortWhenTheyTurnBackToDirect) {
  const Exercise e = parse_exercise(with_levels(level("L2", "mapping = \"fulcrum\"\nport_mm = [0, 0, 120]\n") +
                                                "[[levels]]\nname = \"L3\"\nlike = \"L2\"\nmapping = \"direct\"\n"),
                                    "a");
  EXPECT_EQ(e.levels[2].mapping, Mapping::kDirect);
  EXPECT_EQ(e.levels[2].port_m, Vec3::Zero());
}

TEST(Levels, MayAskForSeveralForces) {
  const Exercise e =
      parse_exercise(with_levels(level("L3", "bands_n = [[0.45, 0.75], [0.2, 0.4], [0.8, 1.2]]\n")), "a");
  ASSERT_EQ(e.levels[1].bands.size(), 3u);
  EXPECT_DOUBLE_EQ(e.levels[1].bands[1].low_n, 0.2);
  EXPECT_DOUBLE_EQ(e.levels[1].band_low_n, 0.2) << "the lowest";
  EXPECT_DOUBLE_EQ(e.levels[1].band_high_n, 1.2) << "the highest";
}

TEST(Levels, HaveTimeAnchorsOfTheirOwn) {
  const Exercise e = parse_exercise(with_levels(level("L2", "expert_time_s = 60\n")), "a");
  EXPECT_NEAR(e.levels[0].rubric.subscores[0].full_at, 0.7 * 40, 1e-9);
  EXPECT_NEAR(e.levels[1].rubric.subscores[0].full_at, 0.7 * 60, 1e-9);
  EXPECT_NEAR(e.levels[1].rubric.subscores[0].zero_at, 3 * 60, 1e-9);
  EXPECT_EQ(e.levels[0].rubric.sha256, e.levels[1].rubric.sha256) << "one file, one version";
}

TEST(Levels, MayAnchorASubscoreElsewhere) {
  const std::string anchors = "[[levels.anchors]]\nsubscore = \"force in band\"\nfull_at = 0.9\nzero_at = 0.2\n";
  const Exercise e =
      parse_exercise(with_levels(level("L2", anchors) + "[[levels]]\nname = \"L3\"\nlike = \"L2\"\n"), "a");
  EXPECT_DOUBLE_EQ(e.levels[0].rubric.subscores[2].full_at, 1.0);
  EXPECT_DOUBLE_EQ(e.levels[1].rubric.subscores[2].full_at, 0.9);
  EXPECT_DOUBLE_EQ(e.levels[1].rubric.subscores[2].zero_at, 0.2);
  EXPECT_DOUBLE_EQ(e.levels[2].rubric.subscores[2].full_at, 0.9) << "L3 is like L2";
  EXPECT_DOUBLE_EQ(e.levels[1].rubric.subscores[1].zero_at, e.levels[0].rubric.subscores[1].zero_at);
  const std::string same = "[[levels.anchors]]\nsubscore = \"place\"\nfull_at = 1\nzero_at = 1\n";
  EXPECT_NE(refusal(with_levels(level("L2", same))).find("equals"), std::string::npos);
  const std::string wrong = "[[levels.anchors]]\nsubscore = \"plaec\"\nfull_at = 1\nzero_at = 2\n";
  EXPECT_NE(refusal(with_levels(level("L2", wrong))).find("did you mean 'place'?"), std::string::npos);
}

TEST(Levels, MeasureAnchorsInTolerances) {
  const Exercise e = find_exercise("reach-and-orient", std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises");
  const auto rule = [&](const char* level_name, std::size_t index) {
    return find_level(e, level_name).rubric.subscores[index];
  };
  EXPECT_NEAR(rule("L1", 2).full_at, 0.001, 1e-5);
  EXPECT_NEAR(rule("L1", 2).zero_at, 0.005, 1e-5);
  EXPECT_NEAR(rule("L1", 3).full_at, 2, 1e-9);
  EXPECT_NEAR(rule("L1", 3).zero_at, 15, 1e-9);
  EXPECT_NEAR(rule("L3", 2).full_at, 0.0005, 1e-5) << "half the tolerance, half the anchor";
  EXPECT_NEAR(rule("L3", 3).zero_at, 7.5, 1e-9);
  EXPECT_NE(refusal(with_levels(kFirst) + "full_at_angle_tolerances = 1\n").find("exclude each other"),
            std::string::npos);
}

struct BadLevel {
  const char* keys;
  const char* message;
};

class LevelsRefuse : public testing::TestWithParam<BadLevel> {};

TEST_P(LevelsRefuse, NamingThePlace) {
  const std::string message = refusal(with_levels(level("L2", GetParam().keys)));
  EXPECT_NE(message.find(GetParam().message), std::string::npos) << message;
  EXPECT_EQ(message.rfind("bad.toml:", 0), 0u) << message;
  EXPECT_TRUE(std::isdigit(message[9])) << message;
}

INSTANTIATE_TEST_SUITE_P(
    BadLevels, LevelsRefuse,
    testing::Values(BadLevel{"mapping = \"fulcrum\"\n", "missing key 'port_mm'"},
                    BadLevel{"port_mm = [0, 0, 120]\n", "'port_mm' needs mapping"},
                    BadLevel{"mapping = \"fulcrum\"\nport_mm = [0, 0, 5]\n", "at least 20 mm above"},
                    BadLevel{"mapping = \"fulcrum\"\nport_mm = [0, 120]\n", "must be an array of 3 numbers"},
                    BadLevel{"motion_scale = 0\n", "'motion_scale' = 0 is out of range"},
                    BadLevel{"force_scale = 2\n", "'force_scale' = 2 is out of range"},
                    BadLevel{"force_display = \"never\"\n", "known are always, band, after"},
                    BadLevel{"guides = 1\n", "'guides' must be true or false"},
                    BadLevel{"band_n = [0.5, 0.7]\nbands_n = [[0.2, 0.3]]\n", "exclude each other"},
                    BadLevel{"bands_n = [[0.2, 0.3], [0.5]]\n", "must hold pairs"},
                    BadLevel{"bands_n = [[0.3, 0.2]]\n", "low below high"},
                    BadLevel{"bands_n = []\n", "must be an array of [low, high] pairs"},
                    BadLevel{"bands_n = [[0.3, 2.0]]\n", "'bands_n' reaches above 'hard_n'"},
                    BadLevel{"expert_time_s = 0\n", "'expert_time_s' = 0 is out of range"},
                    BadLevel{"time_limit_s = -5\n", "'time_limit_s' = -5 is out of range"},
                    BadLevel{"position_tolerance_mm = 3\n", "unknown key 'position_tolerance_mm'"},
                    BadLevel{"band = [0.5, 0.7]\n", "did you mean 'band_n'?"}));

TEST(Levels, RefuseNamesAndModelsThatAreNotThere) {
  EXPECT_NE(refusal(with_levels(level("L7", ""))).find("known are L1, L2, L3, exam"), std::string::npos);
  const std::string later = "[[levels]]\nname = \"L2\"\nlike = \"L3\"\n";
  const std::string text = with_levels(kFirst + later);
  const auto line = std::count(text.begin(), text.begin() + static_cast<long>(text.find("like = \"L3\"")), '\n') + 1;
  const std::string wanted = "bad.toml:" + std::to_string(line) + ":8: 'like' is \"L3\": known are L1";
  EXPECT_NE(refusal(text).find(wanted), std::string::npos) << refusal(text);
  EXPECT_NE(refusal(with_levels(later)).find("this is the first"), std::string::npos);
}

TEST(Levels, AnExamShowsNoForce) {
  EXPECT_NE(refusal(with_levels(level("exam", ""))).find("must be \"after\""), std::string::npos);
  EXPECT_EQ(refusal(with_levels(level("exam", "force_display = \"after\"\n"))), "accepted");
}

}  // namespace
}  // namespace trocar::level_reader_test
