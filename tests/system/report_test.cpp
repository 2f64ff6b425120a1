// `trocar review report`: files of a real database, who may read them, what is refused.
#include <sys/stat.h>

#include "tests/system/system_fixture.h"

namespace trocar::test::report_test {
namespace {

class ReviewReport : public SystemTest {
 protected:
  void SetUp() override { ASSERT_EQ(trocar({"trainee", "add", "T01", "--db", "desk.db"}).exit_code, 0); }
  Outcome report(Translator more) const {
    Translator all{"review", "report", "--db", "desk.db"};
    all.insert(all.end(), more.begin(), more.end());
    return trocar(all);
  }
};

TEST_F(ReviewReport, WritesPdfAndHtmlForItsOwnerAlone) {
  for (const char* name : {"t.pdf", "t.html"}) {
    const Outcome outcome = report({"--trainee", "T01", "-o", name});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, std::string(name) + "\n");
    struct stat info {};
    ASSERT_EQ(stat((folder_ / name).c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777U, 0600U) << name;
  }
  EXPECT_TRUE(file_bytes(folder_ / "t.pdf").starts_with("%PDF-1."));
  EXPECT_TRUE(file_bytes(folder_ / "t.html").starts_with("<!DOCTYPE html>"));
  EXPECT_EQ(report({"--cohort", "-o", "c.pdf"}).exit_code, 0);
  const Outcome nobody = report({"--cohort", "--group", "2026 A", "-o", "a.html"});
  EXPECT_EQ(nobody.exit_code, 2);
  EXPECT_NE(nobody.err.find("nobody is in a group of that name"), std::string::npos) << nobody.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.html"));
}

TEST_F(ReviewReport, ReplacesAFileOnlyWhenTold) {
  folder_.write("t.pdf", "mine");
  const Outcome refused = report({"--trainee", "T01", "-o", "t.pdf"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("exists already"), std::string::npos);
  EXPECT_EQ(file_bytes(folder_ / "t.pdf"), "mine");
  EXPECT_EQ(report({"--trainee", "T01", "-o", "t.pdf", "--force"}).exit_code, 0);
  const std::string first = file_bytes(folder_ / "t.pdf");
  EXPECT_TRUE(first.starts_with("%PDF-1."));
  EXPECT_EQ(report({"--trainee", "T01", "-o", "t.pdf", "--force"}).exit_code, 0);
  EXPECT_EQ(file_bytes(folder_ / "t.pdf"), first) << "the same record, the same bytes";
}

TEST_F(ReviewReport, SaysWhatItCannotDo) {
  const std::vector<std::pair<Translator, std::string>> wrong = {
      {{"-o", "t.pdf"}, "of what?"},
      {{"--trainee", "T01", "--cohort", "-o", "t.pdf"}, "of what?"},
      {{"--trainee", "T01", "--group", "A", "-o", "t.pdf"}, "--group goes with --cohort"},
      {{"--trainee", "T01", "-o", "t.doc"}, ".pdf or .html"},
      {{"--trainee", "nobody", "-o", "t.pdf"}, "no trainee \"nobody\""},
      {{"--attempt", "0123", "-o", "t.pdf"}, "0123"},
      {{"--certificate", "none", "-o", "t.pdf"}, "there is none of that number"},
      {{"--cohort", "-o", "nowhere/t.pdf"}, "there is no folder"}};
  for (const auto& [words, said] : wrong) {
    const Outcome outcome = report(words);
    EXPECT_EQ(outcome.exit_code, 2) << said;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "t.pdf")) << "nothing is left behind";
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
    EXPECT_EQ(entry.path().string().find(".part-"), std::string::npos);
}

}  // namespace
}  // namespace trocar::test::report_test
