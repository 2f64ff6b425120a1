// The shipped exercise loads; every mistake in a file is refused at its place and by its name.
#include "scenarios/files/exercise_loader.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "scenarios/files/strict_toml.h"
#include "tests/scenarios/support/bad_exercise.h"

namespace trocar::exercise_loader_test {
namespace {

using test::refusal;

const std::filesystem::path kExercises = std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises";

std::string shipped_text() { return read_text_file((kExercises / "surface-touch.toml").string()); }

std::string edited(const std::string& from, const std::string& to) { return test::edited(shipped_text(), from, to); }

TEST(ExerciseLoader, ReadsTheShippedExercise) {
  const Exercise e = load_exercise(kExercises / "surface-touch.toml");
  EXPECT_EQ(e.id, "surface-touch");
  EXPECT_EQ(e.number, "E02");
  EXPECT_EQ(e.layout.count, 12);
  EXPECT_DOUBLE_EQ(e.layout.radius_m, 0.003);
  EXPECT_DOUBLE_EQ(e.layout.region_x_m, 0.100);
  EXPECT_DOUBLE_EQ(e.layout.region_y_m, 0.080);
  EXPECT_DOUBLE_EQ(e.layout.relief_m, 0.020);
  EXPECT_DOUBLE_EQ(e.surface.stiffness_n_per_m, 150);
  EXPECT_DOUBLE_EQ(e.hard_force_n, 1.5);
  EXPECT_DOUBLE_EQ(e.critical_force_n, 4.7);
  EXPECT_DOUBLE_EQ(e.time_limit_s, 120);
  EXPECT_DOUBLE_EQ(e.hold_s, 1.0);
  EXPECT_DOUBLE_EQ(e.grip.low_n, 0.73);
  EXPECT_DOUBLE_EQ(e.grip.excess_n, 2.5);
  ASSERT_EQ(e.levels.size(), 4u);
  EXPECT_EQ(e.levels[0].mapping, Mapping::kDirect);
  EXPECT_DOUBLE_EQ(e.levels[0].band_low_n, 0.4);
  EXPECT_DOUBLE_EQ(e.levels[0].band_high_n, 0.8);
  EXPECT_DOUBLE_EQ(e.levels[0].force_scale, 0.82);
}

TEST(ExerciseLoader, NamesItsInstrumentsOrSaysWhetherItIsAGrasper) {
  using enum InstrumentKind;
  const auto with = [](const std::string& line) { return edited("hold_s = 1.0", "hold_s = 1.0\n" + line); };
  const auto of = [](const std::string& text) { return parse_exercise(text, "tools.toml").instruments; };
  EXPECT_EQ(of(shipped_text()), std::vector{kProbe});
  EXPECT_EQ(of(with("jaws = true")), std::vector{kGrasper}) << "as older files say it";
  EXPECT_EQ(load_exercise(kExercises / "limited-grasp.toml").instruments, std::vector{kGrasper}) << "its kind takes it";
  EXPECT_EQ(of(with("instruments = [\"hook\", \"clip-applier\", \"probe\"]")),
            (std::vector{kHook, kClipApplier, kProbe}));
  EXPECT_EQ(load_exercise(kExercises / "ungraded/free-play.toml").instruments,
            (std::vector{kGrasper, kScissors, kHook, kClipApplier, kSuction}));

  const auto line_of = [](const std::string& text, const std::string& what) {
    return std::to_string(std::count(text.begin(), text.begin() + static_cast<long>(text.find(what)), '\n') + 1);
  };
  const std::string wrong = with("instruments = [\"hook\", \"scissor\"]");
  EXPECT_NE(refusal(wrong).find(":" + line_of(wrong, "scissor") + ":24: "), std::string::npos) << refusal(wrong);
  EXPECT_NE(refusal(wrong).find("did you mean 'scissors'?"), std::string::npos) << refusal(wrong);
  for (const char* bad : {"instruments = []", "instruments = \"hook\"", "instruments = [1]"})
    EXPECT_NE(refusal(with(bad)).find("'instruments'"), std::string::npos) << bad;
  std::string many = "instruments = [\"hook\"";
  for (std::size_t n = 0; n < kMostInstruments; ++n) many += ", \"hook\"";
  EXPECT_NE(refusal(with(many + "]")).find("1 to 16 names"), std::string::npos);
  EXPECT_NE(refusal(with("jaws = false\ninstruments = [\"hook\"]")).find("must not stand beside"), std::string::npos);
}

TEST(ExerciseLoader, FrictionOfTheSurfaceIsOptional) {
  EXPECT_EQ(load_exercise(kExercises / "surface-touch.toml").surface.mu_static, 0);
  const std::string with =
      edited("damping_s_per_m = 0.5", "damping_s_per_m = 0.5\nfriction_static = 0.1\nfriction_dynamic = 0.05");
  const Exercise e = parse_exercise(with, "rough.toml");
  EXPECT_DOUBLE_EQ(e.surface.mu_static, 0.1);
  EXPECT_DOUBLE_EQ(e.surface.mu_dynamic, 0.05);
}

TEST(ExerciseLoader, ReadsThePortOfAFulcrumLevelAndRefusesOneThatCannotServe) {
  const std::string from = "mapping = \"direct\"", fulcrum = "mapping = \"fulcrum\"\nport_mm = ";
  const ExerciseLevel usual = parse_exercise(edited(from, fulcrum + "[30, -60, 120]"), "f.toml").levels[0];
  EXPECT_EQ(usual.mapping, Mapping::kFulcrum);
  EXPECT_LT((usual.port_m - Vec3(0.030, -0.060, 0.120)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(usual.instrument_length_m, 0.300);
  const std::string own = edited(from, fulcrum + "[10, -20, 100]\ninstrument_mm = 280");
  EXPECT_DOUBLE_EQ(parse_exercise(own, "f.toml").levels[0].instrument_length_m, 0.280);
  EXPECT_NE(refusal(edited(from, fulcrum + "[0, 0, 190]\ninstrument_mm = 200")).find("too short"), std::string::npos);
  EXPECT_NE(refusal(edited(from, from + "\ninstrument_mm = 280")).find("instrument_mm"), std::string::npos)
      << "a length without a fulcrum is a mistake";
}

TEST(ExerciseLoader, ReadsTheRubricWithTimesInUnitsOfTheExpert) {
  const Exercise e = load_exercise(kExercises / "surface-touch.toml");
  ASSERT_EQ(e.rubric.subscores.size(), 5u);
  const SubscoreRule& time = e.rubric.subscores[0];
  EXPECT_EQ(time.metric, "time_s");
  EXPECT_NEAR(time.zero_at / time.full_at, 3.0 / 0.7, 1e-12);
  double sum = 0;
  int gates = 0;
  for (const SubscoreRule& rule : e.rubric.subscores) {
    sum += rule.weight;
    gates += rule.gate;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_EQ(gates, 2);
}

TEST(ExerciseLoader, HashesTheBytesOfTheFile) {
  const Exercise one = parse_exercise(shipped_text(), "a.toml"), same = parse_exercise(shipped_text(), "b.toml");
  const Exercise other = parse_exercise(shipped_text() + "\n", "a.toml");
  EXPECT_EQ(one.rubric.sha256.size(), 64u);
  EXPECT_EQ(one.rubric.sha256, same.rubric.sha256);
  EXPECT_NE(one.rubric.sha256, other.rubric.sha256);
  EXPECT_EQ(one.text, shipped_text());
}

TEST(ExerciseLoader, RefusesASlipOfThePenAtItsLineAndColumn) {
  const std::string message = refusal(edited("hold_s = 1.0  ", "hodl_s = 1.0  "));
  EXPECT_EQ(message.rfind("bad.toml:11:1: ", 0), 0u) << message;
  EXPECT_NE(message.find("'hodl_s'"), std::string::npos) << message;
  EXPECT_NE(message.find("did you mean 'hold_s'?"), std::string::npos) << message;
}

TEST(ExerciseLoader, RefusesUnknownAndMissingKeys) {
  EXPECT_NE(refusal(edited("[surface]", "[surface]\ncolour = 3")).find("unknown key 'colour'"), std::string::npos);
  EXPECT_NE(refusal(edited("soft_n = 0.9", "")).find("missing key 'soft_n'"), std::string::npos);
  EXPECT_NE(refusal(edited("[grip]", "[gripp]")).find("did you mean 'grip'?"), std::string::npos);
}

struct BadValue {
  const char* from;
  const char* to;
  const char* message;
};

class ExerciseLoaderRefuses : public testing::TestWithParam<BadValue> {};

TEST_P(ExerciseLoaderRefuses, NamingThePlaceAndTheKey) {
  const std::string message = refusal(edited(GetParam().from, GetParam().to));
  EXPECT_NE(message.find(GetParam().message), std::string::npos) << message;
  EXPECT_EQ(message.rfind("bad.toml:", 0), 0u) << message;
}

INSTANTIATE_TEST_SUITE_P(
    BadValues, ExerciseLoaderRefuses,
    testing::Values(BadValue{"hard_n = 1.5", "hard_n = \"1.5\"", "'hard_n' must be a number"},
                    BadValue{"hard_n = 1.5", "hard_n = nan", "'hard_n' must be finite"},
                    BadValue{"hard_n = 1.5", "hard_n = inf", "'hard_n' must be finite"},
                    BadValue{"hard_n = 1.5", "hard_n = -1", "'hard_n' = -1 is out of range"},
                    BadValue{"hard_n = 1.5", "hard_n = 0.5", "'hard_n' must not be below 'soft_n'"},
                    BadValue{"critical_n = 4.7", "critical_n = 1.2", "'critical_n' must be above 'hard_n'"},
                    BadValue{"count = 12", "count = 12.5", "'count' must be a whole number"},
                    BadValue{"count = 12", "count = -1", "'count' = -1 is out of range"},
                    BadValue{"count = 12", "count = 33", "'count' = 33 is out of range"},
                    BadValue{"region_mm = [100, 80]", "region_mm = [100]", "'region_mm' must be an array of 2 numbers"},
                    BadValue{"region_mm = [100, 80]", "region_mm = [100, nan]", "'region_mm' must be finite"},
                    BadValue{"min_spacing_mm = 14", "min_spacing_mm = 5", "lets discs overlap"},
                    BadValue{"band_n = [0.4, 0.8]", "band_n = [0.8, 0.4]", "'band_n' must be [low, high]"},
                    BadValue{"band_n = [0.4, 0.8]", "band_n = [0.4, 1.8]", "'band_n' reaches above 'hard_n'"},
                    BadValue{"damping_s_per_m = 0.5",
                             "damping_s_per_m = 0.5\nfriction_static = 0.1\nfriction_dynamic = 0.2",
                             "'friction_dynamic' must not be above 'friction_static'"},
                    BadValue{"mapping = \"direct\"", "mapping = \"diret\"", "did you mean 'direct'?"},
                    BadValue{"force_scale = 0.82", "force_scale = \"max\"", "must be a number or \"auto\""},
                    BadValue{"metric = \"wrong_places\"", "metric = \"wrong_place\"", "did you mean 'wrong_places'?"},
                    BadValue{"weight = 0.35", "weight = 0.36", "not to 1"},
                    BadValue{"expert_time_s = 37.5", "", "needs 'expert_time_s'"},
                    BadValue{"full_at = 0\nzero_at = 6", "full_at = 6\nzero_at = 6", "'full_at' equals 'zero_at'"},
                    BadValue{"gate = true", "gate = 1", "'gate' must be true or false"},
                    BadValue{"id = \"surface-touch\"", "id = \"\"", "'id' must not be empty"},
                    BadValue{"block_thickness_mm = 8", "block_thickness_mm = 2", "too thin"},
                    BadValue{"[[levels]]", "[levels]", "cannot redefine existing table 'levels'"},
                    BadValue{"time_limit_s = 120", "time_limit_s = ", "bad.toml:10:"}));

TEST(ExerciseLoader, RefusesALevelThatStandsTwice) {
  const std::string level =
      "[[levels]]\nname = \"L1\"\nmapping = \"direct\"\nmotion_scale = 1\nforce_scale = 1\n"
      "band_n = [0.4, 0.8]\nforce_display = \"always\"\n\n";
  EXPECT_NE(refusal(edited("[rubric]", level + "[rubric]")).find("stands twice"), std::string::npos);
}

TEST(ExerciseLoader, FindsByIdNumberAndPath) {
  EXPECT_EQ(find_exercise("surface-touch", kExercises).number, "E02");
  EXPECT_EQ(find_exercise("E02", kExercises).id, "surface-touch");
  EXPECT_EQ(find_exercise((kExercises / "surface-touch.toml").string(), "/nowhere").id, "surface-touch");
  for (const char* word : {"e02", "2", "02", "Surface-Touch", "SURFACE-TOUCH"})
    EXPECT_EQ(find_exercise(word, kExercises).number, "E02") << word;
  for (const char* word : {"", "0", "22", "E", "E2x", "2.0", "-2", "99999999999"})
    EXPECT_THROW(find_exercise(word, kExercises), InputError) << word;
  EXPECT_EQ(list_exercises(kExercises).front().id, "reach-and-orient");
}

TEST(ExerciseLoader, ListsWhatItKnowsWhenAskedForSomethingElse) {
  try {
    find_exercise("surface-tuch", kExercises);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("known are E01 reach-and-orient, E02 surface-touch, E03"),
              std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("did you mean 'surface-touch'?"), std::string::npos) << error.what();
  }
  EXPECT_THROW(find_exercise("x", kExercises / "missing"), InputError);
  EXPECT_THROW(load_exercise(kExercises / "missing.toml"), InputError);
}

TEST(ExerciseLoader, ListsLevels) {
  const Exercise e = load_exercise(kExercises / "surface-touch.toml");
  EXPECT_EQ(find_level(e, "L1").name, "L1");
  try {
    find_level(e, "L9");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'L9': known are L1"), std::string::npos) << error.what();
  }
}

TEST(NearestWord, OffersOnlyWhatIsNear) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(nearest_word("expret", {"expert", "novice"}), "expert");
  EXPECT_EQ(nearest_word("zebra", {"expert", "novice"}), "");
}

}  // namespace
}  // namespace trocar::exercise_loader_test
