// The director against scripted states: phases, discs, wrong places, forces, the block, time and faults.
#include "scenarios/director/director.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "scenarios/director/cue_percept.h"
#include "scenarios/files/exercise_loader.h"
#include "tissue/tissue_frame.h"

namespace trocar::director_test {
namespace {

/// A flat board of two discs and a director that is fed one state after the other at 100 Hz.
class DirectorTest : public testing::Test {
 protected:
  DirectorTest()
      : exercise_(load_exercise(std::filesystem::path(TROCAR_SOURCE_DIR) / "scenarios/exercises/surface-touch.toml")),
        director_(exercise_, exercise_.levels[0], board()) {
    state_.loop = LoopState::kActive;
    state_.jaw_opening_m = 0.02;
    state_.X_TI.p = Vec3(0, 0, 0.1);
  }

  static Board board() {
    Board board;
    board.start_T = Vec3(0, 0, 0.045);
    for (const double x : {0.02, -0.02})
      board.targets.push_back({Vec3(x, 0, 0), Vec3::UnitZ(), 0.003, {0.4, 0.8}, Mat3::Identity()});
    return board;
  }

  void feed(double seconds) {
    const int updates = static_cast<int>(std::lround(seconds * 100));
    for (int i = 0; i < updates; ++i) {
      state_.t_s += 0.01;
      director_.update(state_, tissue_ ? &*tissue_ : nullptr);
    }
  }
  void at(const Vec3& tip) {
    state_.X_TI.p = tip;
    state_.contact = state_.tip_contact = false;
    state_.F_I_T = {};
  }
  void pressing(const Vec3& point, double force_n) {
    state_.X_TI.p = point;
    state_.contact = state_.tip_contact = true;
    state_.contact_point_T = point;
    state_.F_I_T.force = Vec3(0, 0, force_n);
  }
  void start() {
    at(Vec3(0, 0, 0.045));
    feed(1.1);
  }
  void hold_disc(int index) {
    at(board().targets[static_cast<std::size_t>(index)].centre_T + Vec3(0, 0, 0.01));
    feed(0.3);
    pressing(board().targets[static_cast<std::size_t>(index)].centre_T, 0.6);
    feed(1.1);
    at(Vec3(0, 0, 0.03));
    feed(0.3);
  }
  int count(const std::string& type) const {
    return static_cast<int>(std::count_if(director_.events().begin(), director_.events().end(),
                                          [&](const Event& e) { return e.type == type; }));
  }
  const Event& last(const std::string& type) const {
    for (auto it = director_.events().rbegin(); it != director_.events().rend(); ++it)
      if (it->type == type) return *it;
    ADD_FAILURE() << "no event " << type;
    return director_.events().front();
  }

