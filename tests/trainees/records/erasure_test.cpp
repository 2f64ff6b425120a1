// The rights of a person: everything about one can be had, and be taken away; what is left tells nobody and still
// proves the rest.
#include "trainees/records/erasure.h"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "haptics/digest/digest.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/records/accounts.h"
#include "trainees/records/cohort.h"
#include "trainees/records/consents.h"
#include "trainees/records/curricula.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::erasure_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const Author kAuthor{"0192-account", "Ida Adler"};
constexpr const char* kWord = "Zimtstern";  // in everything that must go

class Erasure : public TemporaryFolder {
 protected:
  Erasure() : file_(folder_ / "t.db"), database_(file_), assessments_(database_) {
    for (int i = 0; i < 3; ++i) attempts_.push_back(recorded(kCode));
    other_ = recorded("T-other");
    TraineeStore(database_).edit(kCode, "Zimtstern, Anna", "a@zimtstern", "");
    assessments_.add_note(kCode, attempts_[0], std::string("Zimtstern: keep the left hand still."), kAuthor);
    assessments_.mark_seen(assessments_.newest_unseen(kCode)->uuid);
    assessments_.add_note("T-other", other_, "Good.", kAuthor);
    assessments_.add_rating(attempts_[0], "GOALS", "efficiency", 3, kAuthor);
    assessments_.sign(attempts_[0], "approval", "", kAuthor);
    assessments_.sign(other_, "approval", "", kAuthor);
    assessments_.override_verdict(attempts_[1], true, "The camera was knocked", kAuthor);
    assessments_.revoke(assessments_.certify(kCode, "surface-touch", "L1", "1", "{}", kAuthor).uuid, "issued too early",
                        kAuthor);
    ConsentStore(database_).record(kCode, "research", true, "I, Zimtstern, agree.", kAuthor);
    CurriculumStore(database_).join(kCode, "autumn", kAuthor);
    const Account account =
        AccountStore(database_).add("zimtstern", "Anna Zimtstern", Role::kTrainee, kCode, "580274", "");
    assessments_.sign(attempts_[2], "authorship", "", {account.uuid, "Anna Zimtstern"});
    assessments_.add_rating(attempts_[2], "self", "overall", 3, {account.uuid, "Anna Zimtstern"});
  }
  /// An attempt with a recording of its own.
  std::string recorded(const std::string& trainee) {
    AttemptStore store(database_);
    const AttemptId id = store.begin_attempt(sample_start(trainee));
    fs::create_directories(id.recording.parent_path());
    std::ofstream(id.recording) << "motion of " << id.uuid;  // no recording says who
    std::ofstream(id.recording.parent_path() / (id.uuid + ".safety.csv")) << "stop";
    AttemptResult result = sample_result();
    result.recording_sha256 = digest::of_file(id.recording);
    store.finish_attempt(id, result);
    return id.uuid;
  }
  fs::path recording(const std::string& uuid) const { return folder_ / "t.recordings" / (uuid + ".trec"); }
  ErasureReport erase(ErasureKind kind, const std::string& who = kCode) {
    return erase_trainee(database_, who, kind, "request of the person", kAuthor);
  }
  std::int64_t count(const std::string& what) const {
    return sql::query_integer(database_.connection(), "SELECT count(*) FROM " + what);
  }
  std::string problems() const {
    std::string all = problems_of(database_);
    for (const std::string& problem : AttemptStore(*const_cast<Database*>(&database_)).check_recordings())
      all += problem + "\n";
    return all;
  }
  /// Files of the folder in which the word stands in any spelling, byte for byte.
  std::vector<std::string> files_with_the_word() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      if (!entry.is_regular_file()) continue;
      std::ifstream in(entry.path(), std::ios::binary);
      std::string bytes((std::istreambuf_iterator<char>(in)), {});
      for (char& c : bytes) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      if (bytes.find("zimtstern") != std::string::npos) found.push_back(entry.path().filename().string());
    }
    return found;
  }
  static constexpr const char* kCode = "T-Zimtstern";
  fs::path file_;
  Database database_;
  AssessmentStore assessments_;
  std::vector<std::string> attempts_;
  std::string other_;
};

