// Every board's strands and vessels: on the organ, across the foot of the hook, and apart from one another.
#include "scenarios/kinds/dissect/dissect_layout.h"

#include <cmath>

#include <gtest/gtest.h>

#include "haptics/least_turn.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/dissect/dissect_rules.h"
#include "tests/scenarios/support/bad_exercise.h"
#include "tests/scenarios/support/test_organs.h"

namespace trocar::dissect_layout_test {
namespace {

constexpr double kTop = 0.01;  // m of the plate
constexpr int kStrands = kMostStrands, kSpurters = kMostSpurters, kDissectAims = kStrands + kSpurters;  // of E13

Exercise bleeders_and_hook() {
  return find_exercise("bleeders-and-hook", std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises");
}

Mat3 pointing_down() { return Eigen::AngleAxisd(M_PI, Vec3::UnitX()).toRotationMatrix(); }

TEST(DissectLayout, EveryBoardHasFiveStrandsAcrossTheFootAndThreeVesselsApart) {
  const Exercise exercise = bleeders_and_hook();
  const DissectRules& rules = own_rules<DissectRules>(exercise);
  const TriangleSurface organ = plate(0.12, kTop);
  for (const ExerciseLevel& level : exercise.levels) {
    Mat3 R = pointing_down();
    if (level.mapping == Mapping::kFulcrum)
      R = least_turn(R.col(2), Vec3(0, 0, kTop) - level.port_m).toRotationMatrix() * R;
    const Vec3 foot = (-R.col(1) + R.col(1).z() * Vec3::UnitZ()).normalized();
    for (int board = 0; board < 20; ++board) {
      const Board out = lay_out_dissection(exercise, level, board, {organ, nullptr, pointing_down()});
      ASSERT_EQ(out.ducts_T.size(), static_cast<std::size_t>(kStrands));
      ASSERT_EQ(out.targets.size(), static_cast<std::size_t>(kDissectAims));
      for (int strand = 0; strand < kStrands; ++strand) {
        const auto& path = out.ducts_T[static_cast<std::size_t>(strand)];
        const Vec3 way = path.back() - path.front(), middle = path[path.size() / 2];
        EXPECT_NEAR(path.front().z(), kTop, 1e-9);
        EXPECT_NEAR(middle.z(), kTop + rules.bow_m, 1e-9) << "its middle stands off the organ";
        EXPECT_LT(std::asin(std::abs(foot.dot(way.normalized()))), rules.turn_rad + 0.2) << "across, to a vertex";
        EXPECT_LT((out.targets[static_cast<std::size_t>(strand)].centre_T - middle + Vec3(0, 0, rules.bow_m)).norm(),
                  1e-9);
        for (int other = 0; other < strand; ++other)
          EXPECT_GT((out.targets[static_cast<std::size_t>(strand)].centre_T -
                     out.targets[static_cast<std::size_t>(other)].centre_T)
                        .norm(),
                    0.008);
      }
      for (int a = kStrands; a < kDissectAims; ++a)
        for (int b = kStrands; b < a; ++b)
          EXPECT_GE(
              (out.targets[static_cast<std::size_t>(a)].centre_T - out.targets[static_cast<std::size_t>(b)].centre_T)
                  .norm(),
              exercise.layout.min_spacing_m);
      const std::vector<BleederSetup> bleeders = bleeders_of(exercise, out);
      ASSERT_EQ(bleeders.size(), static_cast<std::size_t>(kSpurters));
      EXPECT_EQ(bleeders.front().place_T, out.targets[kStrands].centre_T);
    }
  }
}

TEST(DissectLayout, IsDrawnByTheBoardNumberAlone) {
  const Exercise exercise = bleeders_and_hook();
  const TriangleSurface organ = plate(0.12, kTop);
  const BoardPlace place{organ, nullptr, pointing_down()};
  const auto ducts = [&](int board) { return lay_out_dissection(exercise, exercise.levels[0], board, place).ducts_T; };
  EXPECT_EQ(ducts(3), ducts(3));
  EXPECT_NE(ducts(3), ducts(4));
}

TEST(DissectLayout, SaysWhereTheOrganIsTooSmall) {
  const Exercise exercise = bleeders_and_hook();
  const TriangleSurface organ = plate(0.02, kTop);
  EXPECT_THROW(lay_out_dissection(exercise, exercise.levels[0], 0, {organ, nullptr, pointing_down()}), InputError);
}

TEST(DissectLayout, OtherKindsHaveNoVesselsThatOpen) {
  const Exercise other = find_exercise("surface-touch", std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises");
  EXPECT_TRUE(bleeders_of(other, Board{}).empty());
}

TEST(DissectReader, NamesLineAndColumnOfWhatIsWrong) {
  const std::string text = bleeders_and_hook().text;
  for (const auto& [from, to, said] : {std::array{"count = 8", "count = 9", "up to three vessels"},
                                       std::array{"near_mm = 2 ", "near_mm = 7 ", "below 'lift_mm'"},
                                       std::array{"tissue = \"normal\"", "tissue = \"still\"", "tissue"},
                                       std::array{"seal_s = 8", "seal_x = 8", "seal_s"},
                                       std::array{"bed_mm = [40, 30]", "bed_mm = [40, 300]", "bed_mm"}}) {
    const std::string message = test::refusal(test::edited(text, from, to));
    EXPECT_EQ(message.rfind("bad.toml:", 0), 0u) << message;
    EXPECT_NE(message.find(said), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace trocar::dissect_layout_test
