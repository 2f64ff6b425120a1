// Every board's ducts: the geometry that the file draws, clear of the organ, and across the jaws where they are
// clipped.
#include "scenarios/kinds/clip/clip_layout.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/clip/clip_rules.h"
#include "tests/scenarios/support/bad_exercise.h"
#include "tests/scenarios/support/test_organs.h"

namespace trocar::clip_layout_test {
namespace {

constexpr double kTop = 0.01;  // m of the plate

Exercise clip_and_cut() {
  return find_exercise("clip-and-cut", std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises");
}

TriangleSurface plate(double edge) {
  return box(Vec3(edge, edge, kTop)).transformed({Mat3::Identity(), Vec3(-edge / 2, -edge / 2, 0)});
}

Mat3 pointing_down() { return Eigen::AngleAxisd(M_PI, Vec3::UnitX()).toRotationMatrix(); }

TEST(ClipLayout, EveryBoardHasTheGeometryOfTheFile) {
  const Exercise exercise = clip_and_cut();
  const ClipRules& rules = own_rules<ClipRules>(exercise);
  const TriangleSurface organ = plate(0.2);
  for (const ExerciseLevel& level : exercise.levels) {
    for (int board = 0; board < 20; ++board) {
      const Board out = lay_out_clips(exercise, level, board, {organ, nullptr, pointing_down()});
      ASSERT_EQ(out.ducts_T.size(), 4u);
      ASSERT_EQ(out.targets.size(), static_cast<std::size_t>(kClipAims));
      double lowest = 1;
      for (std::size_t d = 0; d < out.ducts_T.size(); ++d)
        for (std::size_t i = 0; i < out.ducts_T[d].size(); ++i) {
          if (exercise.ducts[d].path_m[i].z() < 0)
            EXPECT_NEAR(out.ducts_T[d][i].z(), kTop - 0.004, 1e-9) << "it ends in the organ";
          else
            lowest = std::min(lowest, out.ducts_T[d][i].z());
        }
      EXPECT_NEAR(lowest, kTop + rules.clear_m, 1e-9) << "lifted clear of it, and no further";
      for (int structure = 0; structure < kClipStructures; ++structure) {
        const auto& path = out.ducts_T[static_cast<std::size_t>(structure)];
        const auto& other = out.ducts_T[static_cast<std::size_t>(1 - structure)];
        EXPECT_NEAR((path[1] - path[0]).norm(), 0.028, 1e-4) << "25 mm free of the vessel that it comes from";
        EXPECT_NEAR((place_along(other, rules.cut_at_m).point_T - place_along(path, rules.cut_at_m).point_T).norm(),
                    0.008, 1e-4);
      }
      for (int target = kFirstClipAim; target < kClipAims; ++target) {
        const Target& aim = out.targets[static_cast<std::size_t>(target)];
        const auto& path = out.ducts_T[static_cast<std::size_t>(clip_aim(target).structure)];
        const Vec3 along = (path[1] - path[0]).normalized(), shaft = aim.R_TI.col(2);
        EXPECT_LT((aim.centre_T - path[0]).cross(along).norm(), 1e-9) << "on its axis";
        EXPECT_NEAR(std::abs(aim.R_TI.col(0).dot((along - along.dot(shaft) * shaft).normalized())), 1, 1e-9)
            << "the hinge lies along it as far as rolling can do it";
        const bool port = level.mapping == Mapping::kFulcrum;
        EXPECT_LT(port ? (aim.centre_T - level.port_m).cross(shaft).norm() : 0, 1e-9) << "its shaft passes the port";
        const double parent =
            exercise.ducts[static_cast<std::size_t>(kClipStructures + clip_aim(target).structure)].outer_radius_m;
        EXPECT_GT((aim.centre_T - path[0]).norm() - parent, rules.spared_m + rules.clip_width_m / 2)
            << "no clip is asked for where none may lie";
      }
    }
  }
}

TEST(ClipLayout, IsDrawnByTheBoardNumberAloneAndMirrorsSome) {
  const Exercise exercise = clip_and_cut();
  const ExerciseLevel& level = exercise.levels[0];
  const TriangleSurface organ = plate(0.2);
  const BoardPlace place{organ, nullptr, pointing_down()};
  EXPECT_EQ(lay_out_clips(exercise, level, 3, place).ducts_T, lay_out_clips(exercise, level, 3, place).ducts_T);
  EXPECT_NE(lay_out_clips(exercise, level, 3, place).ducts_T, lay_out_clips(exercise, level, 4, place).ducts_T);
  int left = 0;
  for (int board = 0; board < 20; ++board) {
    const Board out = lay_out_clips(exercise, level, board, place);
    const Vec3 along = out.ducts_T[0][1] - out.ducts_T[0][0], aside = out.ducts_T[1][0] - out.ducts_T[0][0];
    left += along.cross(aside).z() > 0;
  }
  EXPECT_GT(left, 4);
  EXPECT_LT(left, 16);
}

TEST(ClipLayout, SaysWhereTheOrganIsTooSmall) {
  const Exercise exercise = clip_and_cut();
  const TriangleSurface organ = plate(0.03);
  EXPECT_THROW(lay_out_clips(exercise, exercise.levels[0], 0, {organ, nullptr, pointing_down()}), InputError);
}

TEST(ClipLayout, APlaceAlongAPathTurnsItsCorners) {
  const std::vector<Vec3> path{Vec3(0, 0, 0), Vec3(0.01, 0, 0), Vec3(0.01, 0.02, 0)};
  EXPECT_LT((place_along(path, 0.004).point_T - Vec3(0.004, 0, 0)).norm(), 1e-12);
  EXPECT_LT((place_along(path, 0.015).point_T - Vec3(0.01, 0.005, 0)).norm(), 1e-12);
  EXPECT_LT((place_along(path, 0.015).tangent_T - Vec3::UnitY()).norm(), 1e-12);
}

TEST(ClipReader, NamesLineAndColumnOfWhatIsWrong) {
  const std::string text = clip_and_cut().text;
  const auto refusal = [&](const std::string& from, const std::string& to) {
    return test::refusal(test::edited(text, from, to));
  };
  for (const auto& [from, to, said] :
       {std::array{"clips_at_mm = [9.3, 14.3, 23.8]", "clips_at_mm = [9, 20, 23]", "before 'cut_at_mm'"},
        std::array{"pull_n = [0.3, 0.6]", "pull_n = [0.6, 0.3]", "least, most"},
        std::array{"tissue = \"normal\"", "tissue = \"still\"", "tissue"},
        std::array{"spared_mm = 4", "spared_mn = 4", "spared_mm"}}) {
    const std::string message = refusal(from, to);
    EXPECT_EQ(message.rfind("bad.toml:", 0), 0u) << message;
    EXPECT_NE(message.find(said), std::string::npos) << message;
  }
}

TEST(ClipReader, WantsTwoToDivideAndSomethingToSpare) {
  std::string text = clip_and_cut().text;
  const auto spared = text.find("[[ducts]]\nname = \"common bile duct\""), levels = text.find("[[levels]]");
  text.erase(spared, levels - spared);
  EXPECT_NE(test::refusal(text).find("four 'ducts'"), std::string::npos) << test::refusal(text);
}

}  // namespace
}  // namespace trocar::clip_layout_test
