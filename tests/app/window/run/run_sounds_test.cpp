// What is heard of an attempt, by a player that notes what it is told in place of the one with a device.
#include "app/window/run/run_sounds.h"

#include <gtest/gtest.h>

#include <vector>

#include "app/window/pages/sound_page.h"
#include "tests/app/window/pages/practice_bench.h"
#include "tests/app/window/pages/ui_bench.h"

namespace trocar {
namespace {

struct Heard {
  std::vector<Tone> tones;
  double force = -1, cautery = -1;
};
Heard heard;

}  // namespace

struct Sound::State {};
Sound::Sound(bool /*wanted*/) {}
Sound::~Sound() = default;
void Sound::play(Tone tone) { heard.tones.push_back(tone); }
void Sound::hold_force(double level) { heard.force = level; }
void Sound::hold_cautery(double level) { heard.cautery = level; }
bool Sound::audible() const { return true; }
const std::string& Sound::refusal() const {
  static const std::string none;
  return none;
}

namespace {

using Tones = std::vector<Tone>;

class RunSoundsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    heard = {};
    scene_.setup.exercise.kind = ExerciseKind::kTouch;
    scene_.setup.exercise.hard_force_n = 1.5;
    scene_.setup.exercise.grip.excess_n = 2.5;
    moment_.status.phase = Phase::kRun;
    moment_.status.demand.band = {0.4, 0.8};
  }
  /// What this moment adds.
  Tones hear() {
    heard.tones.clear();
    sounds_.hear(scene_, moment_, sound_);
    return heard.tones;
  }
  /// Slanted: the size counts.
  void press(double n) { moment_.record.stylus.F_I_T.force = {0.6 * n, 0, 0.8 * n}; }

  Scene scene_;
  RunMoment moment_;
  RunSounds sounds_;
  Sound sound_{true};
};

TEST_F(RunSoundsTest, CurrentIsHeardWhileItFlowsIntoTissue) {
  hear();
  EXPECT_EQ(heard.cautery, 0);
  moment_.record.stylus.pedal = true;
  hear();
  EXPECT_EQ(heard.cautery, 0) << "in the air";
  moment_.tissue.surgery.contact_c = 50;
  hear();
  EXPECT_GT(heard.cautery, 0);
  RunSounds::hush(sound_);
  EXPECT_EQ(heard.cautery, 0);
  moment_.record.stylus.pedal = false;
  hear();
  EXPECT_EQ(heard.cautery, 0) << "the tissue is still warm";
}

TEST_F(RunSoundsTest, WhatStoodSoBeforeTheFirstMomentIsNoNews) {
  moment_.record.stylus.contact = true;
  moment_.record.stylus.loop = LoopState::kFault;
  moment_.status.targets_done = 3;
  moment_.status.excess_forces = 2;
  moment_.status.phase = Phase::kDone;
  EXPECT_EQ(hear(), Tones{});
  EXPECT_EQ(hear(), Tones{});
}

TEST_F(RunSoundsTest, TouchingAndLettingGoAreHeardOnceEach) {
  hear();
  moment_.record.stylus.contact = true;
  EXPECT_EQ(hear(), Tones{Tone::kTouch});
  EXPECT_EQ(hear(), Tones{}) << "not again while it lasts";
  moment_.record.stylus.contact = false;
  EXPECT_EQ(hear(), Tones{Tone::kRelease});
}

TEST_F(RunSoundsTest, DoneTargetsAndErrorsAreHeardWhenTheirCountGrows) {
  hear();
  moment_.status.targets_done = 1;
  EXPECT_EQ(hear(), Tones{Tone::kGood});
  moment_.status.excess_forces = 1;
  EXPECT_EQ(hear(), Tones{Tone::kTooMuch});
  moment_.status.wrong_places = 1;
  EXPECT_EQ(hear(), Tones{Tone::kTooMuch}) << "a wrong place as well";
  EXPECT_EQ(hear(), Tones{});
  moment_.status.targets_done = 0;
  EXPECT_EQ(hear(), Tones{}) << "a block that fell out of its ring is no success";
}

TEST_F(RunSoundsTest, EndAndTimeOutSoundAlikeAndAFaultIsNoEnd) {
  for (const Phase phase : {Phase::kDone, Phase::kTimeout}) {
    sounds_ = {};
    moment_.status.phase = Phase::kRun;
    hear();
    moment_.status.phase = phase;
    EXPECT_EQ(hear(), Tones{Tone::kDone});
    EXPECT_EQ(hear(), Tones{});
  }
  sounds_ = {};
  moment_.status.phase = Phase::kRun;
  hear();
  moment_.status.phase = Phase::kFault;
  moment_.record.stylus.loop = LoopState::kFault;
  EXPECT_EQ(hear(), Tones{Tone::kFault});
  EXPECT_EQ(hear(), Tones{});
}

TEST_F(RunSoundsTest, AForceThatPassesItsBandWarnsOnceAndAgainOnlyAfterItWasBack) {
  hear();
  press(0.8);
  EXPECT_EQ(hear(), Tones{}) << "at the end of the band all is well";
  press(0.81);
  EXPECT_EQ(hear(), Tones{Tone::kWarning});
  for (const double n : {1.2, 0.79, 0.82, 0.75, 0.9}) {
    press(n);
    EXPECT_EQ(hear(), Tones{}) << n << " N: it plays about the band's end";
  }
  press(0.6);
  EXPECT_EQ(hear(), Tones{});
  press(0.81);
  EXPECT_EQ(hear(), Tones{Tone::kWarning});
}