TEST_F(Erasure, OfTheIdentityLeavesAttemptsThatNobodyCanTell) {
  const ErasureReport report = erase(ErasureKind::kIdentity);
  EXPECT_EQ(report.attempts, 3);
  EXPECT_EQ(report.notes, 1);
  EXPECT_TRUE(report.recordings.empty());
  EXPECT_TRUE(report.left.empty()) << report.left[0];
  for (const char* table : {"consent", "membership", "account", "note_seen"}) EXPECT_EQ(count(table), 0) << table;
  EXPECT_EQ(count("person"), 1) << "the other";
  EXPECT_EQ(count("note"), 1);
  EXPECT_EQ(count("signature"), 2) << "what they signed themselves has gone, what was signed of them stays";
  EXPECT_EQ(count("rating"), 1);
  EXPECT_EQ(count("metric"), 4 * 3);
  EXPECT_EQ(AttemptStore(database_).load(attempts_[0]).trainee, "erased-" + report.trainee_uuid.substr(28));
  EXPECT_TRUE(fs::exists(recording(attempts_[0])));
  EXPECT_EQ(problems(), "");
  EXPECT_FALSE(AccountStore(database_).verify("zimtstern", "580274"));
  EXPECT_EQ(TraineeStore(database_).ensure_trainee(kCode).attempts, 0) << "the same code again is somebody new";
}

TEST_F(Erasure, OverwritesTheBytes) {
  sql::query_integer(database_.connection(), "PRAGMA wal_checkpoint(TRUNCATE)");
  ASSERT_EQ(files_with_the_word(), std::vector<std::string>{"t.db"}) << "before";
  erase(ErasureKind::kIdentity);
  EXPECT_EQ(files_with_the_word(), std::vector<std::string>{}) << kWord;
}

TEST_F(Erasure, OfTheTrainingDataLeavesBareAttemptsInAChainThatHolds) {
  const ErasureReport report = erase(ErasureKind::kTraining);
  EXPECT_EQ(report.recordings.size(), 6u) << "each with its record of a stop";
  EXPECT_TRUE(report.left.empty());
  for (const char* table : {"score", "signature", "note"}) EXPECT_EQ(count(table), 1) << table << ": the other's";
  EXPECT_EQ(count("metric"), 3);
  EXPECT_EQ(count("event"), 2);
  for (const char* table : {"rating", "verdict_override", "certificate", "revocation"})
    EXPECT_EQ(count(table), 0) << table;
  EXPECT_EQ(count("attempt"), 4);
  EXPECT_FALSE(fs::exists(recording(attempts_[0])));
  EXPECT_TRUE(fs::exists(recording(other_)));
  EXPECT_EQ(problems(), "");
  EXPECT_EQ(files_with_the_word(), std::vector<std::string>{});
  store_attempt(database_, sample_start("T-new"), sample_result());
  EXPECT_EQ(problems(), "");
  EXPECT_EQ(cohort(database_, "T-other").size(), 1u);
}

TEST_F(Erasure, OfTheTrainingDataMayFollowThatOfTheIdentity) {
  const ErasureReport first = erase(ErasureKind::kIdentity);
  const ErasureReport second = erase(ErasureKind::kTraining, "erased-" + first.trainee_uuid.substr(28));
  EXPECT_EQ(second.trainee_uuid, first.trainee_uuid);
  EXPECT_EQ(second.recordings.size(), 6u);
  EXPECT_EQ(count("erasure"), 2);
  EXPECT_EQ(problems(), "");
}

