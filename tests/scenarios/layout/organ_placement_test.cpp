// Placement with the whole instrument in mind: where the shaft would press no disc lies, an organ is turned where that
// helps, and what cannot be done is refused with the reason; organs that have room lie as they ever did.
#include "scenarios/layout/organ_placement.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "haptics/input_error.h"
#include "haptics/kinematics/device_geometry.h"
#include "haptics/least_turn.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/touch/disc_layout.h"
#include "tests/scenarios/support/relief.h"
#include "tests/scenarios/support/test_organs.h"

namespace trocar::organ_placement_test {
namespace {

Exercise shipped() {
  return load_exercise(std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises/surface-touch.toml");
}

/// From the patient's left and the feet, 50 degrees above the horizontal, as at level L1.
Instrument instrument() {
  Instrument made;
  const Vec3 from_T = Vec3(0.45, -0.45, 0.77).normalized();
  const Mat3 home = home_pose().R;
  made.map.X_SI.R = home.transpose() * least_turn(Vec3::UnitZ(), -from_T).toRotationMatrix();
  return made;
}

double least_gap(const Board& board, const ShaftRoom& room) {
  double least = 1;
  for (const Target& target : board.targets) least = std::min(least, room.gap_m(target.centre_T, target.normal_T));
  return least;
}

TEST(PlacementForTheShaft, AnOrganWithRoomLiesAndIsLaidOutAsForTheTipAlone) {
  const Exercise exercise = shipped();
  const TriangleSurface organ = liver_like();
  const OrganPlacement found = place_organ(organ, exercise, exercise.levels[0], instrument());
  const Pose before = place_organ(organ, exercise.layout);
  EXPECT_EQ(found.X_TO.p, before.p);
  EXPECT_EQ(found.X_TO.R, before.R);
  EXPECT_EQ(turned_words(found), "");
  EXPECT_GT(found.free_m2, 0.9 * found.even_m2);
  const TriangleSurface organ_T = organ.transformed(found.X_TO);
  const ShaftRoom room(organ_T, instrument().tool, instrument().map);
  for (int number = 0; number < 5; ++number) {
    const Board alone = lay_out_discs(organ_T, exercise, exercise.levels[0], number);
    const Board whole = lay_out_discs(organ_T, exercise, exercise.levels[0], number, &room);
    if (least_gap(alone, room) < ShaftRoom::kLeastGap) continue;
    for (std::size_t i = 0; i < alone.targets.size(); ++i)
      EXPECT_EQ(alone.targets[i].centre_T, whole.targets[i].centre_T);
  }
}

TEST(PlacementForTheShaft, BehindAWallDiscsForTheTipAloneCannotBeReached) {
  const Exercise exercise = shipped();
  const TriangleSurface ground = walled_ground(0.030);
  const ShaftRoom room(ground, instrument().tool, instrument().map);
  int blocked = 0;
  for (int number = 0; number < 5; ++number) {
    const Board alone = lay_out_discs(ground, exercise, exercise.levels[0], number);
    blocked += least_gap(alone, room) <= 0 ? 1 : 0;
    const Board whole = lay_out_discs(ground, exercise, exercise.levels[0], number, &room);
    EXPECT_EQ(whole.targets.size(), alone.targets.size());
    EXPECT_GE(least_gap(whole, room), ShaftRoom::kLeastGap);
  }
  EXPECT_EQ(blocked, 5) << "on every board that asked the tip alone, some disc lay under the shaft";
}

TEST(PlacementForTheShaft, BesideAHighWallEveryBoardKeepsToWhereTheInstrumentHasRoom) {
  const Exercise exercise = shipped();
  const TriangleSurface organ = in_ras(walled_ground(0.070));
  const OrganPlacement found = place_organ(organ, exercise, exercise.levels[0], instrument());
  const OrganPlacement before =
      measure_placement(organ, place_organ(organ, exercise.layout), exercise.layout, instrument());
  EXPECT_LT(before.free_m2, 0.5 * before.even_m2) << "where the tip has most ground, the wall stands in the way";
  EXPECT_GE(found.free_m2, before.free_m2);
  const TriangleSurface organ_T = organ.transformed(found.X_TO);
  const ShaftRoom room(organ_T, instrument().tool, instrument().map);
  for (int number = 0; number < 20; ++number)
    EXPECT_GE(least_gap(lay_out_discs(organ_T, exercise, exercise.levels[0], number, &room), room),
              ShaftRoom::kLeastGap)
        << number;
  const OrganPlacement again = place_organ(organ, exercise, exercise.levels[0], instrument());
  EXPECT_EQ(again.X_TO.p, found.X_TO.p) << "the same organ, the same place";
}

TEST(PlacementForTheShaft, ATurnedOrganKeepsItsHandednessAndItsHeadLevel) {
  const Exercise exercise = shipped();
  const OrganPlacement found = place_organ(in_ras(walled_ground(0.070)), exercise, exercise.levels[0], instrument());
  EXPECT_NEAR(found.X_TO.R.determinant(), 1, 1e-12);
  EXPECT_NEAR((found.X_TO.R * Vec3::UnitZ()).z(), 0, 1e-12)
      << "superior stays horizontal: a cut organ's cap never comes up";
}

TEST(PlacementForTheShaft, ATubIsRefusedBecauseOfTheShaft) {
  const Exercise exercise = shipped();
  const TriangleSurface ground = tub(0.110);
  const ShaftRoom room(ground, instrument().tool, instrument().map);
  EXPECT_EQ(lay_out_discs(ground, exercise, exercise.levels[0], 0).targets.size(), 12U)
      << "for the tip alone there is room";
  try {
    lay_out_discs(ground, exercise, exercise.levels[0], 0, &room);
    FAIL() << "the shaft has no way in";
  } catch (const InputError& error) {
    const std::string message = error.what();
    for (const char* part :
         {"board 0", "level L1", "of 12 targets", "12 where the tip alone", "shaft would press", "choose"})
      EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
  }
}

TEST(PlacementForTheShaft, AnOrganTooSmallIsRefusedForItsSizeNotForTheShaft) {
  const Exercise exercise = shipped();
  const TriangleSurface organ = bumpy_ellipsoid(Vec3(0.015, 0.015, 0.015), 24, 0);
  const OrganPlacement found = place_organ(organ, exercise, exercise.levels[0], instrument());
  const TriangleSurface organ_T = organ.transformed(found.X_TO);
  const ShaftRoom room(organ_T, instrument().tool, instrument().map);
  try {
    lay_out_discs(organ_T, exercise, exercise.levels[0], 3, &room);
    FAIL() << "twelve discs cannot fit";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("choose a larger organ"), std::string::npos) << error.what();
  }
}

TEST(PlacementForTheShaft, WordsTellRollAndTurnApart) {
  OrganPlacement placement;
  placement.roll_rad = -30 * kDegree;
  EXPECT_NE(turned_words(placement).find("rolled 30 degrees to its right"), std::string::npos)
      << turned_words(placement);
  placement.turn_rad = 45 * kDegree;
  EXPECT_NE(turned_words(placement).find("right and turned 45 degrees anticlockwise"), std::string::npos)
      << turned_words(placement);
  placement.roll_rad = 0;
  placement.turn_rad = -90 * kDegree;
  EXPECT_NE(turned_words(placement).find("is turned 90 degrees clockwise"), std::string::npos)
      << turned_words(placement);
}

}  // namespace
}  // namespace trocar::organ_placement_test
