// What people wrote, changed by somebody who knows SQL and puts the triggers back: each forgery is found and named.
#include "trainees/integrity/sealed_rows.h"

#include <sqlite3.h>

#include "tests/trainees/records/store_samples.h"
#include "trainees/records/accounts.h"
#include "trainees/records/assessments.h"
#include "trainees/records/consents.h"
#include "trainees/records/curricula.h"
#include "trainees/records/erasure.h"
#include "trainees/records/programmes.h"
#include "trainees/records/standings.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::sealed_rows_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReason = "The camera was knocked at 12 s";
const Author kAuthor{"0192-account", "Ida Adler"};

/// A row of every sealed table, two attempts of two trainees.
class SealedRows : public TemporaryFolder {
 protected:
  SealedRows() : file_(folder_ / "t.db") {
    Database database(file_);
    for (const char* code : {"T-1", "T-2"})
      attempts_.push_back(store_attempt(database, sample_start(code), sample_result()).uuid);
    AssessmentStore assessments(database);
    note_ = assessments.add_note("T-1", attempts_[0], "Keep the left hand still.", kAuthor).uuid;
    assessments.add_rating(attempts_[0], "GOALS", "efficiency", 3, kAuthor);
    for (const std::string& attempt : attempts_)
      signatures_.push_back(assessments.sign(attempt, "approval", "", kAuthor).uuid);
    assessments.override_verdict(attempts_[0], false, kReason, kAuthor);
    assessments.revoke(assessments.certify("T-1", "surface-touch", "L1", "1", "{}", kAuthor).uuid, kReason, kAuthor);
    CurriculumStore(database).add("course", "a = 1\n", kAuthor);
    CurriculumStore(database).add_benchmark(
        {"", "surface-touch", "L1", "time_s", "six people", "median", "", "", 30, 90, 6}, kAuthor);
    ConsentStore(database).record("T-1", "research", true, "I agree.", kAuthor);
    AccountStore(database).add("i.adler", "Ida Adler", Role::kInstructor, "", "correct horse", "");
  }
  std::string after(const std::string& sql) const {
    EXPECT_EQ(run_without_triggers(file_, sql), "") << sql;
    return problems_of(Database(file_));
  }
  void expect_found(const std::string& sql, const std::string& problem) const {
    const std::string problems = after(sql);
    EXPECT_NE(problems.find(problem), std::string::npos) << sql << "\n" << problems;
    EXPECT_EQ(problems.find("schema"), std::string::npos) << "the triggers were put back: " << problems;
  }
  fs::path file_;
  std::vector<std::string> attempts_, signatures_;
  std::string note_;
};

TEST_F(SealedRows, AreSoundWhenUntouchedAndWhenTheTriggersWereOutAndBack) {
  EXPECT_EQ(problems_of(Database(file_)), "");
  EXPECT_EQ(after("SELECT 1"), "");
}

TEST_F(SealedRows, AnEditedRowOfAnyTableIsFound) {
  const std::pair<const char*, const char*> edits[] = {{"note", "text = 'Well done.'"},
                                                       {"note", "utc = '2020-01-01T00:00:00.000Z'"},
                                                       {"rating", "value = 5"},
                                                       {"signature", "signer = 'Otto'"},
                                                       {"verdict_override", "passed = 1"},
                                                       {"certificate", "level = 'L3'"},
                                                       {"revocation", "reason = 'by mistake ..'"},
                                                       {"curriculum", "author = 'me'"},
                                                       {"benchmark", "zero_at = 900"},
                                                       {"consent", "given = 0"},
                                                       {"account", "role = 'administrator'"},
                                                       {"account", "password = 'x'"}};
  for (const auto& [table, change] : edits) {
    const fs::path copy = folder_ / (std::string(table) + ".db");
    fs::remove(copy);
    { Database(file_).backup(copy); }
    ASSERT_EQ(run_without_triggers(copy, std::string("UPDATE ") + table + " SET " + change), "") << change;
    const std::string problems = problems_of(Database(copy));
    EXPECT_NE(problems.find(std::string("records: ") + table + " "), std::string::npos) << table << ": " << problems;
    EXPECT_NE(problems.find("was changed after it was written"), std::string::npos) << table << ": " << problems;
    for (const char* more : {"", "-wal", "-shm", ".anchor", ".key"}) fs::remove(copy.string() + more);
  }
}

