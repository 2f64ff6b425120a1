// Certificates as a table, in the document and as statements: what they certify, and whether they hold.
#include "trainees/exchange/export/certificate_export.h"

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/trainees/exchange/export/export_samples.h"
#include "trainees/exchange/export/table_export.h"
#include "trainees/exchange/export/xapi_export.h"
#include "trainees/records/curricula.h"

namespace trocar::certificate_export_test {
namespace {

using nlohmann::json;

const Author kIssuer{"0192-issuer", "=Ida \"Adler\""};

class CertificateExport : public TemporaryFolder {
 protected:
  /// @returns the certificate of a trainee for one attempt.
  Certificate certify(const std::string& code, const std::string& exercise = "surface-touch") {
    AttemptStart start = sample_start(code);
    start.exercise_id = exercise;
    start.board = ++board_;
    attempt_ = store_attempt(database_, start, sample_result(90));
    return said_.certify(code, exercise, "L1", "7", json{{"attempt", attempt_.uuid}}.dump(), kIssuer);
  }
  test::CsvTable csv(const ExportFilter& filter = {}) {
    std::ostringstream out;
    write_certificates_csv(chosen_certificates(database_, choose_attempts(database_, filter)), out);
    return test::read_csv(out.str());
  }
  std::vector<json> statements() {
    std::vector<json> all;
    for (const XapiSubject& subject : xapi_subjects(database_, choose_attempts(database_, {}), {}, {}))
      if (subject.statement) all.push_back(json::parse(subject.statement->text));
    return all;
  }

  Database database_{":memory:"};
  AssessmentStore said_{database_};
  AttemptId attempt_;
  int board_ = 0;
};

TEST_F(CertificateExport, SaysWhatItCertifiesByWhomAndWhetherItHolds) {
  const Certificate held = certify("A");
  const AttemptId cited = attempt_;
  const Certificate doubted = certify("B");
  said_.override_verdict(attempt_.uuid, false, "The camera was held by another", kIssuer);
  const Certificate withdrawn = certify("C");
  said_.revoke(withdrawn.uuid, "=Given to the wrong person", kIssuer);
  const test::CsvTable table = csv();
  ASSERT_EQ(table.size(), 4u);
  const auto cell = [&](const Certificate& of, const char* column) { return test::cell_of(table, of.uuid, column); };
  EXPECT_EQ(cell(held, "state"), "holds");
  EXPECT_EQ(cell(held, "trainee"), "A");
  EXPECT_EQ(cell(held, "exercise"), "surface-touch");
  EXPECT_EQ(cell(held, "rule_version"), "7");
  EXPECT_EQ(cell(held, "author"), "'=Ida \"Adler\"") << "no spreadsheet runs it";
  EXPECT_EQ(cell(held, "cited_attempt_uuid"), cited.uuid);
  EXPECT_EQ(cell(held, "attempt_uuids"), cited.uuid);
  EXPECT_EQ(cell(held, "withdrawn_utc"), "");
  EXPECT_EQ(cell(doubted, "state"), "in question");
  EXPECT_NE(cell(doubted, "in_question").find("The camera was held by another"), std::string::npos);
  EXPECT_EQ(cell(withdrawn, "state"), "withdrawn");
  EXPECT_EQ(cell(withdrawn, "withdrawn_reason"), "'=Given to the wrong person");
  EXPECT_EQ(cell(withdrawn, "withdrawn_by"), "'=Ida \"Adler\"");
  std::ostringstream out;
  write_json(database_, choose_attempts(database_, {}), out);
  const json document = json::parse(out.str());
  ASSERT_EQ(document["certificates"].size(), 3u);
  EXPECT_EQ(document["certificates"][2]["withdrawn_reason"], "=Given to the wrong person");
  EXPECT_EQ(document["certificates"][0]["in_question"], nullptr);
  EXPECT_EQ(document["certificates"][0]["attempt_uuids"], json::array({cited.uuid}));
}

TEST_F(CertificateExport, TheChoiceHoldsForThemToo) {
  certify("A");
  certify("A", "peg-transfer");
  certify("B");
  CurriculumStore(database_).join("B", "monday", kIssuer);
  EXPECT_EQ(csv({"A"}).size(), 3u);
  EXPECT_EQ(csv({"", "monday"}).size(), 2u);
  EXPECT_EQ(csv({"", "", "peg-transfer"}).size(), 2u);
  EXPECT_EQ(csv({"", "", "", "latest"}).size(), 1u) << "one attempt alone: no certificate";
}

TEST_F(CertificateExport, AsStatementsNothingOfItIsAPersonsNameAndAWithdrawalVoids) {
  certify("A");
  said_.override_verdict(attempt_.uuid, false, "The camera was held by another", kIssuer);
  const Certificate withdrawn = certify("B");
  said_.revoke(withdrawn.uuid, "Given to the wrong person", kIssuer);
  const std::vector<json> all = statements();
  std::vector<std::string> verbs;
  for (const json& one : all) {
    verbs.push_back(one["verb"]["display"]["en"]);
    EXPECT_EQ(xapi_problems(one.dump()), std::vector<std::string>{}) << one.dump();
    for (const char* word : {"Ida", "wrong person", "camera"})
      EXPECT_EQ(one.dump().find(word), std::string::npos) << one.dump();
  }
  EXPECT_EQ(verbs, (std::vector<std::string>{"failed", "passed", "earned", "has in question", "earned", "voided"}));
  EXPECT_EQ(all[2]["context"]["registration"], all[0]["context"]["registration"]);
  EXPECT_EQ(all[3]["context"]["statement"]["id"], all[2]["id"]);
  EXPECT_EQ(all[5]["object"]["id"], all[4]["id"]);
  EXPECT_EQ(all[5]["actor"]["account"]["name"], kIssuer.account_uuid);
  EXPECT_EQ(statements(), all) << "the same record, the same statements";
}

}  // namespace
}  // namespace trocar::certificate_export_test
