// The list before the signature: each line turns with the one thing that it is about, and only for who may sign.
#include <gtest/gtest.h>

#include "tests/trainees/desk/pages/page_checker.h"
#include "tests/trainees/desk/pages/page_samples.h"
#include "trainees/desk/pages/attempt_parts.h"

namespace trocar::review::sign_checklist_test {
namespace {

AttemptView clean_attempt() {
  AttemptView view = sample_attempt(90, 1.2);
  view.result.device.overruns = 0;
  view.result.device.saturated_contact_share = 0;
  view.result.device.fault.clear();
  view.result.integrity.clear();
  return view;
}

/// Words of the lines that are not in order.
std::vector<std::string> faults(const AttemptView& view) {
  std::vector<std::string> out;
  for (const SignCheck& check : sign_checks(view))
    if (!check.fine) out.push_back(check.words);
  return out;
}

using Lines = std::vector<std::string>;

TEST(SignChecklist, ACleanAttemptHasFiveLinesInOrder) {
  const auto checks = sign_checks(clean_attempt());
  EXPECT_EQ(checks.size(), 5U);
  EXPECT_EQ(faults(clean_attempt()), Lines{});
}

TEST(SignChecklist, EachLineTurnsWithItsOwnFault) {
  AttemptView view = clean_attempt();
  view.result.grade.status = AttemptStatus::kTimeout;
  EXPECT_EQ(faults(view), Lines{std::string("Not finished: ") + status_name(AttemptStatus::kTimeout)});
  view = clean_attempt();
  view.result.events.push_back({41, "TISSUE_TORN", Severity::kCritical, -1, 6.1, "N", Vec3::Zero()});
  EXPECT_EQ(faults(view), Lines{"1 critical event"});
  view = clean_attempt();
  view.result.grade.caps = {{.kind = CapKind::kGate, .subject = "in_band", .below = 0.5, .at_most = 59},
                            {.kind = CapKind::kUnfinished, .done = 7, .total = 12, .at_most = 28.6}};
  EXPECT_EQ(faults(view), Lines{"1 safety gate not met"});
  view = clean_attempt();
  view.result.device.ticks = 1000;
  view.result.device.overruns = 10;
  EXPECT_EQ(faults(view), Lines{});
  view.result.device.overruns = 11;
  EXPECT_EQ(faults(view), Lines{"Device late: 11 of 1000 ticks missed"});
  view.late_share = 0.02;
  EXPECT_EQ(faults(view), Lines{});
  view.result.device.saturated_contact_share = 0.06;
  EXPECT_EQ(faults(view).at(0).substr(0, 26), "Forces were not all felt: ");
  view.result.device.fault = "encoder jump";
  EXPECT_EQ(faults(view), Lines{"The device reported a fault: encoder jump"});
  view = clean_attempt();
  view.trace.reset();
  view.no_trace = "its recording was erased";
  EXPECT_EQ(faults(view), Lines{"No recording to look at: its recording was erased"});
  view.result.integrity = "aborted: window closed";
  EXPECT_EQ(faults(view), Lines{"Remark in the record: aborted: window closed"});
}

TEST(SignChecklist, ALoopWithoutPriorityIsLookedAt) {
  AttemptView view = clean_attempt();
  view.result.device.realtime = R"({"lanes":{"haptic":{"policy":"SCHED_OTHER","refused":"Operation not permitted"}}})";
  EXPECT_EQ(faults(view), Lines{"Soft real time: no priority for the loop (0 of 60000 ticks missed)"});
  view.result.device.backend = "pointer";
  EXPECT_EQ(faults(view), Lines{}) << "nothing was felt, so nothing could come late";
}

TEST(SignChecklist, WithoutAGateItSaysSo) {
  AttemptView view = clean_attempt();
  for (Subscore& part : view.result.grade.subscores) part.gate = false;
  EXPECT_EQ(sign_checks(view)[2].words, "This exercise has no safety gate");
}

TEST(SignChecklist, StandsOnlyWhereSomebodyMaySignAndEscapesWhatItSays) {
  AttemptView view = clean_attempt();
  view.result.integrity = kHostile;
  Frame frame = sample_frame();
  CheckedPage page = check_page(attempt_page(view, frame));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_EQ(page.all("ul", "checks").size(), 1U);
  frame.may_write = false;
  page = check_page(attempt_page(view, frame));
  EXPECT_EQ(page.all("ul", "checks").size(), 0U);
}

}  // namespace
}  // namespace trocar::review::sign_checklist_test
