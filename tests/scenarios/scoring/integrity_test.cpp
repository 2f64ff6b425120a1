// What makes a trace unfit for grading.
#include "scenarios/scoring/integrity.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace trocar::integrity_test {
namespace {

Trace still(int ticks) {
  Trace trace;
  for (int i = 0; i < ticks; ++i) {
    TraceSample sample;
    sample.t_s = 5 + i * 1e-3;
    trace.samples.push_back(sample);
  }
  return trace;
}

TEST(Integrity, AcceptsASoundTrace) { EXPECT_EQ(integrity_fault(still(1000), {}), ""); }

TEST(Integrity, RefusesAnEmptyTrace) { EXPECT_NE(integrity_fault(Trace{}, {}), ""); }

TEST(Integrity, RefusesValuesThatAreNotFiniteInAnyField) {
  const double bad[] = {std::nan(""), std::numeric_limits<double>::infinity()};
  for (const double value : bad) {
    for (int field = 0; field < 7; ++field) {
      Trace trace = still(100);
      TraceSample& sample = trace.samples[40];
      if (field == 0) sample.t_s = value;
      if (field == 1) sample.tip_T.y() = value;
      if (field == 2) sample.shaft_T.z() = value;
      if (field == 3) sample.force_T.x() = value;
      if (field == 4) sample.rendered_n = value;
      if (field == 5) sample.grip_n = value;
      if (field == 6) sample.jaw_opening_m = value;
      EXPECT_NE(integrity_fault(trace, {}).find("not finite at sample 40"), std::string::npos) << field;
    }
  }
}

TEST(Integrity, RefusesAJumpOfFiftyMillimetresInAMillisecond) {
  Trace trace = still(100);
  for (std::size_t i = 50; i < 100; ++i) trace.samples[i].tip_T.x() = 0.049;
  EXPECT_EQ(integrity_fault(trace, {}), "") << "49 mm is still believed";
  for (std::size_t i = 50; i < 100; ++i) trace.samples[i].tip_T.x() = 0.051;
  EXPECT_NE(integrity_fault(trace, {}).find("jumps at sample 50"), std::string::npos);
}

TEST(Integrity, RefusesTimeThatDoesNotIncrease) {
  Trace trace = still(100);
  trace.samples[60].t_s = trace.samples[59].t_s;
  EXPECT_NE(integrity_fault(trace, {}).find("time does not increase at sample 60"), std::string::npos);
  trace.samples[60].t_s = trace.samples[59].t_s - 0.01;
  EXPECT_NE(integrity_fault(trace, {}), "");
}

TEST(Integrity, ForgivesOnePercentOfMissingTicksAndNoMore) {
  Trace trace = still(1001);
  trace.samples.erase(trace.samples.begin() + 300, trace.samples.begin() + 310);
  EXPECT_EQ(integrity_fault(trace, {}), "");
  trace.samples.erase(trace.samples.begin() + 500, trace.samples.begin() + 501);
  EXPECT_NE(integrity_fault(trace, {}).find("11 of 1001 ticks are missing"), std::string::npos);
}

TEST(Integrity, RefusesEventsOutOfOrderOrNotFinite) {
  Event first, second;
  first.t_s = 5.02;
  second.t_s = 5.01;
  second.type = "WRONG_PLACE";
  EXPECT_NE(integrity_fault(still(100), {first, second}).find("WRONG_PLACE"), std::string::npos);
  EXPECT_EQ(integrity_fault(still(100), {second, first}), "");
  first.value = std::nan("");
  EXPECT_NE(integrity_fault(still(100), {first}).find("not finite"), std::string::npos);
}

TEST(Integrity, RefusesAnInvalidRate) {
  Trace trace = still(10);
  trace.rate_hz = 0;
  EXPECT_NE(integrity_fault(trace, {}).find("rate"), std::string::npos);
}

}  // namespace
}  // namespace trocar::integrity_test
