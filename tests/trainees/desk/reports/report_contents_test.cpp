// What stands in each report: every number of the page that it prints, with its unit, n, date or rules; in PDF and in
// HTML.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "tests/trainees/desk/pages/page_checker.h"
#include "tests/trainees/desk/pages/page_samples.h"
#include "tests/trainees/desk/print/pdf_reader.h"
#include "trainees/desk/reports/reports.h"

namespace trocar::review::report_contents_test {
namespace {

using printed::read_pdf;
using printed::ReadPdf;

/// Numbers of a text, as they are printed.
std::set<std::string> numbers_of(const std::string& text) {
  static const std::regex kNumber("[0-9]+(\\.[0-9]+)?");
  return {std::sregex_token_iterator(text.begin(), text.end(), kNumber), std::sregex_token_iterator()};
}

/// Numbers of the tables and lists of facts of a page that the report lacks.
std::set<std::string> lacking(const std::string& page_html, const std::string& report) {
  const std::set<std::string> there = numbers_of(report);
  std::set<std::string> out;
  const CheckedPage page = check_page(page_html);
  for (const char* name : {"td", "th", "dd", "figcaption"})
    for (const PageElement* element : page.all(name))
      for (const std::string& number : numbers_of(element->text))
        if (!there.contains(number)) out.insert(number);
  return out;
}

TraineeReportView sample_record() {
  TraineeReportView view{sample_trainee(), {}};
  view.trainee.name = "Bo \xC3\x85kesson";
  view.trainee.created_utc = "2026-02-20T08:00:00Z";
  view.decisions["uuid-9"] = {
      "o1", "ines", "Dr Ines Okafor", "Camera failed, looked at the film", "2026-03-19T12:00:00Z", true};
  return view;
}

TEST(TraineeReport, EveryNumberOfThePageIsInIt) {
  const TraineeReportView view = sample_record();
  const printed::Report report = trainee_report(view, {});
  const ReadPdf pdf = read_pdf(printed::pdf_of(report));
  const std::string html = printed::html_of(report);
  for (std::size_t chosen = 0; chosen < view.trainee.curves.size(); ++chosen) {
    TraineeView shown = view.trainee;
    shown.chosen = chosen;
    EXPECT_EQ(lacking(trainee_page(shown, sample_frame()), pdf.all), std::set<std::string>{});
    EXPECT_EQ(lacking(trainee_page(shown, sample_frame()), html), std::set<std::string>{});
  }
}

TEST(TraineeReport, SaysWhoStateEvidenceAndRules) {
  const ReadPdf pdf = read_pdf(printed::pdf_of(trainee_report(sample_record(), {})));
  for (const char* words :
       {"Bo \xC3\x85kesson", "Trainee bo, group 2026 A", "10 Mar 2026 to 25 Mar 2026",
        "plateau: +1.2 points over the newest 6 attempts (n = 6, rules 1)", "14 passes in a row (n = 16, rules 1)",
        "benchmark 88.5, mean - 2 SD of input expert, n = 6, 1 Feb 2026", "n = 3 to 8 trainees", "pass mark 75",
        "WITHDRAWN 3", "Device was out of calibration", "31 Aug 2026", "183 days after the certificate",
        "Terms: how each number is made", "Rules of progress, version 1", "LC-CUSUM"})
    EXPECT_TRUE(pdf.holds(words)) << words;
  EXPECT_TRUE(pdf.holds("Record to 25 Mar 2026"));
}

TEST(TraineeReport, ADecisionIsShownWithItsReasonAndTheScoreStays) {
  const ReadPdf pdf = read_pdf(printed::pdf_of(trainee_report(sample_record(), {})));
  EXPECT_TRUE(pdf.holds("passed by decision of Dr Ines Okafor"));
  EXPECT_TRUE(pdf.holds("Camera failed, looked at the film"));
  EXPECT_TRUE(pdf.holds("attempt 9"));
  TraineeReportView without = sample_record();
  without.decisions.clear();
  EXPECT_FALSE(read_pdf(printed::pdf_of(trainee_report(without, {}))).holds("Decisions by a person"));
}

TEST(TraineeReport, NotesOnlyWhenAsked) {
  ReportSetting setting;
  EXPECT_EQ(printed::html_of(trainee_report(sample_record(), setting)).find("Traction too strong"), std::string::npos);
  setting.notes = true;
  const std::string html = printed::html_of(trainee_report(sample_record(), setting));
  EXPECT_NE(html.find("Traction too strong at 92 s"), std::string::npos);
  EXPECT_NE(html.find("met 11 Mar 2026, 08:00"), std::string::npos);
}

TEST(TraineeReport, NobodyWithoutAttemptsAndAnErasedPersonHaveOneToo) {
  TraineeView empty;
  empty.code = "erased-0123456789ab";
  empty.created_utc = "2026-02-20T08:00:00Z";
  const std::string bytes = printed::pdf_of(trainee_report({empty, {}}, {}));
  const ReadPdf pdf = read_pdf(bytes);
  for (const char* words : {"erased-0123456789ab", "in no group", "No attempts yet.", "no attempts yet",
                            "Nothing is due.", "None yet.", "Record to 20 Feb 2026"})
    EXPECT_TRUE(pdf.holds(words)) << words;
  EXPECT_EQ(printed::collisions(bytes), std::vector<std::string>{});
}

TEST(TraineeReport, ThreeHundredAttemptsAndLongNames) {
  TraineeReportView view = sample_record();
  view.trainee.name = std::string(30, 'M') + "\xC3\xBC" + std::string(29, 'W');
  view.trainee.groups = {std::string(60, 'g'), "2026 A"};
  CurveView& curve = view.trainee.curves[0];
  curve.title = "Exercise of a very long title that no column was made for";
  curve.points.clear();
  for (int i = 0; i < 300; ++i)
    curve.points.push_back(
        {"uuid-" + std::to_string(i), "2026-03-10T09:00:00Z", "completed", 40.0 + i % 50, i % 3 == 0});
  const std::string bytes = printed::pdf_of(trainee_report(view, {}));
  const ReadPdf pdf = read_pdf(bytes);
  for (int i = 0; i < 300; ++i) EXPECT_TRUE(pdf.holds("uuid-" + std::to_string(i))) << i;
  EXPECT_TRUE(pdf.holds("Newest 200 of 300 attempts."));
  EXPECT_EQ(printed::collisions(bytes), std::vector<std::string>{});
  EXPECT_EQ(printed::outside(bytes, 28), std::vector<std::string>{});
}

CohortReportView sample_group() {
  CohortReportView view{sample_cohort(), {}, {{"Void: not a measurement (counted nowhere)", 7, 3}}};
  view.cohort.asked.group = "2026 A";
  view.benchmarks = {{"b1", "surface-touch", "L2", "score", "input expert", "mean - 2 SD", "ines",
                      "2026-02-01T08:00:00Z", 88.5, 0, 6}};
  for (CohortEntry& line : view.cohort.lines) line.reliability = 0.81;
  return view;
}

TEST(CohortReport, EveryNumberOfThePageIsInIt) {
  const CohortReportView view = sample_group();
  const printed::Report report = cohort_report(view, {});
  const std::string html = printed::html_of(report);
  EXPECT_EQ(lacking(cohort_page(view.cohort, sample_frame()), html), std::set<std::string>{});
  EXPECT_EQ(lacking(cohort_page(view.cohort, sample_frame()), read_pdf(printed::pdf_of(report)).all),
            std::set<std::string>{});
}

TEST(CohortReport, SpreadBenchmarksExclusionsAndStates) {
  const ReadPdf pdf = read_pdf(printed::pdf_of(cohort_report(sample_group(), {})));
  // Newest scores 65, 92, 72, 70, 82, 83, 49, 92: quartiles of type 7.
  EXPECT_TRUE(pdf.holds("68.8 / 77.0 / 85.2")) << pdf.all;
  for (const char* words :
       {"Cohort 2026 A", "3 of the last 5 attempts went past 4.7 N (n = 5)", "mean - 2 SD", "input expert",
        "1 Feb 2026", "88.5", "0.81", "Void: not a measurement (counted nowhere) 7 3", "dubois, gupta", "group 2026 A"})
    EXPECT_TRUE(pdf.holds(words)) << words;
}

TEST(CohortReport, TooFewForQuartilesAndNobodyAtAll) {
  CohortReportView view = sample_group();
  view.cohort.lines.resize(2);
  EXPECT_TRUE(read_pdf(printed::pdf_of(cohort_report(view, {}))).holds("fewer than 3"));
  view.cohort.lines.clear();
  const std::string bytes = printed::pdf_of(cohort_report(view, {}));
  EXPECT_TRUE(read_pdf(bytes).holds("Nobody has an attempt here yet."));
  EXPECT_EQ(printed::collisions(bytes), std::vector<std::string>{});
}

TEST(CohortReport, FiveHundredTraineesInOrderAndWithoutCollisions) {
  CohortReportView view = sample_group();
  const CohortEntry line = view.cohort.lines.front();
  view.cohort.lines.clear();
  for (int i = 0; i < 500; ++i) {
    view.cohort.lines.push_back(line);
    view.cohort.lines.back().code = "P" + std::to_string(1000 + i);
    view.cohort.lines.back().name = "Name of " + std::to_string(i) + " " + std::string(40, 'm');
  }
  const std::string bytes = printed::pdf_of(cohort_report(view, {}));
  const ReadPdf pdf = read_pdf(bytes);
  for (int i = 0; i < 500; i += 7) EXPECT_TRUE(pdf.holds("P" + std::to_string(1000 + i))) << i;
  EXPECT_LT(bytes.size(), 4'000'000U);
}

AttemptReportView sample_run() {
  AttemptReportView view{sample_attempt(), "", "No picture: this machine has no graphics."};
  view.attempt.finished_utc = "2026-03-19T09:31:00Z";
  view.attempt.ratings = {{"r1", "a1", "Dr Ines Okafor", "GOALS", "Depth perception", "2026-03-19T18:00:00Z", 4}};
  return view;
}

TEST(AttemptReport, EveryNumberOfThePageIsInIt) {
  const AttemptReportView view = sample_run();
  const printed::Report report = attempt_report(view, {});
  const std::string page = attempt_page(view.attempt, sample_frame());
  EXPECT_EQ(lacking(page, printed::html_of(report)), std::set<std::string>{});
  const ReadPdf pdf = read_pdf(printed::pdf_of(report));
  // Hashes are broken over lines on paper: their parts are looked for without spaces.
  const std::string together = std::regex_replace(pdf.all, std::regex(" "), "");
  std::set<std::string> left;
  for (const std::string& number : lacking(page, pdf.all))
    if (together.find(number) == std::string::npos) left.insert(number);
  EXPECT_EQ(left, std::set<std::string>{});
}

TEST(AttemptReport, VerdictEventsMetricsRunReportAndHashes) {
  const ReadPdf pdf = read_pdf(printed::pdf_of(attempt_report(sample_run(), {})));
  for (const char* words :
       {"Not yet", "58.0", "of 100, pass 75", "Safety gate not met: in band 58 %, the gate asks 65 % or more.",
        "The score is capped: safety gate: in band 58 %, the gate asks 65 % or more: at most 59", "Excess force",
        "major", "largest |F| of the scene on the instrument", "Ticks missed", "sensor stale", "0.25 s",
        "0123456789abcdef", "Dr Ines Okafor", "Depth perception", "No picture: this machine has no graphics.",
        "Virtual newtons", "trocar 0.7", "from above (x right, y up)", "Surface touch, version 1.0, level L2"})
    EXPECT_TRUE(pdf.holds(words)) << words;
  EXPECT_FALSE(pdf.holds("surface-touch")) << "titles, as on the pages";
  EXPECT_TRUE(pdf.holds(std::string(64, 'd'))) << "the row hash, whole";
}

TEST(AttemptReport, TheReceiptIsPrintedAndDrawnAndALoopWithoutRightsMarked) {
  AttemptReportView view = sample_run();
  const ReadPdf pdf = read_pdf(printed::pdf_of(attempt_report(view, {})));
  for (const char* words : {"Pace of the loop", "SCHED_FIFO 80", "Linux 6.1.0, not real-time", "Period: off by"})
    EXPECT_TRUE(pdf.holds(words)) << words;
  EXPECT_FALSE(pdf.holds("Soft real time"));
  view.attempt.result.device.realtime =
      R"({"lanes":{"haptic":{"policy":"SCHED_OTHER","refused":"Operation not permitted"}}})";
  EXPECT_TRUE(read_pdf(printed::pdf_of(attempt_report(view, {}))).holds("Soft real time: the system gave"));
}

TEST(AttemptReport, AnOverrideIsSaidBesideTheScore) {
  AttemptReportView view = sample_run();
  view.attempt.overrides = {
      {"o2", "ines", "Dr Ines Okafor", "Device stopped for a moment", "2026-03-20T10:00:00Z", true}};
  const ReadPdf pdf = read_pdf(printed::pdf_of(attempt_report(view, {})));
  EXPECT_TRUE(
      pdf.holds("Passed by decision of Dr Ines Okafor, 20 Mar 2026, 10:00: Device stopped for a moment The score above "
                "stays as it was."));
  EXPECT_TRUE(pdf.holds("58.0"));
  EXPECT_TRUE(pdf.holds("Record to 20 Mar 2026"));
}

TEST(AttemptReport, SaysWhatToTryNextSafetyFirst) {
  AttemptReportView view = sample_run();
  view.attempt.result.grade.subscores = {
      {.name = "path_ratio", .value = 0.2, .weight = 0.5, .raw = 2.4, .unit = "", .full_at = 1, .zero_at = 3},
      {.name = "peak_force",
       .value = 0.9,
       .weight = 0.2,
       .raw = 2.4,
       .unit = "N",
       .full_at = 2,
       .zero_at = 6,
       .gate = true}};
  EXPECT_TRUE(
      read_pdf(printed::pdf_of(attempt_report(view, {}))).holds("Try next: Peak force down to 2 N (now 2.4 N)."));
  view.attempt.result.grade.subscores[1].value = 1;
  EXPECT_TRUE(read_pdf(printed::pdf_of(attempt_report(view, {}))).holds("Try next: Path ratio down to 1 (now 2.4)."));
  for (Subscore& part : view.attempt.result.grade.subscores) part.value = 1;
  EXPECT_FALSE(read_pdf(printed::pdf_of(attempt_report(view, {}))).holds("Try next"));
}

TEST(AttemptReport, HasThePlotsOfPensBlocksAndStiffnessWhereTheyAre) {
  AttemptReportView view = sample_run();
  const auto holds = [&](const char* words) {
    return read_pdf(printed::pdf_of(attempt_report(view, {}))).holds(words);
  };
  for (const char* words : {"Place and turn of each pen", "Grip force on each block", "could display"})
    EXPECT_FALSE(holds(words)) << words;
  view.attempt.pose = {0.003, 0.14};
  EXPECT_TRUE(holds("Place and turn of each pen"));
  view.attempt.grips = {{0.5, 1.5}, {0.8, 2.0}};
  EXPECT_TRUE(holds("Grip force on each block"));
  view.attempt.result.device.stiffness.recorded = true;
  EXPECT_TRUE(holds("Stiffness that the device could display"));
}

TEST(AttemptReport, SaysThatNoHardwareMovedOnTheSimulatedPlantAlone) {
  AttemptReportView view = sample_run();
  view.attempt.result.device.backend = "simulated";
  EXPECT_NE(printed::html_of(attempt_report(view, {})).find("no hardware moved"), std::string::npos);
  view.attempt.result.device.backend = "mc4000";
  EXPECT_EQ(printed::html_of(attempt_report(view, {})).find("no hardware moved"), std::string::npos);
}

TEST(AttemptReport, EscapesWhateverComesFromOutside) {
  const std::string evil = "<script>alert('x')</script>\"&";
  AttemptReportView view = sample_run();
  AttemptResult& r = view.attempt.result;
  for (std::string* field : {&r.trainee,
                             &r.hand,
                             &r.level,
                             &r.uuid,
                             &r.exercise_id,
                             &r.exercise_version,
                             &r.organ_name,
                             &r.organ_source,
                             &r.organ_credit,
                             &r.organ_sha256,
                             &r.rubric_sha256,
                             &r.recording_sha256,
                             &r.state_hash,
                             &r.device.backend,
                             &r.device.fault,
                             &r.grade.grade,
                             &r.grade.subscores[0].name,
                             &r.grade.subscores[0].unit,
                             &r.grade.metrics[0].name,
                             &r.grade.metrics[0].unit,
                             &view.attempt.exercise,
                             &view.attempt.program})
    *field = evil;
  const std::string html = printed::html_of(attempt_report(view, {}));
  EXPECT_EQ(html.find("<script"), std::string::npos);
}

TEST(AttemptReport, WithoutTraceScoreOrEvents) {
  AttemptReportView view = sample_run();
  view.attempt.trace.reset();
  view.attempt.no_trace = "This attempt was not recorded.";
  view.attempt.result.grade = {};
  view.attempt.result.grade.status = AttemptStatus::kFault;
  view.attempt.result.events.clear();
  view.attempt.result.integrity = "device fault: encoder lost";
  const std::string bytes = printed::pdf_of(attempt_report(view, {}));
  for (const char* words : {"Not graded", "device fault: encoder lost", "This attempt was not recorded.",
                            "No score, so no points.", "0 events"})
    EXPECT_TRUE(read_pdf(bytes).holds(words)) << words;
  EXPECT_EQ(printed::collisions(bytes), std::vector<std::string>{});
}

CertificateView sample_certificate() {
  CertificateView view;
  view.certificate = {"01890000-aaaa-7bbb-8ccc-000000000009",
                      "bo",
                      "surface-touch",
                      "L2",
                      "1",
                      "{}",
                      "ines",
                      "Dr Ines Okafor",
                      "2026-03-20T10:00:00Z"};
  view.name = "Bo \xC3\x85kesson";
  view.exercise = "Surface touch";
  for (int i = 0; i < 16; ++i)
    view.attempts.push_back({"u", "2026-03-" + std::to_string(10 + i / 2) + "T09:00:00Z", "completed",
                             "hash" + std::to_string(100 + i), "simulated", "mouse", 70 + i, 90.0 + i / 10.0, i != 3,
                             ""});
  view.attempts[5].decided_by = "Dr Ines Okafor";
  view.evidence = "competence shown at attempt 14 of 16, reliability 0.84; a person decides";
  view.n = 16;
  view.reliability = 0.84;
  return view;
}

TEST(CertificateReport, SaysWhatWasShownByWhichNumbers) {
  const ReadPdf pdf = read_pdf(printed::pdf_of(certificate_sheet(sample_certificate(), {})));
  ASSERT_EQ(pdf.pages.size(), 1U);
  for (const char* words : {"Bo \xC3\x85kesson",
                            "trainee bo",
                            "Surface touch, level L2",
                            "Competence shown at attempt 14 of 16, reliability 0.84.",
                            "failure rates 0.1 adequate",
                            "n = 16",
                            "15 of 16",
                            "0.84",
                            "version 1",
                            "simulated plant; mouse",
                            "10 Mar 2026 to 17 Mar 2026",
                            "hash100",
                            "hash115",
                            "85",
                            "91.5",
                            "passed, by Dr Ines",
                            "not passed",
                            "no medical qualification",
                            "Dr Ines Okafor",
                            "20 Mar 2026, 10:00",
                            "01890000-aaaa-7bbb-8ccc-000000000009"})
    EXPECT_TRUE(pdf.holds(words)) << words;
  EXPECT_FALSE(pdf.holds("a person decides"));
  EXPECT_FALSE(pdf.holds("the judgement counted"));
}

TEST(CertificateReport, SaysWhereTheRecordHoldsOtherAttemptsThanTheJudgementCounted) {
  CertificateView view = sample_certificate();
  view.attempts.pop_back();
  view.reliability.reset();
  const ReadPdf pdf = read_pdf(printed::pdf_of(certificate_sheet(view, {})));
  EXPECT_TRUE(pdf.holds("the judgement counted 16"));
  EXPECT_TRUE(pdf.holds("could not be told"));
}

TEST(CertificateReport, OtherRulesThanTodaysLendItNoNumbers) {
  ReportSetting setting;
  setting.rules.version = "2";
  setting.rules.cusum.shown_at = 3.5;
  const std::string html = printed::html_of(certificate_sheet(sample_certificate(), setting));
  EXPECT_EQ(html.find("3.5"), std::string::npos);
  EXPECT_NE(html.find("version 1"), std::string::npos);
}

TEST(CertificateReport, WithoutADeviceItAttestsNoWorkOnOne) {
  CertificateView view = sample_certificate();
  for (CertifiedAttempt& a : view.attempts) a.backend = "pointer";
  const std::string html = printed::html_of(certificate_sheet(view, {}));
  EXPECT_NE(html.find("no device"), std::string::npos);
  EXPECT_NE(html.find("made without one and nothing was felt"), std::string::npos);
  EXPECT_EQ(html.find("simulated plant"), std::string::npos);
}

TEST(AttemptReport, WithoutADeviceItNamesWhatHelpedAndNoMotors) {
  AttemptReportView view = sample_run();
  view.attempt.result.device.backend = "pointer";
  view.attempt.result.assists = "plumb";
  const std::string html = printed::html_of(attempt_report(view, {}));
  EXPECT_NE(html.find("none: nothing was felt"), std::string::npos);
  EXPECT_NE(html.find("a line from the tip to what lies below"), std::string::npos);
  EXPECT_EQ(html.find("Passivity at work"), std::string::npos);
}

TEST(CertificateReport, WithdrawnErasedAndRealDevice) {
  CertificateView view = sample_certificate();
  view.certificate.revoked_utc = "2026-04-03T10:00:00Z";
  view.certificate.revoked_reason = "Device was out of calibration";
  view.certificate.trainee = "erased-0123456789ab";
  view.name = "";
  for (CertifiedAttempt& a : view.attempts) a.backend = "daq";
  const std::string bytes = printed::pdf_of(certificate_sheet(view, {}));
  const ReadPdf pdf = read_pdf(bytes);
  EXPECT_TRUE(pdf.holds("WITHDRAWN on 3 Apr 2026: Device was out of calibration"));
  EXPECT_TRUE(pdf.holds("erased-0123456789ab"));
  EXPECT_FALSE(pdf.holds("simulated plant"));
  EXPECT_EQ(printed::collisions(bytes), std::vector<std::string>{});
}

TEST(Reports, DemoIsMarkedInEach) {
  ReportSetting setting;
  setting.demo = true;
  EXPECT_NE(printed::html_of(trainee_report(sample_record(), setting)).find("invented"), std::string::npos);
  EXPECT_NE(printed::html_of(cohort_report(sample_group(), setting)).find("invented"), std::string::npos);
  EXPECT_NE(printed::html_of(attempt_report(sample_run(), setting)).find("invented"), std::string::npos);
  EXPECT_NE(printed::html_of(certificate_sheet(sample_certificate(), setting)).find("invented"), std::string::npos);
}

TEST(Reports, NothingCollidesInTheSamples) {
  for (const std::string& bytes :
       {printed::pdf_of(trainee_report(sample_record(), {})), printed::pdf_of(cohort_report(sample_group(), {})),
        printed::pdf_of(attempt_report(sample_run(), {})),
        printed::pdf_of(certificate_sheet(sample_certificate(), {}))}) {
    EXPECT_EQ(printed::collisions(bytes), std::vector<std::string>{});
    EXPECT_EQ(printed::outside(bytes, 28), std::vector<std::string>{});
  }
}

}  // namespace
}  // namespace trocar::review::report_contents_test
