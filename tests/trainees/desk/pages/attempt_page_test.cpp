#include <gtest/gtest.h>

#include <algorithm>

#include "tests/trainees/desk/pages/page_checker.h"
#include "tests/trainees/desk/pages/page_samples.h"
#include "trainees/desk/pages/attempt_parts.h"

namespace trocar::review::attempt_page_test {
namespace {

std::vector<std::string> actions(const CheckedPage& page) {
  std::vector<std::string> out;
  for (const PageElement* form : page.all("form")) out.push_back(form->of("action"));
  return out;
}

bool posts(const CheckedPage& page, const std::string& end) {
  const auto all = actions(page);
  return std::any_of(all.begin(), all.end(), [&](const std::string& action) { return action.ends_with(end); });
}

TEST(AttemptPage, IsSoundAndHasItsParts) {
  const CheckedPage page = check_page(attempt_page(sample_attempt(), sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  for (const char* id :
       {"moment", "points", "events", "sign", "notes", "compare", "path", "metrics", "device", "origin"})
    EXPECT_NE(page.by_id(id), nullptr) << id;
  EXPECT_EQ(page.all("svg", "square").size(), 6U);  // three projections, three maps
}

TEST(AttemptPage, WhatIsNotSignedIsToldAboveWhatPeopleSaid) {
  AttemptView view = sample_attempt();
  const char* const told = "note of this attempt is not signed";
  EXPECT_EQ(attempt_page(view, sample_frame()).find(told), std::string::npos);
  view.unsigned_words = true;
  EXPECT_NE(attempt_page(view, sample_frame()).find(told), std::string::npos);
}

TEST(AttemptPage, ThatItWasChangedStandsAboveItsVerdict) {
  AttemptView view = sample_attempt();
  EXPECT_EQ(attempt_page(view, sample_frame()).find(kChangedAttempt), std::string::npos);
  view.changed = true;
  const std::string page = attempt_page(view, sample_frame());
  EXPECT_LT(page.find("not as it was when it was finished"), page.find("class=\"verdict"));
}

TEST(AttemptPage, VerdictComesFirstWithItsOneReason) {
  const CheckedPage page = check_page(attempt_page(sample_attempt(), sample_frame()));
  const auto band = page.all("section", "verdict");
  ASSERT_EQ(band.size(), 1U);
  EXPECT_EQ(band[0]->text,
            "Not yetSafety gate not met: in band 58 %, the gate asks 65 % or more.58.0 of 100below pass");
  EXPECT_EQ(&page.elements[0] < band[0], true);
  EXPECT_LT(band[0], page.by_id("moment"));
}

TEST(Verdict, ReasonsInTheirOrder) {
  AttemptView view = sample_attempt();
  view.result.events.push_back({41, "TISSUE_TORN", Severity::kCritical, -1, 6.1, "N", Vec3::Zero()});
  EXPECT_EQ(verdict_reason(view), "Tissue torn at 41.0 s: 6.1 N.");
  view.result.events.pop_back();
  EXPECT_EQ(verdict_reason(view), "Safety gate not met: in band 58 %, the gate asks 65 % or more.");
  view.result.grade.caps = {{.kind = CapKind::kUnfinished, .done = 7, .total = 12, .at_most = 28.6}};
  view.result.grade.status = AttemptStatus::kTimeout;
  EXPECT_EQ(verdict_reason(view), "Time ran out, not finished: 7 of 12: at most 28.6.");
  view.result.grade.caps.clear();
  view.result.grade.status = AttemptStatus::kCompleted;
  EXPECT_EQ(verdict_reason(view),
            "Score 58.0, pass 75. Most points went on In band: 58 % (full at 100 %, none at 30 %), 21.0 lost.");
  view.result.grade.passed = true;
  EXPECT_EQ(verdict_reason(view), "Most points went on In band: 58 % (full at 100 %, none at 30 %), 21.0 lost.");
  for (Subscore& part : view.result.grade.subscores) part.value = 1;
  EXPECT_EQ(verdict_reason(view), "Nothing lost.");
  view.result.grade.score.reset();
  view.result.integrity = "aborted: window closed";
  EXPECT_EQ(verdict_reason(view), "aborted: window closed");
}

TEST(Verdict, WhatHasNoValueIsNoReason) {
  AttemptView view = sample_attempt();
  Grade& grade = view.result.grade;
  for (Subscore& part : grade.subscores)
    if (part.gate) part.raw.reset(), part.value = 0;
  grade.caps.push_back({.kind = CapKind::kUnfinished, .done = 0, .total = 12, .at_most = 0});
  grade.status = AttemptStatus::kTimeout;
  const std::string untouched = verdict_reason(view);
  EXPECT_TRUE(untouched.starts_with("Time ran out, not finished: 0 of 12: at most 0.")) << untouched;
  EXPECT_TRUE(untouched.ends_with("In band cannot be judged: nothing was done that it measures.")) << untouched;
  for (int i = 0; i < 13; ++i)
    view.result.events.push_back({10.0 + i, "WRONG_PLACE", Severity::kMinor, -1, 0.004, "m", Vec3::Zero()});
  const std::string beside = verdict_reason(view);
  EXPECT_NE(beside.find("Beside the lit disc 1"), std::string::npos) << beside;
  EXPECT_EQ(beside.find("undefined"), std::string::npos) << beside;
}

TEST(Verdict, EventTimesCountFromTheTracesBeginning) {
  AttemptView view = sample_attempt();
  for (TraceSample& sample : view.trace->samples) sample.t_s += 100;
  view.result.events = {{130, "TISSUE_TORN", Severity::kCritical, -1, 0, "", Vec3::Zero()}};
  EXPECT_EQ(verdict_reason(view), "Tissue torn at 30.0 s.");
  EXPECT_DOUBLE_EQ(peak_moment_s(view), 30);
}

TEST(AttemptPage, PointsLostAreTheWeightedRest) {
  EXPECT_DOUBLE_EQ(points_lost({"a", 0.4, 0.35, {}, "", 1, 0, true}), 21);
  const CheckedPage page = check_page(attempt_page(sample_attempt(), sample_frame()));
  const std::string text = page.by_id("points")->text;
  for (const char* part : {"In band safety gate58 %full at 100 %, none at 30 %0.4035.0 %21.0",
                           "Time36 sfull at 30 s, none at 90 s0.9040.0 %4.0",
                           "safety gate: in band 58 %, the gate asks 65 % or more: at most 59"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(AttemptPage, ScrubsWithoutScript) {
  const CheckedPage page = check_page(attempt_page(sample_attempt(), sample_frame()));
  const std::string base = "/attempt/01890000-aaaa-7bbb-8ccc-000000000001";
  std::map<std::string, std::string> steps;
  for (const PageElement* link : page.all("a", "button")) steps[link->text] = link->of("href");
  EXPECT_EQ(steps["\xE2\x88\x92"
                  "5 s"],
            base + "?t=25.00#moment");
  EXPECT_EQ(steps["+1 s"], base + "?t=31.00#moment");
  EXPECT_EQ(steps["event before"], base + "?t=27.00#moment");
  EXPECT_EQ(steps.count("next event"), 0U);  // the last one is here
  EXPECT_EQ(steps["largest force"], base + "?t=30.00#moment");
  const PageElement* slider = page.by_id("t");
  ASSERT_NE(slider, nullptr);
  EXPECT_EQ(slider->of("max"), "60.0");
  EXPECT_EQ(slider->of("value"), "30.0");
  EXPECT_EQ(page.by_id("picture")->of("src"), base + "/picture.png?t=30.00");
  EXPECT_EQ(page.by_id("now")->text, "30.0 s: 5.20 N at the tip, grip 0.80 N, in contact");
}

TEST(AttemptPage, StepsStayWithinTheAttempt) {
  AttemptView view = sample_attempt();
  view.t_s = 59;
  std::map<std::string, std::string> steps;
  const CheckedPage page = check_page(moment_section(view), "");
  for (const PageElement* link : page.all("a", "button")) steps[link->text] = link->of("href");
  EXPECT_TRUE(steps["+5 s"].ends_with("?t=60.00#moment"));
  EXPECT_TRUE(steps["next event"].empty());
}

TEST(AttemptPage, OverrideStandsBesideTheScore) {
  AttemptView view = sample_attempt();
  view.overrides = {
      {"o2", "ines", "Dr Ines Okafor", "The device slipped out of its stand", "2026-03-20T09:00:00Z", true},
      {"o1", "ines", "Dr Ines Okafor", "First thought better of", "2026-03-19T09:00:00Z", false}};
  const CheckedPage page = check_page(attempt_page(view, sample_frame()));
  const std::string band = page.all("section", "verdict")[0]->text;
  EXPECT_NE(band.find("Passed by decision of Dr Ines Okafor"), std::string::npos);
  EXPECT_NE(band.find("The device slipped out of its stand"), std::string::npos);
  EXPECT_NE(band.find("58.0"), std::string::npos);
  EXPECT_NE(page.by_id("sign")->text.find("First thought better of"), std::string::npos);
}

TEST(AttemptPage, FormsOfInstructorsAndNoneForTrainees) {
  CheckedPage page = check_page(attempt_page(sample_attempt(), sample_frame()));
  for (const char* end : {"/sign", "/override", "/note"}) EXPECT_TRUE(posts(page, end)) << end;
  EXPECT_EQ(page.by_id("override-reason")->of("minlength"), "10");
  Frame trainee = sample_frame();
  trainee.may_write = false;
  page = check_page(attempt_page(sample_attempt(), trainee));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  for (const char* end : {"/sign", "/override", "/note", "/certify", "/compare"}) EXPECT_FALSE(posts(page, end)) << end;
  EXPECT_NE(page.by_id("sign")->text.find("Dr Ines Okafor"), std::string::npos);  // who signed is no secret
}

TEST(AttemptPage, CertificateOnlyWithItsEvidence) {
  AttemptView view = sample_attempt(90, 0.7);
  CheckedPage page = check_page(attempt_page(view, sample_frame()));
  EXPECT_FALSE(posts(page, "/certify"));
  EXPECT_NE(page.by_id("sign")->text.find("has not been shown"), std::string::npos);
  view.ready = judged(Flag::kReady, "14 passes in a row, reliability 0.84", 16);
  page = check_page(attempt_page(view, sample_frame()));
  EXPECT_TRUE(posts(page, "/certify"));
  EXPECT_NE(
      page.by_id("sign")->text.find("14 passes in a row, reliability 0.84 n = 16, reliability not known yet, rules 1"),
      std::string::npos);
}

TEST(AttemptPage, ACertificateIsCalledByItsExerciseAndTheTitleCanBeTranslated) {
  AttemptView view = sample_attempt(90, 0.7);
  view.certificates = {
      {{"c1", "dubois", "surface-touch", "L2", "1", "{}", "ines", "Dr Ines Okafor", "2026-03-01T10:00:00Z", "", ""},
       false,
       "decided not passed by Dr Brandt on 2026-03-20: no"}};
  const std::string html = attempt_page(view, sample_frame());
  const std::string said = check_page(html).by_id("sign")->text;
  EXPECT_NE(said.find("Certificate for Surface touch L2, 1 Mar 2026"), std::string::npos) << said;
  EXPECT_NE(said.find("on 20 Mar 2026: no. Look"), std::string::npos) << said;
  EXPECT_NE(html.find("<title>Surface touch L2, dubois - Trocar desk"), std::string::npos);
}

TEST(AttemptPage, ItsOriginNamesTheExerciseByItsTitle) {
  AttemptView view = sample_attempt();
  view.exercise = "Surface touch";
  view.result.exercise_version = "2";
  view.result.level = "L1";
  EXPECT_NE(
      check_page(attempt_page(view, sample_frame())).by_id("origin")->text.find("Surface touch, version 2, level L1"),
      std::string::npos);
}

TEST(AttemptPage, ASignatureOfOtherBytesShows) {
  AttemptView view = sample_attempt();
  EXPECT_EQ(sign_off_section(view, sample_frame()).find("other bytes"), std::string::npos);
  view.signatures[0].row_hash = std::string(64, '0');
  EXPECT_NE(sign_off_section(view, sample_frame()).find("other bytes"), std::string::npos);
}

TEST(AttemptPage, WithoutRecordingPictureOrScoreItSaysWhy) {
  AttemptView view = sample_attempt();
  view.picture = false;
  EXPECT_NE(attempt_page(view, sample_frame()).find("runs without graphics"), std::string::npos);
  view.trace.reset();
  view.no_trace = "The recording cannot be read: a.trec: cut";
  view.result.grade = {};
  view.result.grade.status = AttemptStatus::kVoid;
  view.result.integrity = "void: the clock went back";
  const CheckedPage page = check_page(attempt_page(view, sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_NE(page.by_id("moment")->text.find("a.trec: cut"), std::string::npos);
  EXPECT_NE(page.all("section", "verdict")[0]->text.find("Not gradedvoid: the clock went back"), std::string::npos);
}

TEST(AttemptPage, DeviceThatLackedRoomIsSaid) {
  AttemptView view = sample_attempt();
  view.result.device.saturated_contact_share = 0.05;
  EXPECT_EQ(device_facts(view).find("not all felt"), std::string::npos);
  view.result.device.saturated_contact_share = 0.051;
  EXPECT_NE(device_facts(view).find("not all felt"), std::string::npos);
  EXPECT_NE(device_facts(view).find("sensor stale"), std::string::npos);
}

TEST(AttemptPage, AReceiptIsPrintedAndDrawn) {
  const CheckedPage page = check_page(attempt_page(sample_attempt(), sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  const std::string device = page.by_id("pace")->text;
  for (const char* words : {"Pace of the loop", "SCHED_FIFO 80", "1000.0 Hz", "Linux 6.1.0, not real-time",
                            "2.1 on 2 processors", "Wake-up: late by", "Work of a tick"})
    EXPECT_NE(device.find(words), std::string::npos) << words << " in " << device;
  AttemptView lockstep = sample_attempt();
  lockstep.result.device.realtime.clear();
  EXPECT_EQ(attempt_page(lockstep, sample_frame()).find("Pace of the loop"), std::string::npos);
}

TEST(AttemptPage, AScoreFromALoopWithoutRightsIsMarked) {
  AttemptView view = sample_attempt(90, 1.2);
  const std::string mark = "Soft real time: the system gave the haptic loop no real-time priority";
  EXPECT_EQ(attempt_page(view, sample_frame()).find(mark), std::string::npos);
  view.result.device.realtime = R"({"lanes":{"haptic":{"policy":"SCHED_OTHER","refused":"Operation not permitted"}}})";
  const CheckedPage page = check_page(attempt_page(view, sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_NE(page.all("section", "verdict").at(0)->text.find(mark), std::string::npos) << "beside the score";
}

TEST(AttemptPage, WithoutADeviceItNamesWhatHelpedAndNoMotors) {
  AttemptView view = sample_attempt();
  EXPECT_EQ(origin_facts(view).find("Helped by"), std::string::npos);
  view.result.device.backend = "pointer";
  view.result.assists = "height plumb";
  EXPECT_NE(origin_facts(view).find("the tip keeps its height by itself; a line from the tip"), std::string::npos);
  EXPECT_EQ(device_facts(view).find("Passivity"), std::string::npos);
  view.result.assists.clear();
  EXPECT_NE(origin_facts(view).find("nothing"), std::string::npos);
}

TEST(AttemptPage, HostileTextsAndManyEvents) {
  AttemptView view = sample_attempt();
  AttemptResult& r = view.result;
  r.uuid = r.exercise_id = r.level = r.trainee = r.hand = r.started_utc = r.organ_name = r.organ_credit = r.integrity =
      r.state_hash = kHostile;
  r.grade.grade = kHostile;
  r.grade.caps = {{.kind = CapKind::kVoid, .subject = kHostile}};
  for (Metric& m : r.grade.metrics) m.name = m.unit = kHostile;
  for (Subscore& s : r.grade.subscores) s.name = s.unit = kHostile;
  for (int i = 0; i < 10000; ++i)
    r.events.push_back({0.006 * i, kHostile, Severity::kMinor, 1, 1, kHostile, Vec3::Zero()});
  r.device.backend = r.device.fault = kHostile;
  r.device.warnings[0].name = kHostile;
  view.exercise = view.program = view.row_hash = view.rules_version = kHostile;
  view.metric_words[kHostile] = kHostile;
  for (Signature& s : view.signatures) s.signer = s.meaning = s.note = s.utc = kHostile;
  view.overrides = {{kHostile, kHostile, kHostile, kHostile, kHostile, false}};
  view.ratings = {{"r", "a", kHostile, kHostile, kHostile, kHostile, 3}};
  for (Rival& rival : view.rivals) rival.words = rival.uuid = kHostile;
  view.ready = judged(Flag::kReady, kHostile);
  const std::string html = attempt_page(view, sample_frame());
  const CheckedPage page = check_page(html);
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_EQ(html.find("<script>"), std::string::npos);
  EXPECT_NE(page.by_id("events")->text.find("First 200 of 10003 events"), std::string::npos);
}

TEST(AttemptPage, NumbersThatAreNoneDoNoHarm) {
  AttemptView view = sample_attempt();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < view.trace->samples.size(); i += 7)
    view.trace->samples[i].force_T = view.trace->samples[i].tip_T = Vec3(nan, nan, nan);
  view.result.events[0].t_s = nan;
  view.result.events[1].value = nan;
  view.result.grade.metrics[0].value = nan;
  const std::string html = attempt_page(view, sample_frame());
  EXPECT_EQ(check_page(html).problems, std::vector<std::string>{});
  EXPECT_EQ(html.find("nan"), std::string::npos);
}

TEST(AttemptCsv, ScoreMetricsPartsEvents) {
  const std::string csv = attempt_csv(sample_attempt());
  EXPECT_TRUE(
      csv.starts_with("attempt,kind,name,value,unit,t_s,severity,weight,full_at,zero_at\r\n01890000-aaaa-7bbb-8ccc-"
                      "000000000001,score,score,58,"));
  EXPECT_NE(csv.find(",metric,tremor,,mm,"), std::string::npos);  // undefined is empty, never 0
  EXPECT_NE(csv.find(",part,in_band,0.4,,,,0.35,1,0.3\r\n"), std::string::npos);
  EXPECT_NE(csv.find(",event,EXCESS_FORCE,5.2,N,30,major,,,\r\n"), std::string::npos);
}

TEST(ComparePage, BothTracesAndJudgedDifferences) {
  const CheckedPage page = check_page(compare_page(sample_compare(), sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_EQ(page.all("svg", "time").size(), 1U);
  EXPECT_EQ(page.all("svg", "square").size(), 4U);
  const std::string text = page.by_id("metrics")->text;
  EXPECT_NE(text.find("Score5897.8\xE2\x88\x92"
                      "39.8worse"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("Force max5.2 N0.8 N+4.4 N"), std::string::npos) << text;
  EXPECT_NE(text.find("Tremor\xE2\x80\x93\xE2\x80\x93\xE2\x80\x93"), std::string::npos) << text;
}

TEST(ComparePage, JudgesByTheRubricsDirection) {
  CompareView view = sample_compare();
  view.left.less_is_better = {{"force_max_n", true}, {"path_m", true}};
  const CheckedPage page = check_page(compare_page(view, sample_frame()));
  const std::string text = page.by_id("metrics")->text;
  EXPECT_NE(text.find("Force max5.2 N0.8 N+4.4 Nworse"), std::string::npos) << text;
  EXPECT_NE(text.find("Path377 mm377 mm0 mmTremor"), std::string::npos) << text;  // no difference, no judgement
  view.left.less_is_better["force_max_n"] = false;
  EXPECT_NE(check_page(compare_page(view, sample_frame())).by_id("metrics")->text.find("+4.4 Nbetter"),
            std::string::npos);
}

TEST(ComparePage, WarnsOfWhatDoesNotCompare) {
  CompareView view = sample_compare();
  std::string text = compare_page(view, sample_frame());
  EXPECT_NE(text.find("different inputs: mouse and expert"), std::string::npos);
  EXPECT_EQ(text.find("different rules"), std::string::npos);
  view.right.result.rubric_sha256 = std::string(64, '9');
  view.right.result.board = 4;
  view.right.trace.reset();
  text = compare_page(view, sample_frame());
  EXPECT_NE(text.find("graded by different rules"), std::string::npos);
  EXPECT_NE(text.find("boards differ"), std::string::npos);
  EXPECT_NE(text.find("No recording of the second."), std::string::npos);
  view.left.trace.reset();
  EXPECT_EQ(check_page(compare_page(view, sample_frame())).problems, std::vector<std::string>{});
}

}  // namespace
}  // namespace trocar::review::attempt_page_test
