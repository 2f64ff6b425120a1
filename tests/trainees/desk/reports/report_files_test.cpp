// Reports out of a real database: the routes, what the record holds, what is left out, who is erased.
#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/trainees/desk/pages/page_samples.h"
#include "tests/trainees/desk/print/pdf_reader.h"
#include "tests/trainees/records/cohort_samples.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/desk/pages/pages.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/desk/queries/report_views.h"
#include "trainees/desk/routes/route_table.h"
#include "trainees/records/assessments.h"
#include "trainees/records/curricula.h"
#include "trainees/records/erasure.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::review::report_files_test {
namespace {

using printed::read_pdf;
using printed::ReadPdf;

constexpr const char* kNow = "2026-06-01T10:00:00Z";

class ReportFiles : public testing::Test {
 protected:
  ReportFiles() : database_(":memory:"), desk_{database_, {}, false}, table_(desk_routes()) {
    test::fill_cohort(database_, {.attempts = 160});
    desk_.sources.trace = [](const std::filesystem::path&) { return sample_trace(); };
    desk_.sources.level_facts = [](const std::string&, const std::string&) { return LevelFacts{{0.4, 0.8, 1.5}, 70}; };
    cited_ = *AttemptStore(database_).latest();
    for (const AttemptSummary& one : AttemptStore(database_).list({"", "", 0}))
      if (one.passed && (!cited_.passed || one.row > cited_.row)) cited_ = one;  // a certificate cites what is passed
    attempt_ = cited_.uuid;
    trainee_ = cited_.trainee;
  }

  Response get(const std::string& path, std::map<std::string, std::string> query = {}) {
    const RouteTable::Found found = table_.find("GET", path);
    if (found.route == nullptr) return Response{.status = 405};
    Request request;
    request.path = path;
    request.arguments = found.arguments;
    request.query = std::move(query);
    request.account = Account{"a-1", "ines", "Dr Ines Okafor", Role::kInstructor};
    request.now_utc = kNow;
    return found.route->answer(request, desk_);
  }
  ReadPdf read(const std::string& path, std::map<std::string, std::string> query = {}) {
    const Response answer = get(path, std::move(query));
    EXPECT_EQ(answer.status, 200) << path << answer.body.substr(0, 800);
    EXPECT_EQ(answer.type, "application/pdf");
    return read_pdf(answer.body);
  }
  std::string certify(const std::string& evidence = "") {
    const std::string json =
        R"({"attempt":")" + attempt_ +
        R"(","n":14,"reliability":0.83,"rules":"1","words":"competence shown at attempt 14 of 14; a person decides"})";
    return AssessmentStore(database_)
        .certify(trainee_, cited_.exercise_id, cited_.level, "1", evidence.empty() ? json : evidence,
                 {"0192-i", "Dr Ines Okafor"})
        .uuid;
  }

  Database database_;
  Desk desk_;
  RouteTable table_;
  AttemptSummary cited_ = {};  ///< the newest that is passed
  std::string attempt_, trainee_;
};

TEST_F(ReportFiles, EveryPageHasItsFileWithTypeAndName) {
  const std::string certificate = certify();
  const std::map<std::string, std::string> wanted = {
      {"/report/trainee/" + trainee_ + ".pdf", "trainee-" + trainee_ + ".pdf"},
      {"/report/cohort.pdf", "cohort.pdf"},
      {"/report/attempt/" + attempt_ + ".pdf", "attempt-" + attempt_ + ".pdf"},
      {"/report/certificate/" + certificate + ".pdf", "certificate-" + certificate + ".pdf"}};
  for (const auto& [path, name] : wanted) {
    const Response answer = get(path);
    EXPECT_EQ(answer.status, 200) << path;
    EXPECT_EQ(answer.type, "application/pdf");
    EXPECT_EQ(answer.download, name);
    EXPECT_TRUE(answer.body.starts_with("%PDF-1.")) << path;
    EXPECT_EQ(answer.body, get(path).body) << path << ": the same record, the same bytes";
    EXPECT_EQ(printed::collisions(answer.body), std::vector<std::string>{}) << path;
  }
  for (const char* path :
       {"/report/trainee/nobody.pdf", "/report/attempt/nothing.pdf", "/report/certificate/nothing.pdf"}) {
    EXPECT_EQ(get(path).status, 404) << path;
    EXPECT_EQ(get(path).download, "") << "a page says so";
  }
}

