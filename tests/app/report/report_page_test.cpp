#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

#include "app/report/report.h"
#include "haptics/input_error.h"
#include "tests/support/sample_attempt.h"
#include "trainees/markup/html.h"

namespace trocar::report_page_test {
namespace {

using testing_support::sample_attempt;
using testing_support::sample_trace;

ReportContext context() {
  ReportContext c;
  c.exercise_number = "E02";
  c.exercise_title = "Surface touch";
  c.goal = "Touch five targets with 1 to 2 N for one second each";
  c.band = {1, 2, 5};
  c.time_limit_s = 120;
  c.program_version = "0.1.0";
  return c;
}

bool has(const std::string& page, const std::string& words) { return page.find(words) != std::string::npos; }

/// Empty when tags nest and close as they must, else what is wrong.
std::string nesting_fault(const std::string& page) {
  const std::set<std::string> single = {"meta", "img", "br", "!DOCTYPE"};
  std::vector<std::string> open;
  for (std::size_t i = page.find('<'); i != std::string::npos; i = page.find('<', i + 1)) {
    const std::size_t end = page.find('>', i);
    if (end == std::string::npos) return "tag without end";
    const std::string tag = page.substr(i + 1, end - i - 1);
    if (tag.find('<') != std::string::npos) return "stray < in " + tag;
    const std::string name = tag.substr(tag[0] == '/' ? 1 : 0, tag.find_first_of(" \n", 1) - (tag[0] == '/' ? 1 : 0));
    const bool closed_itself = tag.back() == '/';
    if (single.count(name) || closed_itself) continue;
    if (tag[0] != '/') {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : "never closed: " + open.back();
}

TEST(ReportPage, LeadsWithVerdictAndReason) {
  const std::string page = report_page(sample_attempt(), sample_trace(), context());
  const std::size_t verdict = page.find("NOT YET"), reason = page.find("safety: peak_force below 0.5"),
                    table = page.find("Where the points went");
  ASSERT_NE(verdict, std::string::npos);
  EXPECT_LT(verdict, reason);
  EXPECT_LT(reason, table);
  EXPECT_LT(table, page.find("Force against time"));
}

TEST(ReportPage, ShowsEverySubscoreWithAnchorsWeightAndLoss) {
  const AttemptResult attempt = sample_attempt();
  const std::string page = report_page(attempt, sample_trace(), context());
  std::size_t last = 0;
  for (const char* name : {"Peak force", "Path ratio", "Time in band share", "Wrong places", "Time to complete"}) {
    const std::size_t at = page.find(std::string("<tr><td>") + name);
    ASSERT_NE(at, std::string::npos) << name;
    EXPECT_GT(at, last) << name << " out of order: safety first, time last";
    last = at;
  }
  for (const char* words : {"5.61 N", ">2 N<", ">6 N<", ">30<", "\u221223.4", "safety gate below half"})
    EXPECT_TRUE(has(page, words)) << words;
}

TEST(ReportPage, ListsEveryEventAndMetric) {
  const AttemptResult attempt = sample_attempt();
  const std::string page = report_page(attempt, sample_trace(), context());
  for (const Event& event : attempt.events) EXPECT_TRUE(has(page, words_of(event.type))) << event.type;
  for (const Metric& metric : attempt.grade.metrics) EXPECT_TRUE(has(page, words_of(metric.name))) << metric.name;
  EXPECT_TRUE(has(page, "612 mm"));
  EXPECT_TRUE(has(page, "undefined"));
  EXPECT_TRUE(has(page, "Excess force, object 4"));
}

TEST(ReportPage, SaysSimulatedAndSyntheticAndCarriesTheHashes) {
  const AttemptResult attempt = sample_attempt();
  const std::string page = report_page(attempt, sample_trace(), context());
  EXPECT_TRUE(has(page, "on the simulated plant"));
  EXPECT_TRUE(has(page, "SYNTHETIC"));
  for (const std::string& hash :
       {attempt.state_hash, attempt.rubric_sha256, attempt.recording_sha256, attempt.organ_sha256, attempt.uuid})
    EXPECT_TRUE(has(page, hash)) << hash;
  AttemptResult hardware = attempt;
  hardware.device.backend = "mc4000";
  hardware.organ_synthetic = false;
  const std::string real = report_page(hardware, sample_trace(), context());
  EXPECT_FALSE(has(real, "on the simulated plant"));
  EXPECT_FALSE(has(real, "SYNTHETIC"));
}

TEST(ReportPage, EscapesWhateverComesFromOutside) {
  const std::string evil = "<script>alert('x')</script>\"&";
  AttemptResult attempt = sample_attempt();
  ReportContext c = context();
  for (std::string* field : {&attempt.trainee,
                             &attempt.hand,
                             &attempt.level,
                             &attempt.uuid,
                             &attempt.exercise_id,
                             &attempt.exercise_version,
                             &attempt.organ_name,
                             &attempt.organ_source,
                             &attempt.organ_credit,
                             &attempt.organ_sha256,
                             &attempt.rubric_sha256,
                             &attempt.recording_sha256,
                             &attempt.state_hash,
                             &attempt.started_utc,
                             &attempt.device.backend,
                             &attempt.device.fault,
                             &attempt.grade.grade,
                             &attempt.events[2].type,
                             &attempt.events[2].unit,
                             &attempt.grade.subscores[0].name,
                             &attempt.grade.subscores[0].unit,
                             &attempt.grade.metrics[0].name,
                             &attempt.grade.metrics[0].unit,
                             &attempt.grade.caps[0].subject,
                             &c.exercise_number,
                             &c.exercise_title,
                             &c.goal,
                             &c.program_version})
    *field = evil;
  c.picture = evil + ".png";
  c.embed_picture = false;
  const std::string page = report_page(attempt, sample_trace(), c);
  EXPECT_FALSE(has(page, "<script"));
  EXPECT_EQ(nesting_fault(page), "");
}

TEST(ReportPage, IsWellFormedInEveryOutcome) {
  for (const AttemptStatus status : {AttemptStatus::kCompleted, AttemptStatus::kTimeout, AttemptStatus::kAborted,
                                     AttemptStatus::kFault, AttemptStatus::kVoid}) {
    AttemptResult attempt = sample_attempt();
    attempt.grade.status = status;
    EXPECT_EQ(nesting_fault(report_page(attempt, sample_trace(), context())), "") << status_name(status);
    EXPECT_EQ(nesting_fault(report_page(AttemptResult{}, Trace{}, ReportContext{})), "");
  }
}

TEST(ReportPage, AsksNothingOfTheNetworkAndRunsNoScript) {
  const std::string page = report_page(sample_attempt(), sample_trace(), context());
  for (const char* words : {"http:", "https:", "<script", "<link", "@import", "url(//", "src=\"//"})
    EXPECT_FALSE(has(page, words)) << words;
}

TEST(ReportPage, SameInputSameBytes) {
  EXPECT_EQ(report_page(sample_attempt(), sample_trace(), context()),
            report_page(sample_attempt(), sample_trace(), context()));
}

TEST(ReportPage, EmbedsOrLinksThePicture) {
  const auto picture = std::filesystem::temp_directory_path() / "trocar_report_picture.png";
  std::ofstream(picture, std::ios::binary) << "foobar";
  ReportContext c = context();
  c.picture = picture;
  EXPECT_TRUE(has(report_page(sample_attempt(), sample_trace(), c), "data:image/png;base64,Zm9vYmFy"));
  c.embed_picture = false;
  EXPECT_TRUE(has(report_page(sample_attempt(), sample_trace(), c), "src=\"trocar_report_picture.png\""));
  std::filesystem::remove(picture);
  c.embed_picture = true;
  EXPECT_THROW(report_page(sample_attempt(), sample_trace(), c), EnvironmentError);
}

TEST(WriteReport, WritesThePageAndNamesAnUnwritableFile) {
  const auto path = std::filesystem::temp_directory_path() / "trocar_report_test.html";
  write_report(path, sample_attempt(), sample_trace(), context());
  std::ifstream file(path, std::ios::binary);
  const std::string back{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(back, report_page(sample_attempt(), sample_trace(), context()));
  std::filesystem::remove(path);
  try {
    write_report("/nonexistent-folder/r.html", sample_attempt(), sample_trace(), context());
    FAIL();
  } catch (const EnvironmentError& error) {
    EXPECT_TRUE(has(error.what(), "/nonexistent-folder/r.html"));
  }
}

}  // namespace
}  // namespace trocar::report_page_test