/// What somebody put into the file counts nowhere, and puts out nothing that counts.
TEST_F(SealedRows, ARowThatCameInAnotherWayCountsNowhere) {
  const auto forged = [&](const std::string& sql) { EXPECT_EQ(run_without_triggers(file_, sql), "") << sql; };
  const std::string when = "'2099-01-01T00:00:00.000Z'", uuid = "'ffffffff-0000-7000-8000-00000000000";
  forged("INSERT INTO standing (uuid, trainee_id, active, reason, author, printed, utc) SELECT " + uuid +
         "1', trainee_id, 0, '', '', 'M', " + when + " FROM person WHERE code = 'T-1'");
  forged("INSERT INTO consent (uuid, trainee_id, purpose, given, text, author, utc) SELECT " + uuid +
         "2', trainee_id, 'research', 0, '', '', " + when + " FROM person WHERE code = 'T-1'");
  forged("INSERT INTO erasure (uuid, trainee_id, kind, rule, author, utc) SELECT " + uuid +
         "3', trainee_id, 'training', '', '', " + when + " FROM person WHERE code = 'T-1'");
  forged(
      "INSERT INTO audit SELECT position + 1, utc, 'x', 'verdict_override noted', (SELECT uuid FROM"
      " verdict_override), 'x', row_hash, 'x', '' FROM audit ORDER BY position DESC LIMIT 1");
  Database database(file_);
  EXPECT_TRUE(StandingStore(database).of("T-1").active);
  EXPECT_TRUE(deactivated(database.connection()).empty());
  EXPECT_TRUE(ConsentStore(database).holds("T-1", "research"));
  ASSERT_EQ(AssessmentStore(database).overrides_of(attempts_[0]).size(), 1U)
      << "an unsigned entry puts out no decision";
}

TEST_F(SealedRows, AForgedRevocationTakesNoCertificateAway) {
  Database database(file_);
  AssessmentStore assessments(database);
  const std::string certificate = assessments.certify("T-2", "surface-touch", "L1", "1", "{}", kAuthor).uuid;
  EXPECT_EQ(run_without_triggers(file_,
                                 "INSERT INTO revocation (uuid, certificate_id, author, printed, reason, utc) SELECT"
                                 " 'ffffffff-0000-7000-8000-000000000001', id, '', 'M', 'issued too early',"
                                 " '2099-01-01T00:00:00.000Z' FROM certificate WHERE uuid = '" +
                                     certificate + "'"),
            "");
  EXPECT_EQ(assessments.certificates_of("T-2").at(0).revoked_utc, "");
  EXPECT_NE(assessments.certificates_of("T-1").at(0).revoked_utc, "");
}

/// Rows that somebody put in, who has no key, keep nobody from writing the real ones.
TEST_F(SealedRows, AForgedEndingKeepsTheRealOneNotOut) {
  Database database(file_);
  AssessmentStore assessments(database);
  ProgrammeStore programmes(database);
  programmes.save("Basics", "[[step]]\nexercise = \"surface-touch\"\nlevel = \"L1\"\n", kAuthor);
  const std::string certificate = assessments.certify("T-2", "surface-touch", "L1", "1", "{}", kAuthor).uuid,
                    assignment = programmes.assign("Basics", "T-2", "", "", kAuthor).uuid,
                    end = "', 'M', 'put in by somebody', '2026-11-30T21:00:00.000Z' FROM ";
  const std::vector<std::string> forgeries = {
      "INSERT INTO revocation (uuid, certificate_id, author, printed, reason, utc) SELECT"
      " '01a22e40-0000-7000-8000-000000000001', id, '" +
          end + "certificate WHERE uuid = '" + certificate + "'",
      "INSERT INTO withdrawal (uuid, assignment_id, author, printed, reason, utc) SELECT"
      " '01a22e40-0000-7000-8000-000000000002', id, '" +
          end + "assignment",
      "INSERT INTO signature (uuid, attempt_id, row_hash, account_uuid, meaning, signer, note, utc) SELECT"
      " '01a22e40-0000-7000-8000-000000000003', id, row_hash, '0192-account', 'review" +
          end + "attempt WHERE uuid = '" + attempts_[0] + "'",
      "INSERT INTO erasure (uuid, trainee_id, author, kind, rule, utc) SELECT '01a22e40-0000-7000-8000-000000000004',"
      " trainee_id, '', 'training', 'none', '2026-11-30T21:00:00.000Z' FROM person WHERE code = 'T-1'"};
  for (const std::string& sql : forgeries) EXPECT_EQ(run_outside(file_, sql), "") << sql;
  assessments.revoke(certificate, kReason, kAuthor);
  ASSERT_EQ(assessments.certificates_of("T-2").size(), 1U);
  EXPECT_EQ(assessments.certificates_of("T-2")[0].revoked_reason, kReason);
  EXPECT_NE(message_of<InputError>([&] { assessments.revoke(certificate, kReason, kAuthor); }).find("was revoked on"),
            std::string::npos);
  programmes.withdraw(assignment, "left the course", kAuthor);
  ASSERT_EQ(programmes.assignments().size(), 1U);
  EXPECT_EQ(programmes.assignments()[0].withdrawn_reason, "left the course");
  assessments.sign(attempts_[0], "review", "", kAuthor);
  EXPECT_NE(message_of<InputError>([&] { assessments.sign(attempts_[0], "review", "", kAuthor); }).find("already"),
            std::string::npos);
  EXPECT_EQ(everything_about(database, "T-2").find("put in by somebody"), std::string::npos);
  erase_trainee(database, "T-1", ErasureKind::kTraining, "request of the person", kAuthor);
  EXPECT_EQ(sql::query_integer(database.connection(), "SELECT count(*) FROM erasure WHERE row_holds('erasure', id)"),
            1);
  for (const char* table : {"revocation", "withdrawal", "erasure"})
    EXPECT_NE(problems_of(database).find(std::string("records: ") + table + " 01a22e40-"), std::string::npos) << table;
}

