// The commands by which a person's rights are kept: note, consent, export, erasure, retention.
#include "app/cli/records/trainee_rights.h"

#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/cli/records/trainee_command.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/records/assessments.h"
#include "trainees/records/trainee_store.h"

namespace trocar::trainee_rights_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class TraineeRights : public TemporaryFolder {
 protected:
  TraineeRights() : file_(folder_ / "t.db") {
    Database database(file_);
    first_ = store_attempt(database, sample_start("T-one"), sample_result()).uuid;
    store_attempt(database, sample_start("T-two"), sample_result());
  }
  TraineeRightsOptions options(const std::string& code = "T-one") const {
    TraineeRightsOptions options;
    options.database = file_;
    options.code = code;
    return options;
  }
  std::string said() {
    const std::string text = out_.str();
    out_.str("");
    return text;
  }
  fs::path file_;
  std::string first_;
  std::ostringstream out_, err_;
};

TEST_F(TraineeRights, ANoteIsOfATraineeOrAnAttempt) {
  TraineeRightsOptions note = options();
  note.text = "Keep the left hand still.";
  note.author = "Ida Adler";
  EXPECT_EQ(trainee_note(note, out_, err_), 0);
  EXPECT_EQ(said().size(), 37u) << "its UUID on a line";
  note.attempt = "latest";
  EXPECT_EQ(trainee_note(note, out_, err_), 0);
  note.attempt = first_.substr(24);
  EXPECT_EQ(trainee_note(note, out_, err_), 0);
  Database database(file_);
  const auto notes = AssessmentStore(database).notes_of("T-one");
  ASSERT_EQ(notes.size(), 3u);
  EXPECT_EQ(notes[2].attempt_uuid, "");
  EXPECT_EQ(notes[1].attempt_uuid, first_) << "the trainee's latest, not anybody's";
  EXPECT_EQ(notes[0].attempt_uuid, first_);
  EXPECT_EQ(notes[0].printed, "Ida Adler");
}

TEST_F(TraineeRights, NotesOnNothingAreRefused) {
  TraineeRightsOptions note = options("T-three");
  note.text = "x";
  EXPECT_THROW(trainee_note(note, out_, err_), InputError);
  note.attempt = "latest";
  EXPECT_THROW(trainee_note(note, out_, err_), InputError);
  note = options("T-two");
  note.text = "x";
  note.attempt = first_;
  EXPECT_THROW(trainee_note(note, out_, err_), InputError) << "another's attempt";
  EXPECT_EQ(said(), "");
}

TEST_F(TraineeRights, AnExportIsWrittenOnceAndForItsOwnerOnly) {
  EXPECT_EQ(trainee_export(options(), out_, err_), 0);
  EXPECT_EQ(Json::parse(said())["attempts"][0]["uuid"], first_);
  TraineeRightsOptions all = options();
  all.output = folder_ / "one.json";
  EXPECT_EQ(trainee_export(all, out_, err_), 0);
  std::ifstream in(all.output);
  EXPECT_EQ(Json::parse(in)["code"], "T-one");
  EXPECT_EQ(fs::status(all.output).permissions() & fs::perms(0777), fs::perms(0600));
  EXPECT_NE(message_of<InputError>([&] { trainee_export(all, out_, err_); }).find("never overwrites"),
            std::string::npos);
  all.output = folder_ / "none" / "one.json";
  EXPECT_THROW(trainee_export(all, out_, err_), EnvironmentError);
  EXPECT_THROW(trainee_export(options("T-three"), out_, err_), InputError);
}

TEST_F(TraineeRights, ConsentIsGivenWithdrawnAndTold) {
  EXPECT_EQ(trainee_consent(options(), out_, err_), 0);
  EXPECT_EQ(said(), "T-one: no consent is recorded\n");
  TraineeRightsOptions consent = options();
  consent.purpose = "research";
  consent.text = "I agree.";
  EXPECT_EQ(trainee_consent(consent, out_, err_), 0);
  EXPECT_NE(said().find("research  given"), std::string::npos);
  consent.withdrawn = true;
  consent.text = "I withdraw.";
  EXPECT_EQ(trainee_consent(consent, out_, err_), 0);
  const std::string told = said();
  EXPECT_NE(told.find("withdrawn"), std::string::npos) << told;
  EXPECT_EQ(told.find("I agree."), std::string::npos) << "the newest holds";
  consent.text = "";
  EXPECT_THROW(trainee_consent(consent, out_, err_), InputError);
}