TEST_F(RunSoundsTest, NothingWarnsOfAForceThatTheLevelKeepsToItself) {
  scene_.level.force_display = "after";
  hear();
  press(1.4);
  EXPECT_EQ(hear(), Tones{});
}

TEST_F(RunSoundsTest, ThePortThatHoldsAndATimeThatRanOutWarnOnceEach) {
  hear();
  moment_.record.stylus.port_held = true;
  EXPECT_EQ(hear(), Tones{Tone::kWarning});
  EXPECT_EQ(hear(), Tones{});
  moment_.record.stylus.port_held = false;
  EXPECT_EQ(hear(), Tones{});
  moment_.status.timeouts = 1;
  EXPECT_EQ(hear(), Tones{Tone::kWarning});
  EXPECT_EQ(hear(), Tones{});
}

TEST_F(RunSoundsTest, AnErrorInTheSameMomentTakesTheWarningsPlace) {
  hear();
  press(2);
  moment_.status.excess_forces = 1;
  EXPECT_EQ(hear(), Tones{Tone::kTooMuch}) << "one sound for one thing";
}

TEST_F(RunSoundsTest, HumRisesFromTheBandToTheLimit) {
  using Pair = std::pair<double, double>;
  for (const auto& [force, tone] : {Pair{0, 0}, Pair{0.8, 0}, Pair{1.15, 0.5}, Pair{1.5, 1}, Pair{9, 1}}) {
    press(force);
    EXPECT_NEAR(force_tone(scene_, moment_), tone, 1e-12) << force << " N";
    hear();
    EXPECT_NEAR(heard.force, tone, 1e-12) << "said with every moment";
  }
  RunSounds::hush(sound_);
  EXPECT_EQ(heard.force, 0) << "nothing lasts over a pause";
}

TEST_F(RunSoundsTest, HumIsSilentWhereNoForceIsShown) {
  press(1.5);
  ASSERT_EQ(force_tone(scene_, moment_), 1);
  moment_.status.force_shown = false;
  EXPECT_EQ(force_tone(scene_, moment_), 0);
  moment_.status.force_shown = true;
  scene_.level.force_display = "after";
  EXPECT_EQ(force_tone(scene_, moment_), 0);
  scene_.level.force_display = "band";
  EXPECT_EQ(force_tone(scene_, moment_), 1);
  for (const Phase phase : {Phase::kReady, Phase::kArmed, Phase::kDone}) {
    moment_.status.phase = phase;
    EXPECT_EQ(force_tone(scene_, moment_), 0) << "only while it runs";
  }
}

TEST_F(RunSoundsTest, WhileItIsAskedToGripTheGripIsHeardAndNotTheTip) {
  moment_.status.cue = Cue::kGrip;
  moment_.status.demand.band = {1, 1.5};
  press(9);
  EXPECT_EQ(force_tone(scene_, moment_), 0);
  moment_.record.stylus.grip_force_n = 2;
  EXPECT_NEAR(force_tone(scene_, moment_), 0.5, 1e-12);
}

TEST_F(RunSoundsTest, WithoutABandOrWithALimitBelowItNothingHums) {
  press(9);
  moment_.status.demand.band = {0, 0};
  EXPECT_EQ(force_tone(scene_, moment_), 0);
  moment_.status.demand.band = {1, 1.5};
  EXPECT_EQ(force_tone(scene_, moment_), 0) << "no division by the width of nothing";
}

/// The help's page of sounds, worked by keys.
class SoundPageTest : public testing_support::UiBench {
 protected:
  void SetUp() override {
    UiBench::SetUp();
    heard = {};
    model_ = bench_.model();
  }
  void page(const std::vector<InputEvent>& events = {}, bool up = true) {
    frame(
        [&](Ui& ui) {
          ui.begin_panel("help", {0, 0, 1280, 720});
          if (up) page_.frame(ui, *model_);
          ui.end_panel();
          page_.pass(model_->sound(), up, 0.1);
        },
        events);
  }
  void choose(int nth) {
    page();
    for (int i = 0; i < nth; ++i) page(testing_support::press(kKeyTab));
    page(testing_support::press(kKeyEnter));
    page();
  }
  testing_support::PracticeBench bench_;
  std::unique_ptr<PracticeModel> model_;
  SoundPage page_;
};

TEST_F(SoundPageTest, EverySoundIsListedAndTheChosenOneIsHeard) {
  choose(5);
  EXPECT_EQ(heard.tones, Tones{Tone::kWarning});
  for (const char* said : {"Short high note", "Low double buzz", "Two equal notes", "Hum that rises", "Buzz"})
    EXPECT_TRUE(text(said)) << said;
}

TEST_F(SoundPageTest, AToneThatLastsComesToItsEnd) {
  choose(9);
  EXPECT_GT(heard.cautery, 0.5);
  for (int i = 0; i < 20; ++i) page();
  EXPECT_EQ(heard.cautery, 0);
}

TEST_F(SoundPageTest, LeavingThePageSilencesIt) {
  choose(8);
  EXPECT_GT(heard.force, 0.5);
  page({}, false);
  EXPECT_EQ(heard.force, 0);
  heard.force = -1;
  for (int i = 0; i < 20; ++i) page({}, false);
  heard.force = -1;
  page({}, false);
  EXPECT_EQ(heard.force, -1) << "and leaves the run's own hum alone";
}

}  // namespace
}  // namespace trocar