  Exercise exercise_;
  Director director_;
  StylusState state_;
  std::optional<TissueFrame> tissue_;
};

TEST_F(DirectorTest, ADiscGoesAlongWithTissueThatGivesWay) {
  const Vec3 moved(0.02, 0.005, -0.008), normal = Vec3(0, 0.6, 0.8);
  tissue_.emplace();
  tissue_->place_count = 2;
  tissue_->place[0] = {moved, normal};
  tissue_->place[1] = {board().targets[1].centre_T, Vec3::UnitZ()};
  start();
  EXPECT_EQ(director_.status().demand.centre_T, moved);
  EXPECT_EQ(director_.status().demand.normal_T, normal);
  pressing(moved - Vec3(0, 0, 0.01), 0.6);  // the felt surface is without the tool's own dent
  tissue_->touched_rest_T = board().targets[0].centre_T + Vec3(0.001, 0, 0);
  feed(1.1);
  EXPECT_EQ(director_.status().targets_done, 1);
  EXPECT_EQ(count("WRONG_PLACE"), 0);
  // Where the next one is drawn at rest lies other tissue once all has been carried away.
  at(Vec3(0, 0, 0.03));
  feed(0.3);
  pressing(board().targets[1].centre_T, 0.6);
  tissue_->touched_rest_T = board().targets[1].centre_T - Vec3(0, 0.01, 0);
  feed(1.1);
  EXPECT_EQ(director_.status().targets_done, 1);
  EXPECT_EQ(count("WRONG_PLACE"), 1);
  EXPECT_EQ(director_.board().targets[1].centre_T, board().targets[1].centre_T) << "pictures paint them at rest";
}

TEST_F(DirectorTest, ArmsInTheStartBallAndRunsAfterOneSecond) {
  feed(0.5);
  EXPECT_EQ(director_.status().phase, Phase::kReady);
  EXPECT_EQ(director_.status().cue, Cue::kWait);
  at(Vec3(0.004, 0, 0.048));
  feed(0.5);
  EXPECT_EQ(director_.status().phase, Phase::kArmed);
  at(Vec3(0, 0, 0.07));
  feed(0.1);
  EXPECT_EQ(director_.status().phase, Phase::kReady) << "leaving the ball disarms";
  at(Vec3(0, 0, 0.045));
  feed(0.9);
  EXPECT_EQ(director_.status().phase, Phase::kArmed);
  feed(0.2);
  EXPECT_EQ(director_.status().phase, Phase::kRun);
  EXPECT_EQ(count("START"), 1);
  EXPECT_EQ(count("TARGET_LIT"), 1);
  EXPECT_EQ(director_.status().target_index, 0);
  EXPECT_EQ(director_.status().cue, Cue::kReach);
}

TEST_F(DirectorTest, WaitsForTheDevice) {
  state_.loop = LoopState::kHomed;
  at(Vec3(0, 0, 0.045));
  feed(5);
  EXPECT_EQ(director_.status().phase, Phase::kReady);
  EXPECT_FALSE(director_.status().message.empty());
  EXPECT_TRUE(director_.events().empty());
}

TEST_F(DirectorTest, CompletesDiscsThenBlockThenIsDone) {
  start();
  hold_disc(0);
  EXPECT_EQ(director_.status().targets_done, 1);
  EXPECT_EQ(director_.status().target_index, 1);
  hold_disc(1);
  EXPECT_EQ(director_.status().cue, Cue::kGrip);
  EXPECT_DOUBLE_EQ(director_.status().grip.thickness_m, 0.008);
  EXPECT_DOUBLE_EQ(director_.status().grip.stiffness_n_per_m, 300);
  state_.grip_force_n = 0.95;
  feed(1.1);
  EXPECT_TRUE(director_.finished());
  EXPECT_EQ(director_.status().phase, Phase::kDone);
  EXPECT_EQ(director_.outcome(), AttemptStatus::kCompleted);
  EXPECT_EQ(director_.status().cue, Cue::kFinished);
  EXPECT_EQ(director_.status().grip.stiffness_n_per_m, 0) << "the block is taken away";
  for (const char* type : {"START", "GRIP_OFFERED", "GRIP_TOUCHED", "GRIP_HELD", "DONE"}) EXPECT_EQ(count(type), 1);
  EXPECT_EQ(count("TARGET_TOUCHED"), 2);
  EXPECT_EQ(count("TARGET_HELD"), 2);
  EXPECT_EQ(last("GRIP_HELD").object, 2);
  const auto events = director_.events().size();
  feed(5);
  EXPECT_EQ(director_.events().size(), events) << "nothing happens after the end";
}

TEST_F(DirectorTest, EventsAreInOrderOfTimeAndCarryTheTip) {
  start();
  hold_disc(0);
  double before = 0;
  for (const Event& event : director_.events()) {
    EXPECT_GE(event.t_s, before);
    before = event.t_s;
  }
  EXPECT_NEAR((last("TARGET_HELD").tip_T - board().targets[0].centre_T).norm(), 0, 1e-12);
}

TEST_F(DirectorTest, HoldNeedsOneSecondInsideTheBand) {
  start();
  pressing(board().targets[0].centre_T, 0.6);
  feed(0.9);
  EXPECT_EQ(count("TARGET_HELD"), 0);
  EXPECT_NEAR(director_.status().hold_progress, 0.9, 0.02);
  state_.F_I_T.force.z() = 0.9;
  feed(0.08);
  state_.F_I_T.force.z() = 0.6;
  feed(0.08);
  EXPECT_EQ(count("TARGET_HELD"), 0) << "the excursion did not count";
  feed(0.05);
  EXPECT_EQ(count("TARGET_HELD"), 1) << "a short excursion only pauses";
}

TEST_F(DirectorTest, TheClutchHoldsNothing) {
  start();
  pressing(board().targets[0].centre_T, 0.6);
  feed(0.3);
  for (bool StylusState::*frozen : {&StylusState::clutched, &StylusState::port_held}) {
    state_.*frozen = true;
    feed(5);
    EXPECT_EQ(director_.status().hold_progress, 0) << "frozen in the band";
    EXPECT_EQ(count("TARGET_HELD"), 0);
    state_.*frozen = false;
    feed(0.5);
    EXPECT_NEAR(last("INSTRUMENT_FREE").value, 5, 0.02);
  }
  feed(0.6);
  EXPECT_EQ(count("TARGET_HELD"), 1);
  EXPECT_EQ(count("INSTRUMENT_FREE"), 2);
}

TEST_F(DirectorTest, LongExcursionStartsTheHoldAgain) {
  start();
  pressing(board().targets[0].centre_T, 0.6);
  feed(0.9);
  state_.F_I_T.force.z() = 0.2;
  feed(0.2);
  EXPECT_EQ(director_.status().hold_progress, 0);
  state_.F_I_T.force.z() = 0.6;
  feed(0.9);
  EXPECT_EQ(count("TARGET_HELD"), 0);
  feed(0.2);
  EXPECT_EQ(count("TARGET_HELD"), 1);
}

TEST_F(DirectorTest, WrongPlaceIsAContactThatBeginsMoreThanTwoMillimetresOutside) {
  start();
  pressing(Vec3(0.02 + 0.0049, 0, 0), 0.5);
  feed(0.3);
  EXPECT_EQ(count("WRONG_PLACE"), 0);
  EXPECT_EQ(count("TARGET_TOUCHED"), 1);
  at(Vec3(0.02, 0, 0.01));
  feed(0.3);
  pressing(Vec3(0.02 + 0.0052, 0, 0), 0.5);
  feed(0.3);
  EXPECT_EQ(count("WRONG_PLACE"), 1);
  EXPECT_NEAR(last("WRONG_PLACE").value, 0.0022, 1e-9);
  EXPECT_EQ(last("WRONG_PLACE").severity, Severity::kMinor);
  EXPECT_TRUE(director_.status().warning);
  EXPECT_EQ(director_.status().wrong_places, 1);
}

TEST_F(DirectorTest, ABouncingContactIsOneWrongPlace) {
  start();
  for (int i = 0; i < 10; ++i) {
    pressing(Vec3(0, 0.02, 0), 0.3);
    feed(0.05);
    at(Vec3(0, 0.02, 0.001));
    feed(0.05);
  }
  EXPECT_EQ(count("WRONG_PLACE"), 1);
  feed(0.5);
  pressing(Vec3(0, 0.02, 0), 0.3);
  feed(0.05);
  EXPECT_EQ(count("WRONG_PLACE"), 2);
}

TEST_F(DirectorTest, HoldingBesideTheDiscDoesNotCount) {
  start();
  pressing(Vec3(0.02 + 0.0045, 0, 0), 0.6);
  feed(3);
  EXPECT_EQ(count("TARGET_HELD"), 0);
  EXPECT_EQ(director_.status().message, "Move onto the lit disc");
}

TEST_F(DirectorTest, TheShaftCannotHoldADisc) {
  start();
  pressing(board().targets[0].centre_T, 0.6);
  state_.tip_contact = false;
  feed(3);
  EXPECT_EQ(count("TARGET_HELD"), 0);
  EXPECT_EQ(count("TARGET_TOUCHED"), 0);
  state_.F_I_T.force.z() = 2.1;
  feed(0.5);
  EXPECT_EQ(count("TOOL_COLLISION"), 1);
}

TEST_F(DirectorTest, RepeatedTouchesOfTheLitDiscGainNothing) {
  start();
  for (int i = 0; i < 6; ++i) {
    pressing(board().targets[0].centre_T, 0.6);
    feed(0.4);
    at(Vec3(0.02, 0, 0.01));
    feed(0.3);
  }
  EXPECT_EQ(count("TARGET_HELD"), 0);
  EXPECT_EQ(count("TARGET_TOUCHED"), 1);
  EXPECT_EQ(director_.status().targets_done, 0);
}

TEST_F(DirectorTest, ExcessForceCountsOncePerEntryAndRearmsBelowEightyPercent) {
  start();
  pressing(board().targets[0].centre_T, 1.6);
  feed(0.2);
  EXPECT_EQ(count("EXCESS_FORCE"), 1);
  EXPECT_EQ(director_.status().cue, Cue::kRelease);
  state_.F_I_T.force.z() = 1.3;
  feed(1);
  state_.F_I_T.force.z() = 1.6;
  feed(0.1);
  EXPECT_EQ(count("EXCESS_FORCE"), 1) << "1.3 N is not below 0.8 of the limit";
  state_.F_I_T.force.z() = 1.1;
  feed(0.1);
  state_.F_I_T.force.z() = 1.6;
  feed(0.1);
  EXPECT_EQ(count("EXCESS_FORCE"), 1) << "below for less than 0.2 s";
  state_.F_I_T.force.z() = 1.1;
  feed(0.25);
  state_.F_I_T.force.z() = 1.6;
  feed(0.1);
  EXPECT_EQ(count("EXCESS_FORCE"), 2);
  EXPECT_EQ(last("EXCESS_FORCE").severity, Severity::kMajor);
  EXPECT_NEAR(director_.status().peak_force_n, 1.6, 1e-12);
}

TEST_F(DirectorTest, CriticalForceIsCritical) {
  start();
  pressing(board().targets[0].centre_T, 4.8);
  feed(0.1);
  EXPECT_EQ(count("CRITICAL_FORCE"), 1);
  EXPECT_EQ(last("CRITICAL_FORCE").severity, Severity::kCritical);
  EXPECT_NEAR(last("CRITICAL_FORCE").value, 4.8, 1e-12);
}

TEST_F(DirectorTest, ForcesBeforeTheStartAreNotEvents) {
  pressing(Vec3(0, 0, 0.2), 9);
  feed(0.5);
  EXPECT_TRUE(director_.events().empty());
}

TEST_F(DirectorTest, BlockWaitsForOpenJawsAndReportsTooTightASqueeze) {
  state_.jaw_opening_m = 0.004;
  start();
  hold_disc(0);
  hold_disc(1);
  EXPECT_EQ(count("GRIP_OFFERED"), 0);
  EXPECT_EQ(director_.status().grip.stiffness_n_per_m, 0);
  EXPECT_EQ(director_.status().message, "Open the jaws");
  state_.jaw_opening_m = 0.015;
  feed(0.1);
  EXPECT_EQ(count("GRIP_OFFERED"), 1);
  state_.grip_force_n = 2.6;
  feed(0.5);
  EXPECT_EQ(count("GRIP_EXCESS"), 1);
  EXPECT_EQ(director_.status().excess_forces, 1);
  state_.grip_force_n = 1.0;
  feed(1.1);
  EXPECT_EQ(director_.outcome(), AttemptStatus::kCompleted);
}

TEST_F(DirectorTest, TimesOutAtTheLimit) {
  start();
  hold_disc(0);
  feed(121);
  EXPECT_EQ(director_.status().phase, Phase::kTimeout);
  EXPECT_EQ(director_.outcome(), AttemptStatus::kTimeout);
  EXPECT_NEAR(last("TIMEOUT").t_s - last("START").t_s, 120, 0.02);
}

TEST_F(DirectorTest, NeverStartingTimesOutToo) {
  feed(121);
  EXPECT_EQ(director_.outcome(), AttemptStatus::kTimeout);
  EXPECT_EQ(count("START"), 0);
}

TEST_F(DirectorTest, NeverStartingIsVoidWhereThatIsAsked) {
  director_ = Director(exercise_, exercise_.levels[0], board(), Unbegun::kVoid);
  feed(121);
  EXPECT_EQ(director_.outcome(), AttemptStatus::kVoid);
  EXPECT_EQ(director_.status().message, "Not begun");
  EXPECT_EQ(count("START"), 0);
}

TEST_F(DirectorTest, DeviceFaultEndsTheAttempt) {
  start();
  state_.loop = LoopState::kFault;
  state_.fault.code = FaultCode::kOverspeed;
  state_.fault.value = 12;
  feed(0.1);
  EXPECT_EQ(director_.status().phase, Phase::kFault);
  EXPECT_EQ(director_.outcome(), AttemptStatus::kFault);
  EXPECT_EQ(count("DEVICE_FAULT"), 1);
}

TEST_F(DirectorTest, UnfinishedMeansAborted) {
  start();
  EXPECT_FALSE(director_.finished());
  EXPECT_EQ(director_.outcome(), AttemptStatus::kAborted);
}

TEST_F(DirectorTest, ShowsTheHandWhatTheScreenShows) {
  Percept percept;
  show_cue(director_.status(), percept);
  EXPECT_EQ(percept.cue, Cue::kWait);
  EXPECT_EQ(percept.target_T, board().start_T);
  EXPECT_DOUBLE_EQ(percept.target_radius_m, 0.010);
  start();
  show_cue(director_.status(), percept);
  EXPECT_EQ(percept.target_index, 0);
  EXPECT_EQ(percept.target_T, board().targets[0].centre_T);
  EXPECT_DOUBLE_EQ(percept.band_high_n, 0.8);
  hold_disc(0);
  hold_disc(1);
  show_cue(director_.status(), percept);
  EXPECT_EQ(percept.cue, Cue::kGrip);
  EXPECT_DOUBLE_EQ(percept.band_low_n, 0.73);
}

TEST_F(DirectorTest, SaturationIsReportedWithoutFlooding) {
  start();
  for (int i = 0; i < 50; ++i) {
    state_.saturated = i % 2 == 0;
    feed(0.02);
  }
  EXPECT_EQ(count("DEVICE_LIMIT"), 1);
}

TEST_F(DirectorTest, SlidingToTheNextDiscInsteadOfLiftingIsAWrongPlace) {
  start();
  at(board().targets[0].centre_T + Vec3(0, 0, 0.01));
  feed(0.3);
  pressing(board().targets[0].centre_T, 0.6);
  feed(1.1);
  ASSERT_EQ(count("TARGET_HELD"), 1);
  for (int i = 0; i <= 80; ++i) {  // 40 mm along the tissue in 0.8 s, never leaving it
    pressing(board().targets[0].centre_T - Vec3(0.0005 * i, 0, 0), 0.3);
    feed(0.01);
  }
  EXPECT_EQ(count("WRONG_PLACE"), 1) << "once for a disc, however long the slide";
}

TEST_F(DirectorTest, AShortHopToAnotherPlaceIsANewContact) {
  start();
  at(board().targets[0].centre_T + Vec3(0, 0, 0.01));
  feed(0.3);
  pressing(board().targets[0].centre_T, 0.3);
  feed(0.1);
  at(Vec3(0, 0, 0.002));
  feed(0.05);
  pressing(Vec3(0, 0.01, 0), 0.3);
  feed(0.05);
  EXPECT_EQ(count("WRONG_PLACE"), 1);
}

TEST_F(DirectorTest, LastingExcessCountsEachSecond) {
  start();
  at(board().targets[0].centre_T + Vec3(0, 0, 0.01));
  feed(0.3);
  pressing(board().targets[0].centre_T, 2.0);
  feed(3.5);
  EXPECT_EQ(count("EXCESS_FORCE"), 4);
}

}  // namespace
}  // namespace trocar::director_test
