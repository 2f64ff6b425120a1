// Who may have which file: through the gate, as a browser would ask.
#include <gtest/gtest.h>

#include "tests/trainees/desk/server/desk_samples.h"
#include "trainees/records/assessments.h"

namespace trocar::review::report_roles_test {
namespace {

class ReportRoles : public DeskTest {
 protected:
  void SetUp() override {
    add_accounts();
    annas_certificate_ = certify(annas_);
    ottos_certificate_ = certify(ottos_);
    make_gate({}, desk_routes());
  }
  std::string certify(const std::string& attempt) {
    const AttemptSummary s = AttemptStore(database_).find(attempt);
    return AssessmentStore(database_)
        .certify(s.trainee, s.exercise_id, s.level, "1", "14 passes in a row", {"0192-i", "Dr Ines Okafor"})
        .uuid;
  }
  int status(const std::string& path, const Visitor& visitor) { return ask("GET", path, visitor).response.status; }

  std::string annas_certificate_, ottos_certificate_;
};

TEST_F(ReportRoles, ATraineeHasTheOwnFilesOnly) {
  const Visitor anna = signed_in("anna");
  for (const std::string& path : {std::string("/report/trainee/T-anna.pdf"), "/report/attempt/" + annas_ + ".pdf",
                                  "/report/certificate/" + annas_certificate_ + ".pdf"})
    EXPECT_EQ(status(path, anna), 200) << path;
  for (const std::string& path :
       {std::string("/report/trainee/T-otto.pdf"), "/report/attempt/" + ottos_ + ".pdf",
        "/report/certificate/" + ottos_certificate_ + ".pdf", std::string("/report/cohort.pdf"),
        std::string("/report/certificate/unknown.pdf"), "/report/trainee/T-anna.pdf?with=" + ottos_certificate_})
    EXPECT_EQ(status(path, anna), 403) << path;
}

TEST_F(ReportRoles, StaffHasAllAndAStrangerNone) {
  const std::vector<std::string> paths = {"/report/trainee/T-otto.pdf", "/report/attempt/" + ottos_ + ".pdf",
                                          "/report/certificate/" + ottos_certificate_ + ".pdf", "/report/cohort.pdf"};
  for (const std::string& path : paths) {
    EXPECT_EQ(status(path, signed_in("ines")), 200) << path;
    EXPECT_EQ(status(path, signed_in("adam")), 200) << path;
    EXPECT_EQ(status(path, stranger()), 401) << path;
  }
}

TEST_F(ReportRoles, TheAnswerIsAFileToSave) {
  const Answer answer = ask("GET", "/report/certificate/" + annas_certificate_ + ".pdf", signed_in("anna"));
  EXPECT_EQ(answer.response.type, "application/pdf");
  EXPECT_EQ(header_of(*gate_, answer, "Content-Disposition"),
            "attachment; filename=\"certificate-" + annas_certificate_ + ".pdf\"");
  EXPECT_EQ(header_of(*gate_, answer, "X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(header_of(*gate_, answer, "Cache-Control"), "no-store");
}

TEST_F(ReportRoles, OttosSecretIsInNoFileOfAnna) {
  const Visitor anna = signed_in("anna");
  for (const std::string& path :
       {std::string("/report/trainee/T-anna.pdf?notes=yes"), "/report/attempt/" + annas_ + ".pdf?notes=yes"})
    EXPECT_EQ(status(path, anna), 200) << path;
  EXPECT_EQ(status("/report/trainee/T-otto.pdf?notes=yes", anna), 403);
}

}  // namespace
}  // namespace trocar::review::report_roles_test
