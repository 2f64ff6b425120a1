// What is done to an organ becomes events: each once, with its place and its number.
#include "scenarios/director/surgery_watch.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tissue/mesh/surface/cut_tracing.h"

namespace trocar::surgery_watch_test {
namespace {

class SurgeryWatching : public testing::Test {
 protected:
  void feed(int steps = 1) {
    for (int i = 0; i < steps; ++i) {
      log_.t_s += 0.01;
      watch_.update(now_, 0.01, log_);
    }
  }
  std::vector<Event> of(EventType type) const {
    std::vector<Event> out;
    std::copy_if(log_.events.begin(), log_.events.end(), std::back_inserter(out),
                 [&](const Event& event) { return event.type == type; });
    return out;
  }
  SurgeryState now_;
  SurgeryWatch watch_;
  EventLog log_;
};

TEST_F(SurgeryWatching, NothingDoneIsNoEvent) {
  feed(500);
  EXPECT_TRUE(log_.events.empty());
}

TEST_F(SurgeryWatching, ACutATearAndAClipAreToldOnceAndWhere) {
  log_.tip_T = Vec3(0.01, 0.02, 0.03);
  now_.cuts = 1;
  now_.cut_m = 0.012;
  feed(20);
  now_.tears = 1;
  now_.cut_m = 0.009;
  feed(20);
  now_.clips = 1;
  feed(20);
  ASSERT_EQ(log_.events.size(), 3U);
  EXPECT_EQ(of(event_type::kCut).at(0).value, 0.012);
  EXPECT_EQ(of(event_type::kCut).at(0).unit, "m");
  EXPECT_EQ(of(event_type::kCut).at(0).tip_T, log_.tip_T);
  EXPECT_NEAR(of(event_type::kCut).at(0).t_s, 0.01, 1e-12);
  EXPECT_EQ(of(event_type::kTear).at(0).value, 0.009);
  EXPECT_EQ(of(event_type::kClip).at(0).value, 1);
}

TEST_F(SurgeryWatching, WhatIsStitchedIsToldOnce) {
  SutureState sewn;
  sewn.needles = 1;
  TissueFrame before;
  before.suture = sewn;
  watch_.skip(before);
  sewn.punctures = 2;
  sewn.stitches = 1;
  for (int i = 0; i < 5; ++i) watch_.update(sewn, log_);
  sewn.throws = 1;
  watch_.update(sewn, log_);
  EXPECT_TRUE(of(event_type::kNeedle).empty()) << "before the run";
  ASSERT_EQ(of(event_type::kPuncture).size(), 2U);
  EXPECT_EQ(of(event_type::kPuncture)[1].value, 2);
  EXPECT_EQ(of(event_type::kStitch).size(), 1U);
  EXPECT_EQ(of(event_type::kThrow).size(), 1U);
}

TEST_F(SurgeryWatching, ARefusalSaysWhyEveryTime) {
  now_.refusals = 1;
  now_.refusal = static_cast<std::int32_t>(CutRefusal::kThrough);
  feed(5);
  now_.refusals = 2;
  now_.refusal = static_cast<std::int32_t>(CutRefusal::kNoWound);
  feed(5);
  const auto refused = of(event_type::kRefused);
  ASSERT_EQ(refused.size(), 2U);
  EXPECT_EQ(refused[0].unit, refusal_words(CutRefusal::kThrough));
  EXPECT_EQ(refused[1].unit, refusal_words(CutRefusal::kNoWound));
}

TEST_F(SurgeryWatching, BleedingIsToldWhenItBeginsAndEveryTenMillilitres) {
  now_.blood_ml_per_min = 60;
  for (int i = 0; i < 2500; ++i) {
    now_.blood_ml += 0.01;
    feed();
  }
  const auto told = of(event_type::kBleeding);
  ASSERT_EQ(told.size(), 3U) << "at once, 10 mL, 20 mL";
  EXPECT_NEAR(told[0].value, 0.01, 1e-9);
  EXPECT_NEAR(told[1].value, 10, 0.011);
  EXPECT_NEAR(told[2].value, 20, 0.011);
  EXPECT_EQ(told[0].unit, "mL");
  now_.blood_ml_per_min = 0;
  feed(200);
  now_.blood_ml_per_min = 2;
  feed(10);
  EXPECT_EQ(of(event_type::kBleeding).size(), 4U) << "it begins again";
}

TEST_F(SurgeryWatching, ABurnBeginsAboveSixtyDegrees) {
  now_.contact_c = 59;
  feed(50);
  EXPECT_TRUE(of(event_type::kBurn).empty());
  now_.contact_c = 61;
  feed(50);
  now_.contact_c = 90;
  feed(50);
  ASSERT_EQ(of(event_type::kBurn).size(), 1U);
  EXPECT_EQ(of(event_type::kBurn)[0].value, 61);
  now_.contact_c = 0;
  feed(50);
  now_.contact_c = 70;
  feed();
  EXPECT_EQ(of(event_type::kBurn).size(), 2U);
}

TEST_F(SurgeryWatching, WhatWasDoneBeforeTheRunIsNoEvent) {
  now_.cuts = 3;
  now_.blood_ml = 25;
  TissueFrame before;
  before.surgery = now_;
  watch_.skip(before);
  feed(10);
  EXPECT_TRUE(log_.events.empty());
  now_.cuts = 4;
  feed(10);
  EXPECT_EQ(log_.events.size(), 1U);
}

}  // namespace
}  // namespace trocar::surgery_watch_test
