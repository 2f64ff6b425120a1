// A signature is somebody's: who may give one, and who may not.
#include "trainees/records/signing.h"

#include "tests/trainees/records/store_samples.h"
#include "trainees/integrity/station_key.h"
#include "trainees/records/accounts.h"
#include "trainees/records/assessments.h"
#include "trainees/records/consents.h"
#include "trainees/records/demo_record.h"
#include "trainees/records/erasure.h"
#include "trainees/records/people_import.h"
#include "trainees/records/programmes.h"
#include "trainees/records/standings.h"
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

class SigningOnDisk : public TemporaryFolder {};

/// What would count nowhere is refused before anything is written, and done once the key is back.
TEST_F(SigningOnDisk, WithoutTheStationsKeyNothingIsTakenThatCountsOnlySigned) {
  const std::filesystem::path file = folder_ / "t.db", away = folder_ / "away";
  const Author author{"0192-account", "Ida Adler"};
  Database d(file);
  for (const char* code : {"T-1", "T-2", "T-3"}) TraineeStore(d).ensure_trainee(code);
  const std::string attempt = store_attempt(d, sample_start("T-2"), sample_result()).uuid;
  CurriculumStore(d).join("T-1", "autumn", author);
  AccountStore(d).add("i.adler", "Ida Adler", Role::kInstructor, "", "correct horse", "");
  AccountStore(d).add("second", "Second", Role::kInstructor, "", "correct horse", "");
  ProgrammeStore programmes(d);
  programmes.save("Basics", "[[step]]\nexercise = \"surface-touch\"\nlevel = \"L1\"\n", author);
  const std::string held = programmes.assign("Basics", "T-1", "", "", author).uuid;
  const std::vector<std::pair<const char*, std::function<void()>>> writings = {
      {"deactivate", [&] { StandingStore(d).set_active({"T-1"}, false, "left", author); }},
      {"assign", [&] { programmes.assign("Basics", "T-2", "", "", author); }},
      {"withdraw", [&] { programmes.withdraw(held, "over", author); }},
      {"add",
       [&] {
         add_person(d, {0, "N-1", "Nora", "", ""}, author);
       }},
      {"list", [&] { take_people(d, "code,name\nN-2,Nils\n", "list", "", author); }},
      {"name", [&] { TraineeStore(d).edit("T-2", "Otto", std::nullopt, ""); }},
      {"account", [&] { AccountStore(d).add("third", "Third", Role::kInstructor, "", "correct horse", ""); }},
      {"password", [&] { AccountStore(d).set_password("i.adler", "another horse", ""); }},
      {"disable", [&] { AccountStore(d).set_disabled("second", true, ""); }},
      {"consent", [&] { ConsentStore(d).record("T-2", "research", true, "I agree.", author); }},
      {"benchmark",
       [&] {
         CurriculumStore(d).add_benchmark(
             {"", "surface-touch", "L1", "time_s", "six people", "median", "", "", 30, 90, 6}, author);
       }},
      {"note", [&] { AssessmentStore(d).add_note("T-2", attempt, "Slower.", author); }},
      {"message", [&] { AssessmentStore(d).add_message("T-2", "Slower.", author); }},
      {"rating", [&] { AssessmentStore(d).add_rating(attempt, "GOALS", "efficiency", 3, author); }},
      {"rated sheet",
       [&] {
         AssessmentStore(d).rate(attempt, "GOALS", {{"autonomy", 4}}, author);
       }},
      {"join", [&] { CurriculumStore(d).join("T-2", "autumn", author); }},
      {"leave", [&] { CurriculumStore(d).leave("T-1", "autumn", author); }},
      {"erasure", [&] { erase_trainee(d, "T-3", ErasureKind::kIdentity, "request of the person", author); }}};
  const std::string before = d.head();
  std::filesystem::rename(key_path(file), away);
  for (const auto& [what, write] : writings)
    EXPECT_NE(message_of<InputError>(write).find("what is not signed counts nowhere: its key t.db.key is missing"),
              std::string::npos)
        << what;
  write_station_key(file, SigningKey::make());
  for (const auto& [what, write] : writings)
    EXPECT_NE(message_of<InputError>(write).find("its key t.db.key is not the one that signs this record"),
              std::string::npos)
        << what;
  EXPECT_EQ(d.head(), before) << "nothing was written";
  std::filesystem::rename(away, key_path(file));
  for (const auto& [what, write] : writings) EXPECT_EQ(message_of<InputError>(write), "") << what;
  EXPECT_FALSE(StandingStore(d).of("T-1").active);
  EXPECT_TRUE(AccountStore(d).verify("i.adler", "another horse"));
  EXPECT_EQ(problems_of(d), "");
}

/// A trainee who meets a note then is not asked to meet it again and again, and meets it once more with the key.
TEST_F(SigningOnDisk, WithoutTheStationsKeyANoteIsMetOnce) {
  const std::filesystem::path file = folder_ / "t.db", away = folder_ / "away";
  Database d(file);
  TraineeStore(d).ensure_trainee("T-1");
  AssessmentStore assessments(d);
  const std::string note = assessments.add_note("T-1", "", "Slower.", {"", "Ida Adler"}).uuid;
  std::filesystem::rename(key_path(file), away);
  ASSERT_TRUE(assessments.newest_unseen("T-1"));
  assessments.mark_seen(note);
  const std::string once = d.head();
  EXPECT_FALSE(assessments.newest_unseen("T-1"));
  assessments.mark_seen(note);
  EXPECT_EQ(d.head(), once);
  std::filesystem::rename(away, key_path(file));
  ASSERT_TRUE(assessments.newest_unseen("T-1"));
  assessments.mark_seen(note);
  EXPECT_FALSE(assessments.newest_unseen("T-1"));
  EXPECT_EQ(problems_of(d).find("was met on"), std::string::npos) << problems_of(d);
}

}  // namespace
}  // namespace trocar::signing_test
