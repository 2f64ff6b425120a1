// The scoring context: what it takes from exercise, board and events, and its JSON round trip.
#include "scenarios/director/scoring_context.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"

namespace trocar::scoring_context_test {
namespace {

ScoringContext awkward_context() {
  ScoringContext context;
  context.outcome = AttemptStatus::kTimeout;
  context.time_limit_s = 120;
  context.band_low_n = 0.1 + 0.2;  // 0.30000000000000004
  context.band_high_n = 1.0 / 3;
  context.soft_force_n = std::nextafter(1.0, 2.0);
  context.hard_force_n = 1e-300;
  context.critical_force_n = 4.7;
  context.grip_low_n = 0.73;
  context.grip_high_n = 5e-324;  // the smallest number there is
  context.rise_s = 1.5;
  context.retract_height_m = 0.012;
  context.approach_T = Vec3(0.1, -0.2, M_PI).normalized();
  context.waypoints = {Vec3(0.1, 1.0 / 7, -0.0), Vec3(1e17, -2.5e-9, 3)};
  context.objects_total = 13;
  context.objects_done = 5;
  return context;
}

TEST(ScoringContextJson, RoundTripsToTheBit) {
  const ScoringContext context = awkward_context();
  const ScoringContext back = parse_scoring_context(scoring_context_json(context));
  EXPECT_TRUE(back == context);
  EXPECT_TRUE(std::signbit(back.waypoints[0].z())) << "even the sign of zero";
  EXPECT_EQ(scoring_context_json(back), scoring_context_json(context));
}

TEST(ScoringContextJson, KnowsEveryOutcome) {
  for (const AttemptStatus outcome : {AttemptStatus::kCompleted, AttemptStatus::kTimeout, AttemptStatus::kAborted,
                                      AttemptStatus::kFault, AttemptStatus::kVoid}) {
    ScoringContext context;
    context.outcome = outcome;
    EXPECT_EQ(parse_scoring_context(scoring_context_json(context)).outcome, outcome);
  }
}

TEST(ScoringContextJson, RefusesWhatIsNotAContext) {
  const std::string good = scoring_context_json(awkward_context());
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      parse_scoring_context(text, "chunk 7");
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(refusal("").find("chunk 7: "), std::string::npos);
  EXPECT_NE(refusal("[1, 2]").find("chunk 7: "), std::string::npos);
  std::string renamed = good;
  renamed.replace(renamed.find("hard_force_n"), 12, "hard_force_x");
  EXPECT_NE(refusal(renamed).find("hard_force_n"), std::string::npos);
  std::string odd = good;
  odd.replace(odd.find("timeout"), 7, "unknown");
  EXPECT_NE(refusal(odd).find("unknown outcome"), std::string::npos);
  std::string flat = good;
  flat.replace(flat.find("\"approach\":["), 12, "\"approach\":[9,");
  EXPECT_NE(refusal(flat).find("three numbers"), std::string::npos);
}

TEST(ScoringContextJson, RefusesToWriteWhatIsNotFinite) {
  ScoringContext context = awkward_context();
  context.waypoints[1].y() = std::nan("");
  EXPECT_THROW(scoring_context_json(context), std::invalid_argument);
}

TEST(ScoringContextFromRun, CountsEachObjectOnceAndOrdersWaypoints) {
  const Exercise exercise =
      load_exercise(std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises/surface-touch.toml");
  Board board;
  board.start_T = Vec3(0, 0, 0.045);
  board.targets = {{Vec3(1, 0, 0), Vec3::UnitZ(), 0.003},
                   {Vec3(2, 0, 0), Vec3::UnitZ(), 0.003},
                   {Vec3(3, 0, 0), Vec3::UnitZ(), 0.003}};
  const auto event = [](const char* type, std::int32_t object) {
    Event e;
    e.type = type;
    e.object = object;
    return e;
  };
  const std::vector<Event> events = {event("TARGET_LIT", 0), event("TARGET_HELD", 1), event("TARGET_HELD", 0),
                                     event("TARGET_HELD", 1), event("GRIP_HELD", 3)};
  const ScoringContext context =
      scoring_context(exercise, exercise.levels[0], board, events, AttemptStatus::kCompleted);
  EXPECT_EQ(context.objects_total, 4);
  EXPECT_EQ(context.objects_done, 3);
  ASSERT_EQ(context.waypoints.size(), 3u);
  EXPECT_EQ(context.waypoints[0], board.start_T);
  EXPECT_EQ(context.waypoints[1], board.targets[1].centre_T);
  EXPECT_EQ(context.waypoints[2], board.targets[0].centre_T);
  EXPECT_DOUBLE_EQ(context.band_low_n, 0.4);
  EXPECT_DOUBLE_EQ(context.grip_high_n, 1.2);
  EXPECT_DOUBLE_EQ(context.critical_force_n, 4.7);
}

}  // namespace
}  // namespace trocar::scoring_context_test
