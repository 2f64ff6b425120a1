// Palpation against scripted states: marks, what is right, what ends the search, and what the cheap tricks earn.
#include "scenarios/kinds/palpate/palpate_task.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "scenarios/director/cue_percept.h"
#include "scenarios/director/scoring_context.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/scoring/metrics.h"
#include "tissue/tissue_frame.h"

namespace trocar::palpate_task_test {
namespace {

/// Three nodules under a plane at z = 0 and a director that is fed one state after the other at 100 Hz.
class PalpateTest : public testing::Test {
 protected:
  explicit PalpateTest(const char* level = "L2")
      : exercise_(load_exercise(std::string(TROCAR_SOURCE_DIR) + "/scenarios/exercises/palpation.toml")),
        level_(find_level(exercise_, level)),
        director_(exercise_, level_, board()) {
    state_.loop = LoopState::kActive;
    state_.X_TI.p = board().start_T;
    feed(1.1);
  }

  static const std::array<Vec3, 3>& places() {
    static const std::array<Vec3, 3> all{Vec3(0.01, 0, 0), Vec3(-0.01, 0.01, 0), Vec3(-0.005, -0.012, 0)};
    return all;
  }
  Board board() const {
    Board board;
    board.start_T = Vec3(0, 0, 0.045);
    for (std::size_t i = 0; i < 3; ++i) {
      const NodulePlan& plan = own_rules<PalpateRules>(exercise_).nodules[i];
      board.nodules.push_back({places()[i] - Vec3(0, 0, plan.top_m + plan.radius_m), plan.radius_m, 6});
    }
    return board;
  }
  void feed(double seconds) {
    for (int i = 0, n = static_cast<int>(std::lround(seconds * 100)); i < n; ++i) {
      state_.t_s += 0.01;
      director_.update(state_);
    }
  }
  void press(const Vec3& place, double force_n = 1) {
    state_.X_TI.p = place;
    state_.contact_point_T = place;
    state_.contact = state_.tip_contact = true;
    state_.F_I_T.force = Vec3(0, 0, force_n);
  }
  void lift() {
    state_.contact = state_.tip_contact = false;
    state_.F_I_T.force.setZero();
    state_.X_TI.p.z() += 0.02;
  }
  void pinch(double grip_n, double seconds) {
    state_.grip_force_n = grip_n;
    feed(seconds);
    state_.grip_force_n = 0;
    feed(0.1);
  }
  void mark(const Vec3& place) {
    press(place);
    pinch(1, 1.6);
    lift();
    feed(0.1);
  }
  int count(EventType type) const {
    return static_cast<int>(std::count_if(director_.events().begin(), director_.events().end(),
                                          [&](const Event& e) { return e.type == type; }));
  }
  Event last(EventType type) const {
    for (auto e = director_.events().rbegin(); e != director_.events().rend(); ++e)
      if (e->type == type) return *e;
    return {};
  }
  std::optional<double> metric(const char* name) const {
    const ScoringContext context =
        scoring_context(exercise_, level_, director_.board(), director_.events(), director_.outcome());
    std::vector<Metric> sink;
    add_palpate_metrics(director_.events(), context, sink);
    for (const Metric& one : sink)
      if (one.name == name) return one.value;
    ADD_FAILURE() << name;
    return {};
  }

