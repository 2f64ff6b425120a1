// Boards of lift and find, and what its reader refuses.
#include "scenarios/kinds/find/find_layout.h"

#include <array>
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/find/find_rules.h"

namespace trocar::find_layout_test {
namespace {

Exercise shipped() { return find_exercise("E08", std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises"); }

/// A level plate, 200 mm square.
TriangleSurface plate() {
  TriangleSurface out;
  out.vertices = {Vec3(-0.1, -0.1, 0), Vec3(0.1, -0.1, 0), Vec3(0.1, 0.1, 0), Vec3(-0.1, 0.1, 0)};
  out.triangles = {{0, 1, 2}, {0, 2, 3}};
  return out;
}

TEST(FindLayout, PinsLieBeneathTheFlapAndPlacesAlongItsFreeEdge) {
  const Exercise exercise = shipped();
  for (const ExerciseLevel& level : exercise.levels)
    for (int n = 0; n < 20; ++n) {
      const Board board = lay_out_find(plate(), exercise, level, n);
      const FindBoard& own = own_rules<FindBoard>(board);
      ASSERT_EQ(board.targets.size(), 5u);
      ASSERT_EQ(own.pins.size(), 5u);
      std::set<double> places;
      for (const Target& target : board.targets) {
        EXPECT_NEAR(target.centre_T.y(), -0.010, 1e-9);
        EXPECT_LE(std::abs(target.centre_T.x()), 0.012 + 1e-9);
        places.insert(target.centre_T.x());
      }
      EXPECT_EQ(places.size(), 5u) << "each at a place of its own";
      for (const HiddenPin& pin : own.pins) {
        EXPECT_LT(std::abs(pin.centre_T.x()), 0.013);
        EXPECT_GT(pin.centre_T.y(), -0.007);
        EXPECT_LT(pin.centre_T.y(), 0.007);
      }
      for (std::size_t i = 1; i < own.answers_T.size(); ++i)
        EXPECT_GE((own.answers_T[i] - own.answers_T[i - 1]).norm(), 0.015 - 1e-9);
    }
}

TEST(FindLayout, NoSymbolIsLikelierAndNoBallIsAlwaysTheSame) {
  const Exercise exercise = shipped();
  std::array<int, kMostAnswers> drawn{};
  std::set<double> first_ball;
  constexpr int kBoards = 400;
  for (int n = 0; n < kBoards; ++n) {
    const Board board = lay_out_find(plate(), exercise, exercise.levels.front(), n);
    for (const HiddenPin& pin : own_rules<FindBoard>(board).pins) ++drawn[static_cast<std::size_t>(pin.symbol)];
    first_ball.insert(own_rules<FindBoard>(board).answers_T[0].x());
  }
  // 2000 draws of a quarter: a standard deviation of 19.
  for (const int count : drawn) EXPECT_NEAR(count, 5 * kBoards / kMostAnswers, 4 * 19.4);
  EXPECT_EQ(first_ball.size(), static_cast<std::size_t>(kMostAnswers));
}

TEST(FindLayout, AnOrganThatIsTooSmallIsRefused) {
  TriangleSurface small = plate();
  for (Vec3& vertex : small.vertices) vertex *= 0.15;
  const Exercise exercise = shipped();
  EXPECT_THROW(lay_out_find(small, exercise, exercise.levels.front(), 0), InputError);
}

/// What the reader says of the shipped file with one text in place of another.
std::string refusal(const std::string& from, const std::string& to) {
  std::string text = shipped().text;
  text.replace(text.find(from), from.size(), to);
  try {
    parse_exercise(text, "find.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FindReader, NamesLineAndColumnOfWhatContradictsItself) {
  EXPECT_NE(refusal("grip_high_n = 2.5", "grip_high_n = 0.4").find("'grip_high_n' must be above"), std::string::npos);
  EXPECT_NE(refusal("apart_mm = 15", "apart_mm = 8").find("lets the balls overlap"), std::string::npos);
  EXPECT_NE(refusal("seen_deg = 60", "seen_deg = 120").find("find.toml:"), std::string::npos);
  EXPECT_NE(refusal("tissue = \"normal\"", "tissue = \"still\"").find("tissue"), std::string::npos);
  EXPECT_NE(refusal("pin_mm = 4", "pin_width_mm = 4").find("pin_mm"), std::string::npos);
}

}  // namespace
}  // namespace trocar::find_layout_test