TEST_F(ReportFiles, ThePagesLinkToTheirFiles) {
  const std::string certificate = certify();
  EXPECT_NE(get("/").body.find("href=\"/report/cohort.pdf"), std::string::npos);
  const std::string trainee = get("/trainee/" + trainee_).body;
  EXPECT_NE(trainee.find("href=\"/report/trainee/" + trainee_ + ".pdf\""), std::string::npos);
  EXPECT_NE(trainee.find("href=\"/report/certificate/" + certificate + ".pdf\""), std::string::npos);
  EXPECT_NE(get("/attempt/" + attempt_).body.find("href=\"/report/attempt/" + attempt_ + ".pdf\""), std::string::npos);
}

TEST_F(ReportFiles, TheTraineesReportHoldsEveryAttemptOfTheRecord) {
  const ReadPdf pdf = read("/report/trainee/" + trainee_ + ".pdf");
  int own = 0;
  for (const AttemptSummary& a : AttemptStore(database_).list({.trainee = trainee_, .exercise_id = ""}))
    if (a.status == "completed" || a.status == "timeout" || a.status == "aborted") {
      EXPECT_TRUE(pdf.holds(a.uuid)) << a.uuid;
      ++own;
    }
  EXPECT_GT(own, 10);
}

TEST_F(ReportFiles, AnOverrideIsShownWhereverTheAttemptIs) {
  AssessmentStore(database_).override_verdict(attempt_, false, "Camera failed in the middle",
                                              {"0192-i", "Dr Ines Okafor"});
  AssessmentStore(database_).override_verdict(attempt_, true, "Second thought: the film is fine",
                                              {"0192-i", "Dr Ines Okafor"});
  const ReadPdf trainee = read("/report/trainee/" + trainee_ + ".pdf");
  EXPECT_TRUE(trainee.holds("passed by decision of Dr Ines"));
  EXPECT_TRUE(trainee.holds("Second thought:"));
  EXPECT_FALSE(trainee.holds("Camera failed")) << "the newest holds";
  const ReadPdf attempt = read("/report/attempt/" + attempt_ + ".pdf");
  EXPECT_TRUE(attempt.holds("Passed by decision of Dr Ines Okafor"));
  EXPECT_TRUE(attempt.holds("Camera failed in the middle")) << "the attempt's own report tells all of it";
}

TEST_F(ReportFiles, TheCohortsReportKeepsItsFiltersAndCountsWhatIsLeftOut) {
  AttemptResult broken = sample_result();
  broken.grade.status = AttemptStatus::kFault;
  broken.grade.score.reset();
  store_attempt(database_, sample_start("T-void"), broken);
  CurriculumStore(database_).join("T-void", "2026 A", {"", "ines"});
  const ReadPdf all = read("/report/cohort.pdf");
  EXPECT_TRUE(all.holds("Ended by the device (counted nowhere) 1 1")) << all.all;
  EXPECT_TRUE(all.holds("P002"));
  const ReadPdf b = read("/report/cohort.pdf", {{"group", "2026 B"}});
  EXPECT_TRUE(b.holds("Cohort 2026 B"));
  EXPECT_TRUE(b.holds("Ended by the device (counted nowhere) 0 0"));
  const std::vector<std::string> others = CurriculumStore(database_).members("2026 A");
  for (const std::string& code : others) EXPECT_FALSE(b.holds(code)) << code << " is of the other group";
}

TEST_F(ReportFiles, TheCertificateNamesTheAttemptsBehindItWithTheirHashes) {
  const std::string uuid = certify();
  const CertificateView view = certificate_view(desk_, uuid);
  ASSERT_GT(view.attempts.size(), 3U);
  EXPECT_EQ(view.n, 14);
  EXPECT_EQ(view.reliability, std::optional<double>(0.83));
  EXPECT_EQ(view.evidence, "competence shown at attempt 14 of 14; a person decides");
  for (const CertifiedAttempt& a : view.attempts) {
    const AttemptSummary s = AttemptStore(database_).find(a.uuid);
    EXPECT_EQ(s.trainee, trainee_);
    EXPECT_EQ(s.exercise_id, cited_.exercise_id);
    EXPECT_EQ(s.level, cited_.level);
    EXPECT_EQ(s.hand, cited_.hand) << "another input is another curve";
    EXPECT_EQ(a.row_hash.size(), 64U);
  }
  const ReadPdf pdf = read("/report/certificate/" + uuid + ".pdf");
  EXPECT_TRUE(pdf.holds(view.attempts.back().row_hash.substr(0, 32)));
  EXPECT_TRUE(pdf.holds(uuid));
}

