// Metamorphic: whatever event is added to an attempt on the whole device chain, its score does not rise.
//
// Every event type there is, early and late, for each exercise. The
// intermediate hand plays: its attempt has headroom in every sub-score. METAMORPHIC_ALL=1: the exercises on tissue too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "app/session/session.h"
#include "scenarios/director/scoring_context.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/kind.h"
#include "scenarios/scoring/event_types.h"
#include "scenarios/scoring/score.h"

namespace trocar::metamorphic_session_test {
namespace {

/// Begin and end, what tells that something asked for was done, and what carries a measured value: more of these may
/// be worth more.
constexpr EventType kNoErrors[] = {event_type::kStart,      event_type::kDone,     event_type::kTimeout,
                                   event_type::kTargetHeld, event_type::kPlaced,   event_type::kNoduleFound,
                                   event_type::kGripHeld,   event_type::kViewJerks};

bool no_error(EventType type) {
  return std::any_of(std::begin(kNoErrors), std::end(kNoErrors),
                     [&](EventType known) { return known.name == type.name; });
}

TEST(MetamorphicSession, NoEventAddedRaisesAScore) {
  const AssetRoots assets = find_assets();
  int played = 0;
  for (const Exercise& exercise : list_exercises(assets.exercises)) {
    if (kind_of(exercise).on_organ && !std::getenv("METAMORPHIC_ALL")) continue;
    SCOPED_TRACE(exercise.id);
    AttemptSetup setup;
    setup.exercise = exercise;
    setup.level = "L2";
    setup.hand = "intermediate";
    setup.seed = 3;
    setup.board = 3;
    setup.tissue = exercise.tissue;
    setup.organ = kind_of(exercise).on_organ ? "phantom-liver" : "none";
    const Scene scene = build_scene(setup, assets, backend_capabilities(setup.backend, setup.rate_hz));
    const auto [outcome, recording] = record_session(scene, assets, SessionHooks{}, {});
    ASSERT_TRUE(recording.end);
    const Rubric& rubric = find_level(exercise, setup.level).rubric;
    const Trace trace = rebuild_trace(recording.ticks, recording.rate_hz);
    const ScoringContext context = parse_scoring_context(recording.end->summary_json);
    const double before = score_attempt(trace, recording.events, rubric, context).score.value();
    ASSERT_GT(before, 20) << "there is a score to raise";
    const double begins = recording.events.front().t_s, ends = recording.events.back().t_s;
    for (const EventType type : event_type::kAll) {
      if (no_error(type)) continue;
      for (const double share : {0.1, 0.9}) {
        Event more;
        more.t_s = begins + share * (ends - begins);
        more.type = type.name;
        more.severity = Severity::kMinor;
        more.object = 0;
        more.value = 1;
        std::vector<Event> events = recording.events;
        events.insert(std::upper_bound(events.begin(), events.end(), more.t_s,
                                       [](double t, const Event& event) { return t < event.t_s; }),
                      more);
        const Grade grade = score_attempt(trace, events, rubric, context);
        EXPECT_LE(grade.score.value_or(0), before + 1e-9) << type.name << " at " << share;
      }
    }
    ++played;
  }
  EXPECT_GE(played, 4);
}

}  // namespace
}  // namespace trocar::metamorphic_session_test
