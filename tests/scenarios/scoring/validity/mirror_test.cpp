// A left-handed attempt, the mirror image of a right-handed one, earns the same: no metric prefers a side.
#include <gtest/gtest.h>

#include <cmath>

#include "scenarios/scoring/score.h"
#include "tests/scenarios/support/practice_world.h"

namespace trocar::mirror_test {
namespace {

Vec3 mirrored(const Vec3& v) { return {-v.x(), v.y(), v.z()}; }

/// Board and motion seen in a mirror at the plane x = 0.
PracticeAttempt mirrored(PracticeAttempt attempt) {
  for (TraceSample& sample : attempt.trace.samples) {
    for (Vec3 TraceSample::*vector : {&TraceSample::tip_T, &TraceSample::shaft_T, &TraceSample::force_T})
      sample.*vector = mirrored(sample.*vector);
  }
  for (Event& event : attempt.events) event.tip_T = mirrored(event.tip_T);
  for (Vec3& waypoint : attempt.context.waypoints) waypoint = mirrored(waypoint);
  attempt.context.approach_T = mirrored(attempt.context.approach_T);
  return attempt;
}

class MirrorImage : public ::testing::TestWithParam<const char*> {};

TEST_P(MirrorImage, EarnsTheSame) {
  const PracticeRoom room(GetParam());
  const Rubric& rubric = room.exercise.levels.front().rubric;
  for (const char* hand : {"expert", "novice"}) {
    const PracticeAttempt right = practise(room, hand, 3, 4), left = mirrored(right);
    const Grade grade = score_attempt(left.trace, left.events, rubric, left.context);
    ASSERT_TRUE(right.grade.score) << hand;
    EXPECT_NEAR(*grade.score, *right.grade.score, 1e-6) << hand;
    EXPECT_EQ(grade.caps, right.grade.caps) << hand;
    for (std::size_t i = 0; i < grade.metrics.size(); ++i) {
      ASSERT_EQ(grade.metrics[i].value.has_value(), right.grade.metrics[i].value.has_value());
      if (!grade.metrics[i].value) continue;
      const double expected = *right.grade.metrics[i].value;
      EXPECT_NEAR(*grade.metrics[i].value, expected, 1e-9 + 1e-9 * std::abs(expected)) << grade.metrics[i].name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, MirrorImage, ::testing::Values("surface-touch", "reach-and-orient", "limited-grasp"));

}  // namespace
}  // namespace trocar::mirror_test