/// Nobody is told to erase what stands by right, and nothing is excused by an erasure that nobody signed.
TEST_F(SealedRows, AForgedErasureAsksNobodyToErase) {
  EXPECT_EQ(run_outside(file_,
                        "INSERT INTO erasure (uuid, trainee_id, kind, rule, author, utc) SELECT"
                        " '01a22e40-0000-7000-8000-000000000104', trainee_id, 'training', 'x', '',"
                        " '2026-11-30T20:00:00.000Z' FROM person WHERE code = 'T-1'"),
            "");
  const std::string problems = problems_of(Database(file_));
  EXPECT_EQ(problems,
            "records: erasure 01a22e40-0000-7000-8000-000000000104 has no entry in the audit trail: it came in by"
            " another way\n");
  EXPECT_NE(after("UPDATE attempt SET board = 99 WHERE uuid = '" + attempts_[0] + "'")
                .find("attempt " + attempts_[0] + " was changed after it was finished"),
            std::string::npos);
}

TEST_F(SealedRows, AForgedCertificateKeepsTheRealOneNotOut) {
  EXPECT_EQ(run_outside(file_,
                        "INSERT INTO certificate (uuid, trainee_id, exercise_id, level, rule_version, evidence, author,"
                        " printed, utc) SELECT '01a22e40-0000-7000-8000-000000000105', trainee_id, 'surface-touch',"
                        " 'L1', '1', '{}', '', 'M', '2026-11-30T20:00:00.000Z' FROM person WHERE code = 'T-2'"),
            "");
  Database database(file_);
  AssessmentStore assessments(database);
  const auto certify = [&] { assessments.certify("T-2", "surface-touch", "L1", "1", "{}", kAuthor); };
  EXPECT_EQ(message_of<InputError>(certify), "");
  EXPECT_NE(message_of<InputError>(certify).find("holds a certificate"), std::string::npos);
  EXPECT_EQ(assessments.certificates_of("T-2").size(), 2U);
}

