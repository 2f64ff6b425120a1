// Ducts of an exercise file: those of free play, and every mistake in one at its place.
#include "scenarios/files/duct_reader.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "scenarios/files/exercise_loader.h"
#include "tests/scenarios/support/bad_exercise.h"

namespace trocar::duct_reader_test {
namespace {

const std::filesystem::path kExercises = std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises";

std::string free_play() { return read_text_file((kExercises / "ungraded/free-play.toml").string()); }

std::string refused(const std::string& from, const std::string& to) {
  return test::refusal(test::edited(free_play(), from, to));
}

TEST(DuctReader, ReadsThoseOfFreePlayAndNoneWhereNoneAreNamed) {
  const Exercise e = load_exercise(kExercises / "ungraded/free-play.toml");
  ASSERT_EQ(e.ducts.size(), 2U);
  const DuctPlan &duct = e.ducts[0], &artery = e.ducts[1];
  EXPECT_EQ(duct.name, "cystic duct");
  EXPECT_EQ(duct.material, "duct");
  EXPECT_EQ(duct.organ, "liver");
  EXPECT_EQ(duct.content, DuctContent::kBile);
  EXPECT_DOUBLE_EQ(duct.outer_radius_m, 0.0015);
  EXPECT_DOUBLE_EQ(duct.wall_m, 0.0005);
  EXPECT_EQ(duct.ends, (std::array{DuctHold::kOrgan, DuctHold::kFixed}));
  EXPECT_EQ(artery.content, DuctContent::kBlood);
  EXPECT_EQ(artery.ends, (std::array{DuctHold::kFixed, DuctHold::kOrgan}));
  for (const DuctPlan& plan : e.ducts) {
    const double length = (plan.path_m.back() - plan.path_m.front()).norm();
    EXPECT_GT(length, 0.030);
    EXPECT_LT(length, 0.045);
  }
  EXPECT_TRUE(load_exercise(kExercises / "surface-touch.toml").ducts.empty());
}

TEST(DuctReader, NamesTheMistakeAndItsPlace) {
  const auto expect = [](const std::string& from, const std::string& to, const std::string& words) {
    const std::string message = refused(from, to);
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_EQ(message.find("bad.toml:"), 0U) << message;
    EXPECT_NE(message.find_first_of("0123456789"), std::string::npos) << message;
  };
  expect("wall_mm = 0.5", "wall_mm = 1.5", "'wall_mm' must be less than half of 'diameter_mm'");
  expect("wall_mm = 0.5", "walls_mm = 0.5", "wall_mm");
  expect("carries = \"bile\"", "carries = \"milk\"", "carries");
  expect("to = \"bed\"", "to = \"sky\"", "'to'");
  expect("path_mm = [[47, 0, -20], [72, -25, -43]]", "path_mm = [[47, 0, -20]]", "at least 2 points");
  expect("[[47, 0, -20], [72, -25, -43]]", "[[47, 0], [72, -25, -43]]", "must hold points");
  expect("[[47, 0, -20], [72, -25, -43]]", "[[47, 0, -20], [47, 0, -20]]", "1 mm apart");
  expect("[[47, 0, -20], [72, -25, -43]]", "[[47, 0, -20], [47, 5, -20]]", "shorter than 10 mm");
  expect("[[47, 0, -20], [72, -25, -43]]", "[[47, 0, -20], [72, -25, -430]]", "path_mm");
  expect("name = \"cystic artery\"", "name = \"cystic duct\"", "two ducts are called 'cystic duct'");
  expect("organ = \"liver\"\ncarries = \"bile\"", "carries = \"bile\"", "organ");
}

TEST(BedReader, ReadsThatOfFreePlayAndNoneWhereNoneIsNamed) {
  const std::optional<BedPlan> bed = load_exercise(kExercises / "ungraded/free-play.toml").bed;
  ASSERT_TRUE(bed);
  EXPECT_EQ(bed->organ, "liver");
  EXPECT_EQ(bed->neighbour, "gallbladder");
  EXPECT_EQ(bed->material, "filled_gallbladder");
  EXPECT_DOUBLE_EQ(bed->strength_pa, 20e3);
  EXPECT_DOUBLE_EQ(bed->energy_j_per_m2, 40);
  EXPECT_DOUBLE_EQ(bed->reach_m, 0.0035);
  EXPECT_FALSE(load_exercise(kExercises / "surface-touch.toml").bed);
  EXPECT_NE(refused("strength_kpa = 20", "strength_kpa = 0").find("strength_kpa"), std::string::npos);
  EXPECT_NE(refused("gap_mm = 3.5", "gap_mm = 3.5\ngape_mm = 3").find("unknown key 'gape_mm'"), std::string::npos);
  EXPECT_NE(refused("neighbour = \"gallbladder\"", "neighbor = \"gallbladder\"").find("neighbo"), std::string::npos);
}

TEST(SutureReader, ReadsThatOfStitchingAndNamesItsMistakes) {
  const Exercise stitching = load_exercise(kExercises / "ungraded/stitching.toml");
  ASSERT_TRUE(stitching.suture);
  EXPECT_DOUBLE_EQ(stitching.suture->needle_m, 0.026);
  EXPECT_DOUBLE_EQ(stitching.suture->circle, 0.5);
  EXPECT_DOUBLE_EQ(stitching.suture->thread_m, 0.150);
  EXPECT_EQ(stitching.instruments.front(), InstrumentKind::kNeedleDriver);
  EXPECT_FALSE(load_exercise(kExercises / "ungraded/free-play.toml").suture);
  const auto said = [text = stitching.text](const std::string& from, const std::string& to) {
    return test::refusal(test::edited(text, from, to));
  };
  EXPECT_NE(said("needle_mm = 26", "needle_mm = 5").find("'needle_mm'"), std::string::npos);
  EXPECT_NE(said("circle = 0.5", "circel = 0.5").find("circel"), std::string::npos);
  EXPECT_NE(said("thread_mm = 150", "thread_mm = 3000").find("'thread_mm'"), std::string::npos);
  const std::string without = said("\"needle-driver\", ", "");
  EXPECT_NE(without.find("'suture' needs a 'needle-driver'"), std::string::npos) << without;
}

TEST(SheetReader, ReadsThatOfTheFlapAndNamesItsMistakes) {
  const Exercise flap = load_exercise(kExercises / "ungraded/flap.toml");
  ASSERT_EQ(flap.sheets.size(), 1U);
  EXPECT_EQ(flap.sheets[0].organ, "liver");
  EXPECT_NEAR(flap.sheets[0].along_m.norm(), 0.040, 1e-12);
  EXPECT_DOUBLE_EQ(flap.sheets[0].across_m, 0.030);
  EXPECT_DOUBLE_EQ(flap.sheets[0].thickness_m, 0.002);
  EXPECT_TRUE(load_exercise(kExercises / "ungraded/free-play.toml").sheets.empty());
  const auto said = [text = flap.text](const std::string& from, const std::string& to) {
    return test::refusal(test::edited(text, from, to));
  };
  EXPECT_NE(said("across_mm = 30", "across_mm = 0").find("'across_mm'"), std::string::npos);
  EXPECT_NE(said("edge_mm = 3.5", "edge_mm = 1").find("more than 1200 triangles"), std::string::npos);
  EXPECT_NE(said("hinge_to_mm = [-20, 15]", "hinge_to_mm = [20, 16]").find("shorter than 5 mm"), std::string::npos);
  EXPECT_NE(said("thickness_mm = 2", "thickness_mm = 2\nthick_mm = 2").find("unknown key 'thick_mm'"),
            std::string::npos);
}

TEST(LieReader, ReadsThatOfTheGallbladderAndNamesItsMistakes) {
  const Exercise gallbladder = load_exercise(kExercises / "ungraded/gallbladder.toml");
  ASSERT_TRUE(gallbladder.lie);
  EXPECT_EQ(gallbladder.lie->middle, "gallbladder");
  EXPECT_GT(gallbladder.lie->turned_rad.norm(), 1);
  EXPECT_FALSE(load_exercise(kExercises / "ungraded/free-play.toml").lie);
  const auto said = [text = gallbladder.text](const std::string& from, const std::string& to) {
    return test::refusal(test::edited(text, from, to));
  };
  EXPECT_NE(said("turned_deg = [", "turned_deg = [720, ").find("'turned_deg'"), std::string::npos);
  EXPECT_NE(said("middle = \"gallbladder\"", "midle = \"gallbladder\"").find("midle"), std::string::npos);
}

TEST(ExerciseLoader, ReadsHowTheBedBreathesAndNamesItsMistakes) {
  const Breathing breathing = load_exercise(kExercises / "ungraded/free-play.toml").breathing;
  EXPECT_DOUBLE_EQ(breathing.per_min, 14);
  EXPECT_DOUBLE_EQ(breathing.depth_m, 0.004);
  EXPECT_DOUBLE_EQ(breathing.beats_per_min, 70);
  EXPECT_EQ(load_exercise(kExercises / "surface-touch.toml").breathing.per_min, 0);
  EXPECT_NE(refused("per_min = 14", "per_min = -1").find("'per_min'"), std::string::npos);
  EXPECT_NE(refused("depth_mm = 4", "depth_mm = 40").find("'depth_mm'"), std::string::npos);
  EXPECT_NE(refused("beat_mm = 0.4", "beats_mm = 0.4").find("beats_mm"), std::string::npos);
}

}  // namespace
}  // namespace trocar::duct_reader_test