TEST_F(Erasure, FollowsByTheIdentifierThatTheFirstOnePrinted) {
  const ErasureReport first = erase(ErasureKind::kIdentity);
  EXPECT_EQ(TraineeStore(database_).find(first.trainee_uuid)->code, "erased-" + first.trainee_uuid.substr(28));
  EXPECT_EQ(Json::parse(everything_about(database_, first.trainee_uuid))["trainee"], first.trainee_uuid);
  const ErasureReport second = erase(ErasureKind::kTraining, first.trainee_uuid);
  EXPECT_EQ(second.trainee_uuid, first.trainee_uuid);
  EXPECT_EQ(second.recordings.size(), 6u);
  EXPECT_EQ(problems(), "");
}

TEST_F(Erasure, IsToldBeforehandAndNothingIsDone) {
  const std::string before = sql::query_text(database_.connection(), "SELECT max(position) FROM audit");
  const ErasurePreview identity = preview_erasure(database_, "t-zimtstern", ErasureKind::kIdentity);
  EXPECT_EQ(identity.code, kCode);
  EXPECT_EQ(identity.attempts, 3);
  EXPECT_EQ(identity.notes, 1);
  EXPECT_EQ(identity.consents, 1);
  EXPECT_EQ(identity.groups, 1);
  EXPECT_EQ(identity.accounts, 1);
  EXPECT_EQ(identity.assessments, 2) << "the own signature and rating";
  EXPECT_EQ(identity.certificates + identity.recordings, 0);
  const ErasurePreview training = preview_erasure(database_, kCode, ErasureKind::kTraining);
  EXPECT_EQ(training.assessments, 5);
  EXPECT_EQ(training.certificates, 1);
  EXPECT_EQ(training.recordings, 3);
  EXPECT_EQ(sql::query_text(database_.connection(), "SELECT max(position) FROM audit"), before);
  EXPECT_EQ(count("person"), 2);
  EXPECT_TRUE(fs::exists(recording(attempts_[0])));
  EXPECT_THROW(preview_erasure(database_, "T-9", ErasureKind::kIdentity), InputError);
}

TEST_F(Erasure, LeavesNobodyBehindInCohortsAndExports) {
  EXPECT_EQ(cohort(database_).size(), 2u);
  erase(ErasureKind::kTraining);
  ASSERT_EQ(cohort(database_).size(), 1u);
  EXPECT_EQ(cohort(database_)[0].trainee, "T-other");
  EXPECT_EQ(people_erased(database_), 1);
}

TEST_F(Erasure, ABareAttemptIsNotFilledAgain) {
  erase(ErasureKind::kTraining);
  ASSERT_EQ(run_without_triggers(file_, "INSERT INTO device_warning VALUES (1, 0, 'heat', 1, 1)"), "");
  EXPECT_NE(problems().find("has rows although its training data were erased"), std::string::npos) << problems();
}

TEST_F(Erasure, IsCompletedByTheSameCallAfterAnInterruption) {
  const std::string who = "erased-" + erase(ErasureKind::kTraining).trainee_uuid.substr(28);
  std::ofstream(recording(attempts_[0])) << "still there";
  EXPECT_NE(problems().find("is still there although its training data were erased"), std::string::npos) << problems();
  const ErasureReport again = erase(ErasureKind::kTraining, who);
  EXPECT_EQ(again.recordings.size(), 1u);
  EXPECT_EQ(count("erasure"), 1) << "recorded once";
  EXPECT_EQ(problems(), "");
}

TEST_F(Erasure, ForgeriesInWhatItLeftAreFound) {
  erase(ErasureKind::kTraining);
  ASSERT_EQ(run_without_triggers(
                file_, "INSERT INTO score VALUES (99, 1, 0, (SELECT sha256 FROM ruleset), 100, 1, 'proficient')"),
            "");
  EXPECT_NE(problems().find("has rows although its training data were erased"), std::string::npos) << problems();
  ASSERT_EQ(run_without_triggers(file_, "DELETE FROM score WHERE id = 99; DELETE FROM attempt WHERE id = 2"), "");
  EXPECT_NE(problems().find("attempts 2 to 2 are missing"), std::string::npos) << problems();
}

