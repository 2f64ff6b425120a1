// A signature is somebody's: who may give one, and who may not.
#include "trainees/records/signing.h"

#include "tests/trainees/records/store_samples.h"
#include "trainees/records/accounts.h"
#include "trainees/records/assessments.h"
#include "trainees/records/curricula.h"
#include "trainees/records/demo_record.h"
#include "trainees/records/trainee_store.h"

namespace trocar::signing_test {
namespace {

constexpr const char* kReason = "The stand slipped in the middle of it";

class Signing : public testing::Test {
 protected:
  std::string refusal(const Author& author) {
    return message_of<InputError>([&] { assessments_.override_verdict(attempt_.uuid, true, kReason, author); });
  }
  Database database_{":memory:"};
  AttemptId attempt_ = store_attempt(database_, sample_start("T-1"), sample_result(60));
  AssessmentStore assessments_{database_};
  AccountStore accounts_{database_};
};

TEST_F(Signing, NeedsNoAccountWhereSomebodyIsAlone) { EXPECT_EQ(refusal({"", "Local instructor"}), ""); }

TEST_F(Signing, NeedsAnAccountOnceThereIsASecondPerson) {
  TraineeStore(database_).ensure_trainee("T-2");
  const Author nobody{"", "Ida Adler"};
  EXPECT_NE(refusal(nobody).find("several people are kept here"), std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { assessments_.sign(attempt_.uuid, "review", "", nobody); }), "");
  EXPECT_NE(message_of<InputError>([&] {
              assessments_.certify("T-1", "surface-touch", "L1", "1", "{}", nobody);
            }).find("no signature"),
            std::string::npos);
  assessments_.add_note("T-1", "", "A note binds nobody.", nobody);
  const Account ida = accounts_.add("i.adler", "Ida Adler", Role::kInstructor, "", "correct horse", "");
  EXPECT_EQ(refusal({ida.uuid, "Ida Adler"}), "");
  EXPECT_TRUE(database_.check().empty());
}

TEST_F(Signing, NeedsAnAccountOnceThereIsOne) {
  accounts_.add("i.adler", "Ida Adler", Role::kInstructor, "", "correct horse", "");
  EXPECT_NE(refusal({"", "Ida Adler"}).find("accounts are kept here"), std::string::npos);
}

TEST_F(Signing, NeedsAPasswordThatNobodyElseGave) {
  const Account admin = accounts_.add("root", "Root", Role::kAdministrator, "", "correct horse", "");
  const Account ida = accounts_.add("i.adler", "Ida Adler", Role::kInstructor, "", "given by root", admin.uuid);
  const Author author{ida.uuid, "Ida Adler"};
  EXPECT_NE(refusal(author).find("set your own first"), std::string::npos);
  EXPECT_NE(message_of<InputError>([&] {
              accounts_.set_own_password("i.adler", "wrong", "my very own");
            }).find("present password is wrong"),
            std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { accounts_.set_own_password("i.adler", "given by root", "given by root"); }),
            "");
  accounts_.set_own_password("i.adler", "given by root", "my very own");
  EXPECT_EQ(refusal(author), "");
  accounts_.set_password("i.adler", "given once more", admin.uuid);
  EXPECT_NE(refusal(author), "") << "a lost one was replaced: two people know it again";
}

TEST_F(Signing, OfADemoBindsNobodyAndIsTaken) {
  Database demo(":memory:");
  mark_demo(demo);
  for (const char* code : {"T-1", "T-2"}) TraineeStore(demo).ensure_trainee(code);
  require_signature(demo, "");
  CurriculumStore(database_).add("demo-cohort", "# invented", {"", "Demo"});
  TraineeStore(database_).ensure_trainee("T-2");
  EXPECT_THROW(require_signature(database_, ""), InputError) << "a name makes no demo";
}

}  // namespace
}  // namespace trocar::signing_test
