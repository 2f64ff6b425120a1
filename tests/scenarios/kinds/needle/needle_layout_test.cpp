// Every board's pairs: the geometry that the file draws, the needle's circle through both dots, and what is refused.
#include "scenarios/kinds/needle/needle_layout.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "tests/scenarios/support/bad_exercise.h"
#include "tests/scenarios/support/test_organs.h"
#include "tissue/interaction/suturing.h"

namespace trocar::needle_layout_test {
namespace {

constexpr double kTop = 0.01;  // m of the plate

Exercise needle_driving() {
  return find_exercise("needle-driving", std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises");
}

TriangleSurface plate(double edge) {
  return box(Vec3(edge, edge, kTop)).transformed({Mat3::Identity(), Vec3(-edge / 2, -edge / 2, 0)});
}

Mat3 pointing_down() { return Eigen::AngleAxisd(M_PI, Vec3::UnitX()).toRotationMatrix(); }

TEST(NeedleLayout, EveryBoardHasTheGeometryOfTheFile) {
  const Exercise exercise = needle_driving();
  const NeedleRules& rules = own_rules<NeedleRules>(exercise);
  const TriangleSurface organ = plate(0.2);
  for (const ExerciseLevel& level : exercise.levels) {
    for (int board = 0; board < 20; ++board) {
      const Board out = lay_out_needle(exercise, level, board, {organ, nullptr, pointing_down()});
      ASSERT_EQ(out.targets.size(), 8u);
      for (std::size_t pair = 0; pair < 4; ++pair) {
        const Target &in = out.targets[pair], &exit = out.targets[4 + pair];
        EXPECT_NEAR((exit.centre_T - in.centre_T).norm(), rules.apart_m, 1e-9);
        EXPECT_NEAR(in.centre_T.z(), kTop, 1e-9);
        if (pair > 0) {
          EXPECT_NEAR((in.centre_T - out.targets[pair - 1].centre_T).norm(), rules.pair_gap_m, 1e-9);
        }
        const Vec3 along = (exit.centre_T - in.centre_T).normalized();
        EXPECT_LT(std::abs(along.dot(in.R_TI.col(2))), std::sin(rules.turn_rad + 0.2)) << "across the shaft";
      }
    }
  }
}

TEST(NeedleLayout, SameBoardSameDotsAndOthersDiffer) {
  const Exercise exercise = needle_driving();
  const TriangleSurface organ = plate(0.2);
  const BoardPlace place{organ, nullptr, pointing_down()};
  const auto first = [&](int board) -> Vec3 {
    return lay_out_needle(exercise, exercise.levels[0], board, place).targets[0].centre_T;
  };
  EXPECT_EQ(first(3), first(3));
  EXPECT_NE(first(3), first(4));
}

TEST(NeedleLayout, SaysWhereTheOrganIsTooSmall) {
  const Exercise exercise = needle_driving();
  const TriangleSurface organ = plate(0.02);
  EXPECT_THROW(lay_out_needle(exercise, exercise.levels[0], 0, {organ, nullptr, pointing_down()}), InputError);
}

TEST(NeedleLayout, TheCircleGoesThroughBothDots) {
  const NeedleShape shape = needle_of(needle_driving());
  const Vec3 in(-0.005, 0, 0), out(0.005, 0, 0), shaft = Vec3::UnitY();
  const BiteCircle circle = bite_circle(shape, in, out, Vec3::UnitZ(), shaft);
  const Pose X_TN = needle_across(shape, circle.middle_T, circle.up_T, shaft, circle.entry_rad);
  EXPECT_LT((X_TN * shape.place(shape.length_m) - in).norm(), 1e-12) << "its point at the first dot";
  const BesideNeedle beside = beside_needle(shape, X_TN.inverse() * out);
  EXPECT_NEAR(beside.outward_m, 0, 1e-12) << "the second on its circle,";
  EXPECT_NEAR(beside.across_m, 0, 1e-12) << "in its plane";
  EXPECT_GT((X_TN.R * shape.tangent(shape.length_m)).x(), 0) << "and ahead of it";
}

TEST(NeedleLayout, GraspingLaysThePadsAcrossTheWire) {
  const NeedleShape shape = needle_of(needle_driving());
  const Vec3 port(0, -0.125, 0.05);
  const Pose X_TN = needle_across(shape, Vec3::Zero(), Vec3::UnitZ(), -port.normalized(), M_PI);
  const Mat3 near = (X_TN * needle_in_jaws(shape, 0.4).inverse()).R;
  const Pose X_TI = grasping(shape, X_TN, 0.4, near, port);
  const Vec3 held = X_TI.inverse() * (X_TN * shape.place(0.4 * shape.length_m));
  EXPECT_NEAR(held.x(), 0, 1e-9);
  EXPECT_NEAR(held.y(), 0, 1e-9);
  EXPECT_NEAR(held.z(), -0.002, 1e-9) << "a little behind the tip";
  EXPECT_LT(Eigen::AngleAxisd(Mat3(X_TI.R * near.transpose())).angle(), 0.1) << "rolled no further than it must be";
}

TEST(NeedleReader, NamesLineAndColumnOfWhatIsWrong) {
  const std::string text = needle_driving().text;
  for (const auto& [from, to, said] :
       {std::array{"grip_from_point = [0.5, 0.67]", "grip_from_point = [0.7, 0.6]", "least, most"},
        std::array{"count = 8 ", "count = 7 ", "even"}, std::array{"apart_mm = 10", "apart_mm = 17", "wide"},
        std::array{"tissue = \"normal\"", "tissue = \"still\"", "tissue"},
        std::array{"point_out_mm = 5", "point_out_mn = 5", "point_out_mm"},
        std::array{"mapping = \"fulcrum\" ", "mapping = \"direct\" ", "port"}}) {
    const std::string message = test::refusal(test::edited(text, from, to));
    EXPECT_EQ(message.rfind("bad.toml:", 0), 0u) << message;
    EXPECT_NE(message.find(said), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace trocar::needle_layout_test