TEST_F(Erasure, SparesAFileThatIsNotTheRecordingAnyMore) {
  AttemptStart start = sample_start(kCode);
  start.recording = folder_ / "holiday.trec";
  AttemptStore store(database_);
  const AttemptId id = store.begin_attempt(start);
  std::ofstream(*start.recording) << "motion";
  AttemptResult result = sample_result();
  result.recording_sha256 = digest::of_file(*start.recording);
  store.finish_attempt(id, result);
  std::ofstream(*start.recording) << "my holiday film";
  const ErasureReport report = erase(ErasureKind::kTraining);
  ASSERT_EQ(report.left.size(), 1u);
  EXPECT_NE(report.left[0].find("holiday.trec: is not what attempt"), std::string::npos) << report.left[0];
  EXPECT_TRUE(fs::exists(*start.recording));
}

/// The row that names the file is in the record, and whoever can write there must not choose what goes.
TEST_F(Erasure, TakesNoFileThatOnlyARowNames) {
  const fs::path home = folder_ / "home", own = home / (attempts_[0] + ".trec");
  fs::create_directories(home);
  for (const char* name : {"thesis.docx", "thesis.notes.txt"}) std::ofstream(home / name) << "my thesis";
  std::ofstream(own) << "somebody's";
  ASSERT_EQ(run_without_triggers(file_, "UPDATE attempt SET recording_path = '" + own.string() + "' WHERE uuid = '" +
                                            attempts_[0] + "'; UPDATE attempt SET uuid = 'thesis', recording_path = '" +
                                            (home / "thesis.docx").string() + "' WHERE uuid = '" + attempts_[1] + "'"),
            "");
  fs::remove(recording(attempts_[0]));
  const ErasureReport report = erase(ErasureKind::kTraining);
  EXPECT_EQ(report.left.size(), 2u);
  for (const fs::path& file : {home / "thesis.docx", home / "thesis.notes.txt", own}) EXPECT_TRUE(fs::exists(file));
}

TEST_F(Erasure, IsRefusedWhileAnAttemptRunsAndForNobody) {
  const auto nobody = [&] { erase(ErasureKind::kIdentity, "T-9"); };
  EXPECT_NE(message_of<InputError>(nobody).find("there is none"), std::string::npos);
  EXPECT_THROW(erase_trainee(database_, kCode, ErasureKind::kIdentity, "", kAuthor), InputError) << "without a reason";
  AttemptStore(database_).begin_attempt(sample_start(kCode));
  EXPECT_NE(message_of<InputError>([&] { erase(ErasureKind::kIdentity); }).find("is running"), std::string::npos);
  EXPECT_EQ(count("erasure"), 0);
  EXPECT_EQ(count("note"), 2);
}

TEST_F(Erasure, SaysThatAReaderKeepsTheLog) {
  Database reader(file_, OpenMode::kExisting, 50);
  sql::execute(reader.connection(), "BEGIN; SELECT count(*) FROM note");
  sql::query_integer(database_.connection(), "PRAGMA busy_timeout = 50");
  const ErasureReport report = erase(ErasureKind::kIdentity);
  ASSERT_EQ(report.left.size(), 1u);
  EXPECT_NE(report.left[0].find("keeps erased pages until all have ended"), std::string::npos);
}

TEST_F(Erasure, NothingCanBeSaidOfWhatHasGone) {
  erase(ErasureKind::kTraining);
  EXPECT_THROW(assessments_.add_note(kCode, "", "x", kAuthor), InputError);
  EXPECT_NE(message_of<InputError>([&] { assessments_.sign(attempts_[0], "review", "", kAuthor); }).find("were erased"),
            std::string::npos);
  EXPECT_THROW(TraineeStore(database_).ensure_trainee("Erased-0123"), InputError)
      << "a code that would look like an erased one";
}