TEST_F(SealedRows, AForgedNoteIsShownToNoTraineeAndAForgedMeetingHidesNone) {
  const std::string forged = "ffffffff-0000-7000-8000-000000000106";
  Database database(file_);
  AssessmentStore assessments(database);
  const std::string message = assessments.add_message("T-1", "Come over, please.", kAuthor).uuid;
  EXPECT_EQ(run_outside(
                file_, "INSERT INTO note (uuid, trainee_id, author, printed, text, utc) SELECT '" + forged +
                           "', trainee_id, '', 'Ida Adler', 'Go home.', '2026-11-30T20:00:00.000Z' FROM person WHERE"
                           " code = 'T-1'; INSERT INTO note_seen SELECT id, '2026-11-30T20:00:00.000Z' FROM note WHERE"
                           " uuid IN ('" +
                           note_ + "', '" + message + "'); INSERT INTO audit SELECT position + 1, utc, '', 'message" +
                           " sent', '" + forged + "', '', row_hash, 'x', '' FROM audit ORDER BY position DESC LIMIT 1"),
            "");
  for (const Note& note : assessments.notes_of("T-1")) {
    EXPECT_EQ(note.is_signed, note.uuid != forged);
    EXPECT_EQ(note.seen_utc, "");
  }
  ASSERT_TRUE(assessments.unseen_message("T-1"));
  EXPECT_EQ(assessments.unseen_message("T-1")->uuid, message);
  EXPECT_EQ(run_without_triggers(file_, "DELETE FROM audit WHERE position = (SELECT max(position) FROM audit)"), "");
  for (const std::string& uuid : {message, note_}) {
    ASSERT_TRUE(assessments.newest_unseen("T-1"));
    EXPECT_EQ(assessments.newest_unseen("T-1")->uuid, uuid);
    assessments.mark_seen(uuid);
  }
  EXPECT_FALSE(assessments.newest_unseen("T-1"));
  EXPECT_FALSE(assessments.unseen_message("T-1"));
  EXPECT_NE(problems_of(database).find("note " + note_ + " was met on "), std::string::npos) << "it is still told";
}

/// Schema 5 makes their tables anew.
TEST_F(SealedRows, ARecordOfSchemaFourKeepsItsEndings) {
  const fs::path old = folder_ / "old.db";
  std::string withdrawn;
  {
    Database fourth(old, OpenMode::kCreate, 5000, shipped_migrations().first(4));
    store_attempt(fourth, sample_start("T-1"), sample_result());
    TraineeStore(fourth).ensure_trainee("T-9");
    AssessmentStore assessments(fourth);
    assessments.revoke(assessments.certify("T-1", "surface-touch", "L1", "1", "{}", kAuthor).uuid, kReason, kAuthor);
    ProgrammeStore programmes(fourth);
    programmes.save("Basics", "[[step]]\nexercise = \"surface-touch\"\nlevel = \"L1\"\n", kAuthor);
    withdrawn = programmes.assign("Basics", "T-1", "", "", kAuthor).uuid;
    programmes.withdraw(withdrawn, "left", kAuthor);
    erase_trainee(fourth, "T-9", ErasureKind::kIdentity, "request of the person", kAuthor);
    EXPECT_EQ(problems_of(fourth), "");
  }
  Database now(old);
  EXPECT_EQ(now.migration().from, 4);
  EXPECT_EQ(problems_of(now), "");
  EXPECT_EQ(AssessmentStore(now).certificates_of("T-1").at(0).revoked_reason, kReason);
  EXPECT_NE(message_of<InputError>([&] { ProgrammeStore(now).withdraw(withdrawn, "", kAuthor); }).find("before"),
            std::string::npos);
  for (const char* table : {"revocation", "withdrawal", "erasure"}) {
    EXPECT_EQ(sql::query_integer(now.connection(), std::string("SELECT count(*) FROM ") + table), 1) << table;
    for (const std::string& change :
         {std::string("DELETE FROM ") + table, std::string("UPDATE ") + table + " SET utc = ''",
          std::string("INSERT OR REPLACE INTO ") + table + " SELECT * FROM " + table})
      EXPECT_NE(run_outside(old, change).find(table), std::string::npos) << change;
  }
}

/// A decision whose UUID is another's, and more after a NUL.
TEST_F(SealedRows, ADecisionUnderHalfOfAnothersNameCountsForNothing) {
  EXPECT_EQ(run_without_triggers(file_,
                                 "INSERT INTO verdict_override (uuid, attempt_id, row_hash, author, printed, passed,"
                                 " reason, utc) SELECT uuid || char(0) || 'x', (SELECT id FROM attempt WHERE uuid = '" +
                                     attempts_[1] +
                                     "'), row_hash, author, printed, passed, reason, utc FROM verdict_override"),
            "");
  Database database(file_);
  EXPECT_TRUE(AssessmentStore(database).overrides_of(attempts_[1]).empty());
}