TEST_F(ReportFiles, EvidenceInWordsAloneIsPrintedAsItStands) {
  const ReadPdf pdf = read("/report/certificate/" + certify("14 passes in a row, looked at by two people") + ".pdf");
  EXPECT_TRUE(pdf.holds("14 passes in a row, looked at by two people."));
  EXPECT_TRUE(pdf.holds("could not be told"));
}

TEST_F(ReportFiles, AWithdrawnCertificateSaysSo) {
  const std::string uuid = certify();
  AssessmentStore(database_).revoke(uuid, "Device was out of calibration", {"0192-i", "Dr Ines Okafor"});
  EXPECT_TRUE(read("/report/certificate/" + uuid + ".pdf").holds("WITHDRAWN on "));
  EXPECT_TRUE(read("/report/trainee/" + trainee_ + ".pdf").holds("WITHDRAWN "));
}

TEST_F(ReportFiles, AnErasedPersonHasNoNameInAnyFile) {
  TraineeStore(database_).edit(trainee_, "Anna M\xC3\xBCller", {}, "");
  const std::string uuid = certify();
  EXPECT_TRUE(read("/report/certificate/" + uuid + ".pdf").holds("Anna M\xC3\xBCller"));
  EXPECT_TRUE(read("/report/trainee/" + trainee_ + ".pdf").holds("Anna M\xC3\xBCller"));
  erase_trainee(database_, trainee_, ErasureKind::kIdentity, "request of the person", {"", "adam"});
  EXPECT_EQ(get("/report/trainee/" + trainee_ + ".pdf").status, 404);
  const std::string code = AttemptStore(database_).find(attempt_).trainee;
  EXPECT_TRUE(code.starts_with("erased-"));
  for (const std::string& path : {"/report/certificate/" + uuid + ".pdf", "/report/trainee/" + code + ".pdf",
                                  "/report/attempt/" + attempt_ + ".pdf", std::string("/report/cohort.pdf")}) {
    const ReadPdf pdf = read(path);
    EXPECT_FALSE(pdf.holds("M\xC3\xBCller")) << path;
    EXPECT_FALSE(pdf.holds(trainee_)) << path;
  }
}

TEST_F(ReportFiles, ThePictureIsInItOrTheReasonWhyNot) {
  desk_.sources.picture = [](const std::string&, double, int) -> std::string {
    throw EnvironmentError("no graphics here");
  };
  AttemptReportView view = attempt_report_view(desk_, attempt_, kNow);
  if (!view.attempt.picture) GTEST_SKIP() << "the sample was not recorded";
  EXPECT_EQ(view.no_picture, "No picture: no graphics here.");
  desk_.sources.picture = [](const std::string&, double, int) { return std::string("\x89PNG"); };
  EXPECT_EQ(attempt_report_view(desk_, attempt_, kNow).picture_png, "\x89PNG");
}

TEST_F(ReportFiles, NotesOnlyWhereTheyAreAskedFor) {
  AssessmentStore(database_).add_note(trainee_, "", "Lets go too early", {"0192-i", "Dr Ines Okafor"});
  EXPECT_FALSE(read("/report/trainee/" + trainee_ + ".pdf").holds("Lets go too early"));
  EXPECT_TRUE(read("/report/trainee/" + trainee_ + ".pdf", {{"notes", "yes"}}).holds("Lets go too early"));
}

TEST_F(ReportFiles, HtmlIsTheSameReport) {
  ReportQuestion question{ReportFormat::kHtml, false, kNow};
  const std::string html = trainee_file(desk_, trainee_, question);
  EXPECT_TRUE(html.starts_with("<!DOCTYPE html>"));
  EXPECT_NE(html.find("Where things stand"), std::string::npos);
  EXPECT_EQ(html, trainee_file(desk_, trainee_, question));
  EXPECT_THROW(trainee_file(desk_, "nobody", question), InputError);
  EXPECT_THROW(certificate_file(desk_, "nothing", question), InputError);
}

TEST(ReportOfNothing, AnEmptyDatabaseHasACohortReport) {
  Database empty(":memory:");
  Desk desk{empty};
  EXPECT_TRUE(
      read_pdf(cohort_file(desk, {}, {ReportFormat::kPdf, false, kNow})).holds("Nobody has an attempt here yet."));
}

}  // namespace
}  // namespace trocar::review::report_files_test