TEST_F(TraineeRights, ErasingAsksForYesAndSaysWhatWent) {
  const std::string refused = message_of<InputError>([&] { trainee_erase(options(), out_, err_); });
  EXPECT_NE(refused.find("T-one (1 attempt)"), std::string::npos) << refused;
  EXPECT_NE(refused.find("say --yes"), std::string::npos);
  EXPECT_NE(said().find("stay"), std::string::npos) << "what would go, and that attempts stay";
  EXPECT_TRUE(TraineeStore(*std::make_unique<Database>(file_)).find("T-one"));
  TraineeRightsOptions erase = options("t-ONE");
  erase.yes = true;
  EXPECT_EQ(trainee_erase(erase, out_, err_), 0);
  EXPECT_EQ(said().find("T-one: identity erased, 0 notes with it; 1 attempt kept without a name ("), 0u);
  Database database(file_);
  EXPECT_FALSE(TraineeStore(database).find("T-one"));
  EXPECT_EQ(AttemptStore(database).list().size(), 2u);
  EXPECT_EQ(problems_of(database), "");
  EXPECT_THROW(trainee_erase(erase, out_, err_), InputError) << "there is nobody any more";
}

TEST_F(TraineeRights, WhatCannotBeRemovedIsToldByTheExitCode) {
  AttemptStart start = sample_start("T-one");
  start.recording = folder_ / "mine.trec";
  {
    Database database(file_);
    AttemptResult result = sample_result();
    result.recording_sha256 = std::string(64, '0');
    std::ofstream(*start.recording) << "something else";
    store_attempt(database, start, result);
  }
  TraineeRightsOptions erase = options();
  erase.yes = erase.training = true;
  EXPECT_EQ(trainee_erase(erase, out_, err_), 3);
  EXPECT_NE(err_.str().find("mine.trec: is not what attempt"), std::string::npos) << err_.str();
  EXPECT_NE(said().find("2 attempts emptied, 0 files of recordings removed"), std::string::npos);
}

TEST_F(TraineeRights, RetentionListsAndThenErases) {
  TraineeRightsOptions retention = options("");
  retention.days = 365;
  EXPECT_EQ(db_retention(retention, out_, err_), 0);
  EXPECT_EQ(said(), "nobody: every trainee was here within 365 days\n");
  ASSERT_EQ(run_without_triggers(file_,
                                 "UPDATE trainee SET created_utc = '2020-01-01T00:00:00.000Z' WHERE id = 1;"
                                 "UPDATE attempt SET started_utc = '2020-01-01T00:00:00.000Z' WHERE id = 1"),
            "");
  EXPECT_EQ(db_retention(retention, out_, err_), 0);
  const std::string listed = said();
  EXPECT_NE(listed.find("T-one           1  2020-01-01"), std::string::npos) << listed;
  EXPECT_EQ(listed.find("T-two"), std::string::npos);
  retention.erase = true;
  const std::string asked = message_of<InputError>([&] { db_retention(retention, out_, err_); });
  EXPECT_NE(asked.find("nobody was erased: 1 trainee would be"), std::string::npos) << asked;
  EXPECT_NE(asked.find("say --yes"), std::string::npos);
  const std::string preview = said();
  EXPECT_NE(preview.find("T-one"), std::string::npos) << preview;
  EXPECT_NE(preview.find("stay"), std::string::npos) << preview;
  EXPECT_EQ(preview.find("T-two"), std::string::npos) << preview;
  EXPECT_TRUE(TraineeStore(*std::make_unique<Database>(file_)).find("T-one"));
  retention.yes = true;
  retention.author = "Ida Adler";
  EXPECT_EQ(db_retention(retention, out_, err_), 0);
  EXPECT_EQ(said().find("T-one: identity erased"), 0u);
  EXPECT_EQ(db_retention(retention, out_, err_), 0) << "nobody is left to ask about";
  Database database(file_);
  EXPECT_TRUE(TraineeStore(database).find("T-two"));
  EXPECT_FALSE(TraineeStore(database).find("T-one"));
}