/// An attempt lent to somebody for a moment.
TEST_F(SealedRows, NobodyIsCertifiedForAnothersAttempts) {
  const std::string lend = "UPDATE attempt SET trainee_id = (SELECT trainee_id FROM person WHERE code = '",
                    of = "') WHERE uuid = '" + attempts_[0] + "'";
  EXPECT_EQ(run_without_triggers(file_, lend + "T-2" + of), "");
  Database database(file_);
  AssessmentStore assessments(database);
  const std::string evidence = "{\"attempt\": \"" + attempts_[0] + "\"}";
  EXPECT_NE(message_of<InputError>([&] {
              assessments.certify("T-2", "surface-touch", "L1", "1", evidence, kAuthor);
            }).find("was changed after it was finished"),
            std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { assessments.override_verdict(attempts_[0], true, kReason, kAuthor); }), "");
  EXPECT_EQ(run_without_triggers(file_, lend + "T-1" + of), "");
  EXPECT_NE(message_of<InputError>([&] {
              assessments.certify("T-2", "surface-touch", "L1", "1", evidence, kAuthor);
            }).find("none of this trainee's"),
            std::string::npos);
}

TEST_F(SealedRows, ADeletedRowIsFound) { expect_found("DELETE FROM note", "records: note " + note_ + " is missing"); }

TEST_F(SealedRows, ADeletedRevocationMakesNoCertificateValidAgain) {
  expect_found("DELETE FROM revocation", "records: revocation ");
}

TEST_F(SealedRows, ADeletedAccountIsFound) { expect_found("DELETE FROM account", "records: account "); }

TEST_F(SealedRows, SwappedSignaturesAreFound) {
  expect_found("UPDATE signature SET attempt_id = 3 - attempt_id", "signature " + signatures_[0] + " was changed");
  EXPECT_NE(problems_of(Database(file_))
                .find("signature " + signatures_[1] + " was given for another record than attempt " + attempts_[0]),
            std::string::npos);
}

TEST_F(SealedRows, ASignatureMovedToAnotherAttemptIsFoundEvenWithThatAttemptsHash) {
  expect_found(
      "UPDATE signature SET attempt_id = 2, row_hash = (SELECT row_hash FROM attempt WHERE id = 2) WHERE attempt_id = "
      "1",
      "signature " + signatures_[0] + " was changed after it was written");
}

TEST_F(SealedRows, SwappedIdentifiersAreFound) {
  expect_found("UPDATE signature SET uuid = 'x' WHERE id = 1; UPDATE signature SET uuid = '" + signatures_[0] +
                   "' WHERE id = 2; UPDATE signature SET uuid = '" + signatures_[1] + "' WHERE id = 1",
               "signature " + signatures_[0] + " was changed");
}

TEST_F(SealedRows, ARowThatCameInAnotherWayIsFound) {
  expect_found(
      "INSERT INTO certificate SELECT 9, 'forged', trainee_id, exercise_id, 'L3', rule_version, evidence, author, "
      "printed, utc"
      " FROM certificate",
      "records: certificate forged has no entry in the audit trail: it came in by another way");
}

TEST_F(SealedRows, ARowWithoutIdentifierIsFound) {
  EXPECT_EQ(run_without_triggers(
                file_,
                "INSERT INTO rating (attempt_id, rater, scale, item, value, utc) VALUES (1, 'x', 'GOALS', 'y', 5, '')"),
            "NOT NULL constraint failed: rating.uuid");
}

TEST_F(SealedRows, AReorderedChainIsFound) {
  expect_found(
      "UPDATE attempt SET chain_position = NULL, row_hash = row_hash || 'x' WHERE id = 1;"
      "UPDATE attempt SET chain_position = 1 WHERE id = 2;"
      "UPDATE attempt SET chain_position = 2, row_hash = substr(row_hash, 1, 64) WHERE id = 1",
      "does not follow the attempt before it");
  EXPECT_NE(problems_of(Database(file_)).find("hash chain: attempt " + attempts_[1] + " was changed"),
            std::string::npos)
      << "the position is hashed, too";
}

TEST_F(SealedRows, AReorderedTrailIsFound) {
  expect_found(
      "UPDATE audit SET position = 100 WHERE position = 3; UPDATE audit SET position = 3 WHERE position = 4;"
      "UPDATE audit SET position = 4 WHERE position = 100",
      "audit trail: entry 3");
}

TEST_F(SealedRows, WhichOverrideHoldsDoesNotGoByRowNumbers) {
  Database database(file_);
  AssessmentStore assessments(database);
  assessments.override_verdict(attempts_[0], true, "Seen again on the film", kAuthor);
  ASSERT_EQ(run_without_triggers(file_, "UPDATE verdict_override SET id = 50 WHERE id = 1"), "");
  EXPECT_TRUE(assessments.overrides_of(attempts_[0])[0].passed);
  EXPECT_EQ(problems_of(database), "");
}

