// Every board's wire: as long as asked for, no bend tighter, and at every gate the ring can stand square to it.
#include "scenarios/kinds/wire/wire_layout.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "haptics/least_turn.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/wire/wire_rules.h"

namespace trocar::wire_layout_test {
namespace {

Exercise ring_on_wire() {
  return find_exercise("ring-on-wire", std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises");
}

/// Of the circle through three points.
double radius_through(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double area2 = (b - a).cross(c - a).norm();
  return area2 < 1e-12 ? 1e9 : (b - a).norm() * (c - b).norm() * (a - c).norm() / (2 * area2);
}

TEST(WireLayout, EveryBoardOfEveryLevelIsLaidOut) {
  const Exercise exercise = ring_on_wire();
  for (const ExerciseLevel& level : exercise.levels) {
    const bool port = level.mapping == Mapping::kFulcrum;
    // A port asks for the shaft on its line, at rest too.
    const Mat3 R_rest = port ? least_turn(Vec3::UnitZ(), -level.port_m).toRotationMatrix() : Mat3::Identity();
    const RingOnWire ring = ring_of(exercise, level);
    for (int board = 0; board < 20; ++board) {
      const Board out = lay_out_wire(exercise, level, R_rest, board);
      const std::vector<double> along = arc_lengths(out.wire_T);
      // On the sphere a line grows shorter off its middle: by 4 % at 70 mm of 150.
      EXPECT_NEAR(along.back(), 0.220, port ? 0.006 : 1e-4);
      ASSERT_EQ(out.targets.size(), 21u);
      for (std::size_t i = 4; i + 4 < out.wire_T.size(); ++i)
        EXPECT_GT(radius_through(out.wire_T[i - 4], out.wire_T[i], out.wire_T[i + 4]), 0.0135) << board;
      for (const Target& gate : out.targets) {
        const Vec3 centre = gate.centre_T + gate.R_TI * ring.centre_I, normal = gate.R_TI * ring.normal_I;
        std::size_t nearest = 1;
        for (std::size_t i = 1; i + 1 < out.wire_T.size(); ++i)
          if ((out.wire_T[i] - centre).norm() < (out.wire_T[nearest] - centre).norm()) nearest = i;
        EXPECT_LT((out.wire_T[nearest] - centre).norm(), 0.0006) << "the ring's middle is on the wire";
        const Vec3 tangent = (out.wire_T[nearest + 1] - out.wire_T[nearest - 1]).normalized();
        EXPECT_GT(normal.dot(tangent), 0.998) << "square to it";
        if (!port) continue;
        const Vec3 u = gate.R_TI.col(2);
        EXPECT_LT((gate.centre_T - level.port_m).cross(u).norm(), 1e-9) << "its shaft passes the port";
      }
    }
  }
}

TEST(WireLayout, IsDrawnByTheBoardNumberAlone) {
  const Exercise exercise = ring_on_wire();
  const ExerciseLevel& level = exercise.levels[0];
  const Board one = lay_out_wire(exercise, level, Mat3::Identity(), 3);
  EXPECT_EQ(one.wire_T, lay_out_wire(exercise, level, Mat3::Identity(), 3).wire_T);
  EXPECT_NE(one.wire_T, lay_out_wire(exercise, level, Mat3::Identity(), 4).wire_T);
}

TEST(WireLayout, SaysWhereThereIsNoRoom) {
  Exercise exercise = ring_on_wire();
  exercise.layout.region_x_m = 0.05;
  EXPECT_THROW(lay_out_wire(exercise, exercise.levels[0], Mat3::Identity(), 0), InputError);
}

TEST(WireReader, RefusesARingThatTheWireDoesNotFitInto) {
  std::string text = ring_on_wire().text;
  const auto at = text.find("ring_diameter_mm = 14");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 21, "ring_diameter_mm = 3 ");
  EXPECT_THROW(parse_exercise(text, "here.toml"), InputError);
}

}  // namespace
}  // namespace trocar::wire_layout_test
