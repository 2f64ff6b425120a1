// Organ placement and boards: on the surface, within every limit, the same for the same number, refused when too small.
#include "scenarios/kinds/touch/disc_layout.h"

#include <chrono>
#include <cmath>
#include <ctime>

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/layout/height_field.h"
#include "tests/scenarios/support/test_organs.h"

namespace trocar::disc_layout_test {
namespace {

Exercise shipped() {
  return load_exercise(std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises/surface-touch.toml");
}

TriangleSurface placed(const TriangleSurface& organ, const Exercise& exercise) {
  return organ.transformed(place_organ(organ, exercise.layout));
}

TEST(TestOrgans, AreClosedAndOutward) {
  EXPECT_GT(liver_like().volume_m3(), 2e-3);
  EXPECT_NEAR(liver_like().triangles.size(), 6000, 150);
  EXPECT_GT(gallbladder_like().volume_m3(), 2e-5);
  EXPECT_NEAR(box(Vec3(0.1, 0.2, 0.3)).volume_m3(), 6e-3, 1e-9);
}

TEST(HeightField, HitsTheTopOfABox) {
  const TriangleSurface cube = box(Vec3(0.1, 0.1, 0.05));
  const HeightField field(cube);
  const auto top = field.top(0.03, 0.07);
  ASSERT_TRUE(top);
  EXPECT_NEAR(top->position.z(), 0.05, 1e-12);
  EXPECT_NEAR(top->slope_rad, 0, 1e-12);
  EXPECT_FALSE(field.top(0.2, 0.05));
  EXPECT_FALSE(field.top(-1e-6, 0.05));
}

TEST(HeightField, AgreesWithTheSphereEverywhere) {
  const TriangleSurface sphere = bumpy_ellipsoid(Vec3(0.05, 0.05, 0.05), 60, 0);
  const HeightField field(sphere);
  for (double x = -0.04; x <= 0.04; x += 0.0073) {
    for (double y = -0.025; y <= 0.025; y += 0.0061) {
      const auto top = field.top(x, y);
      ASSERT_TRUE(top) << x << " " << y;
      const double z = std::sqrt(0.0025 - x * x - y * y);
      EXPECT_NEAR(top->position.z(), z, 2e-4) << "facets of 3 degrees sag by 0.07 mm; steeper, more";
      EXPECT_LT((top->normal - Vec3(x, y, z) / 0.05).norm(), 0.03);
    }
  }
}

TEST(HeightField, IsEmptyForAnEmptySurface) {
  const TriangleSurface nothing;
  EXPECT_FALSE(HeightField(nothing).top(0, 0));
}

TEST(PlaceOrgan, TurnsAnteriorUpAndKeepsHandedness) {
  const Pose X_TO = place_organ(liver_like(), shipped().layout);
  EXPECT_NEAR((X_TO.R * Vec3::UnitY() - Vec3::UnitZ()).norm(), 0, 1e-12) << "anterior is up";
  EXPECT_NEAR((X_TO.R * Vec3::UnitZ() - Vec3::UnitY()).norm(), 0, 1e-12) << "superior is +y";
  EXPECT_NEAR((X_TO.R * Vec3::UnitX() + Vec3::UnitX()).norm(), 0, 1e-12) << "right is -x";
  EXPECT_NEAR(X_TO.R.determinant(), 1, 1e-12);
}

TEST(PlaceOrgan, PutsTheMiddleOfTheRegionAtTheOrigin) {
  const Exercise exercise = shipped();
  const TriangleSurface organ_T = placed(liver_like(), exercise);
  const auto top = HeightField(organ_T).top(0, 0);
  ASSERT_TRUE(top);
  EXPECT_NEAR(top->position.z(), 0, 1e-9);
  EXPECT_LE(top->slope_rad, exercise.layout.max_slope_rad);
}

TEST(PlaceOrgan, IsNotMovedByWhereTheImageLay) {
  const Exercise exercise = shipped();
  const TriangleSurface organ = liver_like();
  const Pose shift{Mat3::Identity(), Vec3(0.31, -0.22, 0.55)};
  const Pose direct = place_organ(organ, exercise.layout);
  const Pose moved = place_organ(organ.transformed(shift), exercise.layout);
  EXPECT_LT(((moved * shift).p - direct.p).norm(), 1e-6);
}

TEST(PlaceOrgan, RefusesAnOrganWithoutAnyForwardSurface) {
  EXPECT_THROW(place_organ(TriangleSurface{}, shipped().layout), InputError);
}

TEST(Board, KeepsEveryLimitOnTwentyBoards) {
  const Exercise exercise = shipped();
  const TargetLayout& layout = exercise.layout;
  const TriangleSurface organ_T = placed(liver_like(), exercise);
  const HeightField field(organ_T);
  for (int number = 0; number < 20; ++number) {
    const Board board = lay_out_discs(organ_T, exercise, exercise.levels[0], number);
    ASSERT_EQ(board.targets.size(), 12u) << number;
    for (std::size_t i = 0; i < board.targets.size(); ++i) {
      const Target& target = board.targets[i];
      const auto top = field.top(target.centre_T.x(), target.centre_T.y());
      ASSERT_TRUE(top);
      EXPECT_NEAR(target.centre_T.z(), top->position.z(), 1e-12) << "on the surface";
      EXPECT_NEAR(target.normal_T.norm(), 1, 1e-12);
      EXPECT_LE(std::acos(target.normal_T.z()), layout.max_slope_rad + 1e-9);
      EXPECT_LE(std::abs(target.centre_T.z() - board.centre_T.z()), layout.relief_m);
      EXPECT_LE(std::abs(target.centre_T.x()), layout.region_x_m / 2 - layout.radius_m);
      EXPECT_LE(std::abs(target.centre_T.y()), layout.region_y_m / 2 - layout.radius_m);
      EXPECT_DOUBLE_EQ(target.radius_m, 0.003);
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE((board.targets[j].centre_T - target.centre_T).norm(), layout.min_spacing_m);
    }
  }
}

TEST(Board, IsTheSameForTheSameNumberAndAnotherForAnother) {
  const Exercise exercise = shipped();
  const TriangleSurface organ_T = placed(liver_like(), exercise);
  const Board one = lay_out_discs(organ_T, exercise, exercise.levels[0], 3),
              same = lay_out_discs(organ_T, exercise, exercise.levels[0], 3);
  const Board other = lay_out_discs(organ_T, exercise, exercise.levels[0], 4);
  for (std::size_t i = 0; i < one.targets.size(); ++i) EXPECT_EQ(one.targets[i].centre_T, same.targets[i].centre_T);
  EXPECT_NE(one.targets[0].centre_T, other.targets[0].centre_T);
}

TEST(Board, AsksForTravelWithoutRunningIntoTheOrgan) {
  const Exercise exercise = shipped();
  const TriangleSurface organ_T = placed(liver_like(), exercise);
  const HeightField field(organ_T);
  for (int number = 0; number < 20; ++number) {
    const Board board = lay_out_discs(organ_T, exercise, exercise.levels[0], number);
    for (std::size_t i = 1; i < board.targets.size(); ++i) {
      const Vec3 a = board.targets[i - 1].centre_T, b = board.targets[i].centre_T;
      EXPECT_GT((a - b).norm(), 0.014);
      EXPECT_LT((a - b).norm(), 0.080);
      for (double share = 0; share <= 1; share += 0.1) {
        const Vec3 lifted = a + share * (b - a) + Vec3(0, 0, exercise.retract_height_m);
        const auto below = field.top(lifted.x(), lifted.y());
        if (!below) continue;
        EXPECT_LT(below->position.z(), lifted.z()) << number << " leg " << i;
      }
    }
  }
}

TEST(Board, StartsAboveTheRegion) {
  const Exercise exercise = shipped();
  const Board board = lay_out_discs(placed(liver_like(), exercise), exercise, exercise.levels[0], 0);
  EXPECT_NEAR((board.start_T - board.centre_T - exercise.start_above_m).norm(), 0, 1e-12);
  EXPECT_GT(board.start_T.z(), exercise.start_sphere_m + exercise.layout.relief_m);
}

TEST(Board, RefusesASmallOrganSayingHowManyFit) {
  const Exercise exercise = shipped();
  const TriangleSurface organ_T = placed(gallbladder_like(), exercise);
  try {
    lay_out_discs(organ_T, exercise, exercise.levels[0], 0);
    FAIL() << "twelve discs cannot fit";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("has room for"), std::string::npos) << message;
    EXPECT_NE(message.find("of 12 targets"), std::string::npos) << message;
    EXPECT_EQ(message.find("room for 0 "), std::string::npos) << "some do fit: " << message;
  }
}

TEST(Board, RefusesAnOrganThatWasNotPlaced) {
  const Pose away{Mat3::Identity(), Vec3(5, 5, 5)};
  EXPECT_THROW(lay_out_discs(liver_like().transformed(away), shipped(), shipped().levels[0], 0), InputError);
}

TEST(Board, IsLaidOutQuickly) {
  const Exercise exercise = shipped();
  const TriangleSurface organ = liver_like();
  const std::clock_t before = std::clock();
  const TriangleSurface organ_T = placed(organ, exercise);
  lay_out_discs(organ_T, exercise, exercise.levels[0], 0);
  const double seconds = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  RecordProperty("cpu_ms", static_cast<int>(seconds * 1000));
  EXPECT_LT(seconds, 1.0) << "50 ms in a release build; the bound leaves room for sanitizers";
}

}  // namespace
}  // namespace trocar::disc_layout_test