TEST_F(SealedRows, AnOldBackupPutBackLosesTheNotesSinceAndIsFound) {
  { Database(file_).backup(folder_ / "copy.db"); }
  EXPECT_EQ(problems_of(Database(folder_ / "copy.db")), "");
  {
    Database database(file_);
    AssessmentStore(database).add_note("T-1", "", "Written after the backup.", kAuthor);
  }
  for (const char* log : {"-wal", "-shm"}) fs::remove(file_.string() + log);
  fs::copy_file(folder_ / "copy.db", file_, fs::copy_options::overwrite_existing);
  EXPECT_NE(problems_of(Database(file_)).find("anchor: the newest entries are missing"), std::string::npos);
}

TEST_F(SealedRows, ANoteTakenOutWithItsEntryIsFoundByTheAnchor) {
  std::string last;
  {
    Database database(file_);
    last = AssessmentStore(database).add_note("T-1", "", "The last one.", kAuthor).uuid;
  }
  expect_found("DELETE FROM note WHERE uuid = '" + last + "'; DELETE FROM audit WHERE subject = '" + last + "'",
               "anchor: the newest entries are missing");
}

TEST_F(SealedRows, AForgedErasureExcusesNothing) {
  expect_found(
      "INSERT INTO erasure VALUES (1, 'forged', 1, 'identity', 'request of the person', '', ''); DELETE FROM note",
      "erasure forged has no entry");
  EXPECT_NE(problems_of(Database(file_)).find("note " + note_ + " is missing"), std::string::npos);
}

TEST_F(SealedRows, ATextThatIsNotTheOneOfItsDigestIsFound) {
  expect_found("UPDATE curriculum SET toml = 'a = 2'",
               "curriculum course, version 1: its text is not the one of its sha256");
}

TEST_F(SealedRows, DigestsFollowTypesAndPlaces) {
  Database database(file_);
  sqlite3* connection = database.connection();
  EXPECT_EQ(digest_of_row(connection, "note", note_).size(), 64u);
  EXPECT_EQ(digest_of_row(connection, "note", note_), digest_of_row(connection, "note", note_));
  EXPECT_NE(digest_of_row(connection, "signature", signatures_[0]),
            digest_of_row(connection, "signature", signatures_[1]));
  EXPECT_THROW(digest_of_row(connection, "signature", note_), InputError);
  EXPECT_THROW(digest_of_row(connection, "no table", note_), InputError);
  const auto& tables = sealed_tables();
  EXPECT_EQ(tables.size(), 13u);
  EXPECT_LT(std::find(tables.begin(), tables.end(), "certificate"),
            std::find(tables.begin(), tables.end(), "revocation"));
}

TEST_F(SealedRows, ConsentsAreGivenAndWithdrawnAndTheNewestHolds) {
  Database database(file_);
  ConsentStore consents(database);
  EXPECT_TRUE(consents.holds("t-1", "research"));
  EXPECT_FALSE(consents.holds("T-1", "film"));
  consents.record("T-1", "research", false, "I withdraw.", kAuthor);
  EXPECT_FALSE(consents.holds("T-1", "research"));
  ASSERT_EQ(consents.of("T-1").size(), 2u);
  EXPECT_EQ(consents.of("T-1")[0].text, "I withdraw.");
  EXPECT_NE(message_of<InputError>([&] {
              consents.record("T-1", "film", false, "I withdraw.", kAuthor);
            }).find("none is given"),
            std::string::npos)
      << "what was never given cannot be withdrawn";
  EXPECT_THROW(consents.record("T-1", "research", false, "Again.", kAuthor), InputError)
      << "nor what was withdrawn before";
  EXPECT_EQ(consents.of("T-1").size(), 2u);
  EXPECT_NE(
      message_of<InputError>([&] { consents.record("T-9", "research", false, "x", kAuthor); }).find("there is none"),
      std::string::npos);
  EXPECT_THROW(consents.record("T-9", "research", true, "x", kAuthor), InputError);
  EXPECT_THROW(consents.record("T-1", "", true, "x", kAuthor), InputError);
  EXPECT_THROW(consents.record("T-1", "research", true, "", kAuthor), InputError);
  EXPECT_EQ(problems_of(database), "");
}

}  // namespace
}  // namespace trocar::sealed_rows_test