TEST_F(Erasure, RetentionFindsThoseWhoHaveNotBeenHereForLong) {
  TraineeStore(database_).ensure_trainee("T-never");
  ASSERT_EQ(run_without_triggers(file_,
                                 "UPDATE attempt SET started_utc = '2024-01-01T00:00:00.000Z' WHERE trainee_id = 1;"
                                 "UPDATE trainee SET created_utc = '2023-01-01T00:00:00.000Z'"),
            "");
  EXPECT_EQ(older_than(database_, 365, "2024-12-30T23:59:59.000Z"), (std::vector<std::string>{"T-never"}))
      << "364 days";
  EXPECT_EQ(older_than(database_, 365, "2025-01-02T00:00:00.000Z"), (std::vector<std::string>{"T-never", kCode}));
  AttemptStore(database_).begin_attempt(sample_start(kCode));
  EXPECT_EQ(older_than(database_, 365, "2100-01-01T00:00:00.000Z"), (std::vector<std::string>{"T-never", "T-other"}))
      << "not while an attempt runs";
}

TEST_F(Erasure, EverythingAboutAPersonIsThereAndNothingOfOthers) {
  const std::string text = everything_about(database_, "t-zimtstern");
  const Json all = Json::parse(text);
  EXPECT_EQ(all["person"]["email"], "a@zimtstern");
  EXPECT_EQ(all["account"]["login"], "zimtstern");
  EXPECT_FALSE(all["account"].contains("password"));
  EXPECT_EQ(text.find("argon2"), std::string::npos);
  EXPECT_EQ(all["groups"][0]["group_name"], "autumn");
  EXPECT_EQ(all["consents"][0]["given"], 1);
  EXPECT_EQ(all["notes"].size(), 1u);
  EXPECT_EQ(all["notes"][0]["attempt"], attempts_[0]);
  EXPECT_TRUE(all["notes"][0]["seen_utc"].is_string());
  EXPECT_EQ(all["certificates"][0]["revoked_reason"], "issued too early");
  ASSERT_EQ(all["attempts"].size(), 3u);
  const Json& first = all["attempts"][0];
  const AttemptResult stored = AttemptStore(database_).load(attempts_[0]);
  ASSERT_EQ(first["scores"][0]["metrics"].size(), stored.grade.metrics.size());
  for (std::size_t i = 0; i < stored.grade.metrics.size(); ++i) {
    const Json& value = first["scores"][0]["metrics"][i]["value"];
    EXPECT_EQ(value.is_null() ? std::nullopt : std::optional(value.get<double>()), stored.grade.metrics[i].value);
  }
  EXPECT_EQ(first["events"].size(), 2u);
  EXPECT_EQ(first["device_warnings"].size(), 2u);
  EXPECT_EQ(first["signatures"][0]["signer"], "Ida Adler");
  EXPECT_EQ(first["ratings"].size(), 1u);
  EXPECT_EQ(all["attempts"][1]["overrides"][0]["reason"], "The camera was knocked");
  EXPECT_EQ(first["recording"]["file"], recording(attempts_[0]).string());
  EXPECT_EQ(first["recording"]["present"], true);
  EXPECT_EQ(text.find(other_), std::string::npos);
  EXPECT_EQ(text.find("T-other"), std::string::npos);
  EXPECT_EQ(text, everything_about(database_, kCode)) << "the same bytes again";
  EXPECT_THROW(everything_about(database_, "T-9"), InputError);
}

TEST_F(Erasure, TheTrailOfAPersonIsPartOfTheirRecord) {
  const Json all = Json::parse(everything_about(database_, kCode));
  std::vector<std::string> actions;
  for (const Json& entry : all["audit"]) actions.push_back(entry["action"]);
  for (const char* action :
       {"attempt finished", "note added", "group joined", "account added", "signature added", "revocation added"}) {
    EXPECT_NE(std::find(actions.begin(), actions.end(), action), actions.end()) << action;
  }
  const std::string who = "erased-" + erase(ErasureKind::kIdentity).trainee_uuid.substr(28);
  const Json after = Json::parse(everything_about(database_, who));
  EXPECT_TRUE(after["person"].is_null());
  EXPECT_EQ(after["erasures"][0]["rule"], "request of the person");
  EXPECT_EQ(after["attempts"].size(), 3u);
}

}  // namespace
}  // namespace trocar::erasure_test