TEST_F(TraineeRights, RetentionGoesOnPastOneWhoCannotBeErasedNow) {
  ASSERT_EQ(
      run_without_triggers(file_,
                           "UPDATE trainee SET created_utc = '2020-01-01T00:00:00.000Z';"
                           "UPDATE attempt SET started_utc = '2020-01-01T00:00:00.000Z';"
                           "CREATE TABLE held (id INTEGER PRIMARY KEY, held INTEGER REFERENCES person(trainee_id));"
                           "INSERT INTO held (held) SELECT trainee_id FROM person WHERE code = 'T-one'"),
      "");
  TraineeRightsOptions retention = options("");
  retention.days = 365;
  retention.erase = retention.yes = true;
  EXPECT_EQ(db_retention(retention, out_, err_), 3);
  EXPECT_NE(err_.str().find("FOREIGN KEY constraint failed"), std::string::npos);
  Database database(file_);
  EXPECT_TRUE(TraineeStore(database).find("T-one"));
  EXPECT_FALSE(TraineeStore(database).find("T-two"));
}

TEST_F(TraineeRights, APreviewCountsWhatGoes) {
  TraineeRightsOptions note = options();
  note.text = "Keep the left hand still.";
  note.author = "Ida Adler";
  trainee_note(note, out_, err_);
  said();
  TraineeRightsOptions erase = options();
  erase.training = true;
  EXPECT_THROW(trainee_erase(erase, out_, err_), InputError);
  const std::string preview = said();
  EXPECT_NE(preview.find("are emptied"), std::string::npos) << preview;
  EXPECT_NE(preview.find("1 note"), std::string::npos) << preview;
}

TEST_F(TraineeRights, ASecondErasureFollowsByWhatTheFirstOnePrinted) {
  TraineeRightsOptions erase = options();
  erase.yes = true;
  EXPECT_EQ(trainee_erase(erase, out_, err_), 0);
  const std::string printed = said();
  const std::size_t at = printed.find('(') + 1;
  const std::string uuid = printed.substr(at, 36), code = printed.substr(printed.find("erased-"), 15);
  EXPECT_EQ(code, "erased-" + uuid.substr(28));
  for (const std::string& who : {uuid, code}) {
    erase.code = who;
    erase.training = true;
    EXPECT_EQ(trainee_erase(erase, out_, err_), 0) << who;
    EXPECT_NE(said().find("1 attempt emptied"), std::string::npos) << who;
  }
  EXPECT_EQ(problems_of(Database(file_)), "");
}

TEST_F(TraineeRights, ANameIsKeptShownExportedAndGoesWithTheIdentity) {
  TraineeOptions edit{file_, "T-one"};
  edit.name = "Anna Zimtstern";
  edit.email = "anna@example.org";
  EXPECT_EQ(trainee_edit(edit, out_, err_), 0);
  EXPECT_NE(said().find("Anna Zimtstern, anna@example.org\n"), std::string::npos);
  TraineeOptions show{file_, "T-one"};
  EXPECT_EQ(trainee_show(show, out_, err_), 0);
  EXPECT_NE(said().find("Anna Zimtstern, anna@example.org\n"), std::string::npos);
  show.json = true;
  EXPECT_EQ(trainee_show(show, out_, err_), 0);
  EXPECT_EQ(Json::parse(said())["email"], "anna@example.org");
  EXPECT_EQ(trainee_export(options(), out_, err_), 0);
  EXPECT_EQ(Json::parse(said())["person"]["name"], "Anna Zimtstern");
  TraineeRightsOptions erase = options();
  erase.yes = true;
  EXPECT_EQ(trainee_erase(erase, out_, err_), 0);
  std::ifstream in(file_, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  EXPECT_EQ(bytes.find("Zimtstern"), std::string::npos);
}

TEST_F(TraineeRights, AnExportIsNarrowWhateverTheUmask) {
  for (const mode_t mask : {mode_t{0}, mode_t{0777}}) {
    TraineeRightsOptions all = options();
    all.output = folder_ / ("umask" + std::to_string(mask));
    const mode_t before = umask(mask);
    EXPECT_EQ(trainee_export(all, out_, err_), 0);
    umask(before);
    EXPECT_EQ(fs::status(all.output).permissions() & fs::perms(0777), fs::perms(0600)) << mask;
  }
}

}  // namespace
}  // namespace trocar::trainee_rights_test