  Exercise exercise_;
  ExerciseLevel level_;
  Director director_;
  StylusState state_;
};

TEST_F(PalpateTest, AsksToSearchAndTellsNothingOfTheNodules) {
  EXPECT_EQ(director_.status().cue, Cue::kSearch);
  Percept percept;
  show_cue(director_.status(), percept);
  EXPECT_LT((percept.target_T - director_.board().centre_T).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(percept.object.size_m.x(), 0.045);
  EXPECT_TRUE(director_.board().targets.empty()) << "what is a target is drawn";
  EXPECT_GT(director_.status().grip.stiffness_n_per_m, 0) << "something to pinch";
}

TEST_F(PalpateTest, AMarkOverEachEndsItAndAllAreFound) {
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(director_.status().mark_count, static_cast<int>(i));
    mark(places()[i] + Vec3(0.002, 0, 0));
  }
  EXPECT_EQ(director_.status().phase, Phase::kDone);
  EXPECT_EQ(count(event_type::kNoduleFound), 3);
  EXPECT_EQ(count(event_type::kFalseMark), 0);
  EXPECT_NEAR(last(event_type::kNoduleFound).value, 0.002, 2e-4) << "on a plane: the way along it, but for a curve";
  EXPECT_EQ(count(event_type::kSearchEnded), 1);
  EXPECT_DOUBLE_EQ(*metric("search_share"), 1);
  EXPECT_NEAR(*metric("localisation_error_m"), 0.002, 2e-4);
  EXPECT_GT(*metric("searched_share"), 0);
  EXPECT_LT(*metric("searched_share"), 0.2) << "three cells of 25";
}

TEST_F(PalpateTest, TheFirstPressOfEachCellIsJudgedAtItsMost) {
  const auto one = [&](const Vec3& place, std::initializer_list<double> forces) {
    for (const double force_n : forces) {
      press(place, force_n);
      feed(0.05);
    }
    lift();
    feed(0.05);
  };
  const double cell = 1 / 25.0;
  EXPECT_FALSE(metric("pressed_well_share")) << "nothing was pressed";
  one({0, 0, 0}, {0.1, 0.15});
  EXPECT_FALSE(metric("pressed_well_share")) << "brushed";
  one({0, 0, 0}, {0.3, 1.0, 0.5});
  EXPECT_NEAR(*metric("pressed_well_share"), cell, 1e-12);
  one({0.009, 0, 0}, {0.3, 1.3, 1.0});
  EXPECT_EQ(last(event_type::kPlacePressed).severity, Severity::kMinor) << "too hard for a moment";
  one({0.009, 0, 0}, {1.0});
  EXPECT_NEAR(*metric("pressed_well_share"), cell, 1e-12) << "pressing it again well mends nothing";
  one({0, 0.009, 0}, {0.5});
  EXPECT_NEAR(*metric("pressed_well_share"), cell, 1e-12) << "too light";
  one({0.030, 0, 0}, {1.0});
  EXPECT_NEAR(*metric("pressed_well_share"), cell, 1e-12) << "beside the region";
  press({-0.018, -0.018, 0}, 1);
  feed(0.05);
  press({0, -0.018, 0}, 0.9);
  feed(0.05);
  lift();
  feed(0.05);
  EXPECT_NEAR(*metric("pressed_well_share"), 2 * cell, 1e-12) << "drawn along it is one press, where it was hardest";
  EXPECT_EQ(count(event_type::kPlacePressed), 4);
}

TEST_F(PalpateTest, BesideTheMarginIsFalse) {
  const double reach =
      own_rules<PalpateRules>(exercise_).nodules[0].radius_m + own_rules<PalpateRules>(exercise_).hit_m;
  mark(places()[0] + Vec3(reach + 0.0005, 0, 0));
  EXPECT_EQ(count(event_type::kFalseMark), 1);
  EXPECT_NEAR(last(event_type::kFalseMark).value, reach + 0.0005, 1e-9);
  EXPECT_NEAR(*metric("search_share"), -1 / 3.0, 1e-12);
  EXPECT_FALSE(metric("localisation_error_m")) << "nothing was found";
  EXPECT_FALSE(metric("searched_share")) << "the search has not ended";
}

TEST_F(PalpateTest, TheSameNoduleIsFoundOnce) {
  mark(places()[0]);
  mark(places()[0]);
  EXPECT_EQ(count(event_type::kNoduleFound), 1);
  EXPECT_EQ(count(event_type::kFalseMark), 1);
}

TEST_F(PalpateTest, ALongPinchIsOneMark) {
  press(places()[0]);
  pinch(1, 10);
  EXPECT_EQ(director_.status().mark_count, 1);
}

TEST_F(PalpateTest, ShortOrLightOrInTheAirMarksNothing) {
  press(places()[0]);
  pinch(1, 1.2);
  pinch(0.4, 3);
  lift();
  pinch(1, 3);
  EXPECT_EQ(director_.status().mark_count, 0);
}

TEST_F(PalpateTest, WhoWandersMarksNothing) {
  for (int i = 0; i < 30; ++i) {
    press(places()[0] + Vec3(0.001 * i, 0, 0));
    state_.grip_force_n = 1;
    feed(0.1);
  }
  EXPECT_EQ(director_.status().mark_count, 0);
}

TEST_F(PalpateTest, TheClutchMarksNothing) {
  press(places()[0]);
  state_.clutched = true;
  pinch(1, 3);
  EXPECT_EQ(director_.status().mark_count, 0);
  state_.clutched = false;
  pinch(1, 1.6);
  EXPECT_EQ(director_.status().mark_count, 1);
}

TEST_F(PalpateTest, APinchInTheStartBallEndsItUnfinished) {
  mark(places()[0]);
  state_.X_TI.p = board().start_T;
  feed(0.1);
  pinch(1, 1.6);
  EXPECT_EQ(director_.status().phase, Phase::kDone);
  const ScoringContext context =
      scoring_context(exercise_, level_, director_.board(), director_.events(), director_.outcome());
  EXPECT_EQ(context.objects_total, 3);
  EXPECT_EQ(context.objects_done, 1) << "what stays in is not done: no pass";
}

TEST_F(PalpateTest, WhatIsHiddenIsNotSaidAboveL1) {
  mark(places()[0] + Vec3(0.02, 0, 0));
  EXPECT_EQ(director_.status().message, "Marked");
  EXPECT_EQ(director_.status().wrong_places, 0);
}

class EasyPalpateTest : public PalpateTest {
 protected:
  EasyPalpateTest() : PalpateTest("L1") {}
};

TEST_F(EasyPalpateTest, L1SaysAtOnceWhetherAMarkIsRight) {
  mark(places()[0] + Vec3(0.02, 0, 0));
  EXPECT_EQ(director_.status().message, "Nothing there");
  EXPECT_EQ(director_.status().wrong_places, 1);
  mark(places()[0]);
  EXPECT_EQ(director_.status().message, "Found");
}

TEST_F(PalpateTest, PlacesAreComparedAtRest) {
  TissueFrame tissue;
  tissue.touched_rest_T = places()[1];
  press(places()[1] + Vec3(0.02, 0, -0.01));  // dragged along and pressed in
  state_.grip_force_n = 1;
  for (int i = 0; i < 160; ++i) {
    state_.t_s += 0.01;
    director_.update(state_, &tissue);
  }
  EXPECT_EQ(count(event_type::kNoduleFound), 1);
  EXPECT_NEAR(last(event_type::kNoduleFound).value, 0, 1e-9);
}

}  // namespace
}  // namespace trocar::palpate_task_test
