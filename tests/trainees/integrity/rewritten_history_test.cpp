// Somebody rewrites the record with all that the program has, the functions that make its hashes among it, and puts the
// anchor right: what shows it then.
#include <sqlite3.h>

#include <fstream>

#include "tests/trainees/records/store_samples.h"
#include "trainees/files/write_file.h"
#include "trainees/integrity/anchor_file.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/attempt_chain.h"
#include "trainees/integrity/audit.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/integrity/station_key.h"
#include "trainees/integrity/witness.h"
#include "trainees/records/accounts.h"
#include "trainees/records/assessments.h"
#include "trainees/records/consents.h"
#include "trainees/records/curricula.h"
#include "trainees/records/standings.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::rewritten_history_test {
namespace {

namespace fs = std::filesystem;

struct Entry {
  std::string actor, action, subject, detail;
};

class RewrittenHistory : public TemporaryFolder {
 protected:
  void SetUp() override {
    Database database(file_);
    for (const double score : {31.0, 42.0, 88.0}) {
      AttemptResult result = sample_result(score);
      result.grade.passed = score > 60;
      store_attempt(database, sample_start(), result);
    }
    write_file(witness_, exported_head(database));
    ASSERT_EQ(problems_of(database), "");
  }

  /// Failures become passes; both chains are made again from their beginning, the anchor too.
  /// @param first detail of the first entry, which names the key; "" as it was, kNoKey none.
  void rewrite(const std::string& first = "") {
    sqlite3* raw = nullptr;
    sqlite3_open(file_.c_str(), &raw);
    for (const std::string& trigger : triggers(raw)) sql::execute(raw, ("DROP TRIGGER " + trigger).c_str());
    sql::execute(raw, "UPDATE score SET value = 95, passed = 1");
    std::vector<Entry> entries;
    {
      sql::Statement rows(raw, "SELECT actor, action, subject, detail FROM audit ORDER BY position");
      while (rows.step()) entries.push_back({rows.text(0), rows.text(1), rows.text(2), rows.text(3)});
    }
    if (!first.empty()) entries.front().detail = first == kNoKey ? "" : first;
    sql::execute(raw,
                 "DELETE FROM audit; UPDATE attempt SET status = 'running', chain_position = NULL, prev_hash = NULL, "
                 "row_hash = NULL");
    for (const Entry& entry : entries) {
      if (entry.action != kActionFinished) {
        append_audit(raw, entry.action, entry.subject, entry.detail, entry.actor);
        continue;
      }
      sql::Statement row(raw, "SELECT id FROM attempt WHERE uuid = ?");
      row.bind(entry.subject).step();
      seal_attempt(raw, row.integer(0), AttemptStatus::kCompleted);
    }
    const AuditHead head = audit_head(raw);
    sqlite3_close_v2(raw);
    fs::remove(anchor_path(file_));
    append_anchor(file_, {1, first_hash()});
    append_anchor(file_, head);
    put_triggers_back();
  }

  static constexpr const char* kNoKey = "no key";
  std::string said() {
    const Database database(file_, OpenMode::kExisting);
    return problems_of(database);
  }
  std::vector<std::string> witnessed() {
    const Database database(file_, OpenMode::kExisting);
    return check_witness(database, witness_);
  }

  const fs::path file_ = folder_ / "t.db", witness_ = folder_ / "head.json";

 private:
  std::vector<std::string> triggers(sqlite3* raw) {
    std::vector<std::string> names;
    sql::Statement rows(raw, "SELECT name, sql FROM sqlite_schema WHERE type = 'trigger'");
    while (rows.step()) {
      names.push_back(rows.text(0));
      made_ += rows.text(1) + ";\n";
    }
    return names;
  }
  void put_triggers_back() {
    EXPECT_EQ(run_outside(file_, made_), "");
    made_.clear();
  }
  std::string first_hash() {
    const Database database(file_, OpenMode::kExisting);
    return audit_hash(database.connection(), 1);
  }
  std::string made_;
};

/// Triggers that change what the program writes would have it sign what it never wrote.
TEST_F(RewrittenHistory, NothingIsWrittenWhereSomebodyElsesTriggerActs) {
  const auto refusal = [&] {
    Database database(file_);
    return message_of<InputError>([&] { AttemptStore(database).begin_attempt(sample_start()); });
  };
  ASSERT_EQ(run_outside(file_,
                        "DROP TRIGGER score_no_update; CREATE TRIGGER z1 AFTER INSERT ON score BEGIN UPDATE score SET"
                        " value = 97, passed = 1 WHERE id = NEW.id; END"),
            "");
  EXPECT_NE(refusal().find("trigger z1 does not belong there"), std::string::npos) << refusal();
  EXPECT_NE(said().find("schema: trigger z1 does not belong here"), std::string::npos) << "what is read is read";
  ASSERT_EQ(run_outside(file_,
                        "DROP TRIGGER z1; DROP TRIGGER attempt_keeps_identity; CREATE TRIGGER"
                        " attempt_keeps_identity AFTER INSERT ON score BEGIN SELECT 1; END"),
            "");
  EXPECT_NE(refusal().find("trigger attempt_keeps_identity was altered"), std::string::npos) << refusal();
  ASSERT_EQ(run_outside(file_, "DROP TRIGGER attempt_keeps_identity"), "");
  EXPECT_EQ(refusal(), "") << "a guard that is gone changes nothing; db check tells";
}

TEST_F(RewrittenHistory, ATriggerPlantedWhileAnAttemptRunsStopsItsEnd) {
  Database database(file_);
  AttemptStore store(database);
  const AttemptId id = store.begin_attempt(sample_start());
  ASSERT_EQ(run_outside(file_, "CREATE TRIGGER z1 AFTER INSERT ON score BEGIN SELECT 1; END"), "");
  EXPECT_NE(message_of<InputError>([&] { store.finish_attempt(id, sample_result()); }).find("trigger z1"),
            std::string::npos);
  ASSERT_EQ(run_outside(file_, "DROP TRIGGER z1"), "");
  store.finish_attempt(id, sample_result());
  EXPECT_EQ(problems_of(database), "");
}

TEST_F(RewrittenHistory, NoNameHidesATriggerOrAnIndex) {
  for (const char* part :
       {"TRIGGER sqlite0stat1 AFTER INSERT ON score BEGIN SELECT 1; END", "INDEX z1 ON score(value)"}) {
    ASSERT_EQ(run_outside(file_, std::string("CREATE ") + part), "");
    Database database(file_);
    EXPECT_NE(message_of<InputError>([&] { AttemptStore(database).begin_attempt(sample_start()); }), "") << part;
    EXPECT_NE(problems_of(database).find("does not belong here"), std::string::npos) << part;
    ASSERT_EQ(run_outside(file_, "DROP TRIGGER IF EXISTS sqlite0stat1; DROP INDEX IF EXISTS z1"), "");
  }
}

/// The file may say by now what it said before, under the number that it had: what acts is what was read in between.
TEST_F(RewrittenHistory, ATriggerThatWasReadAndTakenOutOfTheFileAgainDoesNotAct) {
  const char* const plant =
      "CREATE TRIGGER z1 AFTER INSERT ON score BEGIN UPDATE score SET passed = 1 WHERE id = NEW.id; END";
  const char* const hide = "PRAGMA writable_schema = ON; DELETE FROM sqlite_schema WHERE name = 'z1'";
  const char* const bring_back = "DROP TRIGGER score_no_update";
  ASSERT_EQ(run_outside(file_, bring_back), "");
  Database database(file_);
  AttemptStore store(database);
  AttemptResult failed = sample_result(20);
  failed.grade.passed = false;
  const auto passed = [&] {
    const AttemptId id = store.begin_attempt(sample_start());
    store.finish_attempt(id, failed);
    return store.load(id.uuid).grade.passed;
  };
  EXPECT_FALSE(passed());
  const auto number = sql::query_integer(database.connection(), "PRAGMA schema_version");
  const auto read_page = [&] { sql::query_integer(database.connection(), "SELECT count(*) FROM score"); };
  ASSERT_EQ(run_outside(file_, plant), "");
  read_page();
  ASSERT_EQ(run_outside(file_, hide), "");
  EXPECT_FALSE(passed());
  // Read under another number, then changed, and its old number given back.
  ASSERT_EQ(run_outside(file_, "CREATE TABLE z2 (x); DROP TABLE z2"), "");
  read_page();
  ASSERT_EQ(run_outside(file_, std::string(plant) + "; PRAGMA schema_version = " + std::to_string(number)), "");
  EXPECT_NE(message_of<InputError>([&] { passed(); }).find("z1"), std::string::npos);
}

/// Hashes join fields by line breaks: a signed entry must not be readable as another one.
TEST_F(RewrittenHistory, AnEntryCannotBeDividedInAnotherWay) {
  Database database(file_);
  const auto appended = [&](const std::string& subject, const std::string& detail) {
    return message_of<InputError>([&] {
      AnchoredTransaction transaction(database);
      append_audit(database.connection(), "recording read", subject, detail);
      transaction.commit();
    });
  };
  EXPECT_EQ(appended("x", "y"), "");
  EXPECT_NE(appended("x\nverdict_override added", "y"), "");
  EXPECT_NE(appended("x", "y\n"), "");
  const std::string hash = audit_head(database.connection()).row_hash;
  ASSERT_EQ(run_without_triggers(file_, "UPDATE audit SET row_hash = row_hash || '" + std::string(1, '\n') +
                                            "x' WHERE position = (SELECT max(position) FROM audit)"),
            "");
  EXPECT_NE(appended("x", "y"), "");
  EXPECT_NE(message_of<InputError>([&] { AttemptStore(database).begin_attempt(sample_start()); }), "");
  ASSERT_EQ(run_without_triggers(file_, "UPDATE audit SET row_hash = '" + hash +
                                            "', actor = 'trocar' || char(10) || 'recording read', action = subject,"
                                            " subject = detail, detail = '' WHERE row_hash GLOB '*x'"),
            "");
  EXPECT_NE(said().find("could be read as another one"), std::string::npos) << said();
}

TEST_F(RewrittenHistory, InAnotherEncodingItIsNotOpened) {
  const fs::path other = folder_ / "other.db";
  ASSERT_EQ(run_outside(other, "PRAGMA encoding = 'UTF-16le'; PRAGMA application_id = " +
                                   std::to_string(kApplicationId) + "; CREATE TABLE audit (position)"),
            "");
  EXPECT_NE(message_of<InputError>([&] { Database database(other); }).find("UTF-16le"), std::string::npos);
}

/// No signature is asked of what is older than the first key, so nothing may stand before the first entry.
TEST_F(RewrittenHistory, NothingStandsBeforeTheFirstEntry) {
  std::string uuid;
  {
    Database database(file_);
    uuid = AccountStore(database).add("boss", "Boss", Role::kAdministrator, "", "correct horse", "").uuid;
  }
  ASSERT_EQ(run_without_triggers(file_, "UPDATE account SET name = 'Mallory'"), "");
  std::string digest;
  {
    Database database(file_);
    digest = digest_of_row(database.connection(), "account", uuid);
  }
  ASSERT_EQ(run_without_triggers(file_,
                                 "UPDATE audit SET action = 'x' WHERE action = 'account added'; INSERT INTO audit"
                                 " SELECT -1, utc, actor, 'account added', '" +
                                     uuid + "', '" + digest + "', '', '', '' FROM audit WHERE position = 1"),
            "");
  EXPECT_NE(said().find("entry -1 (account added) stands before the first"), std::string::npos) << said();
  Database database(file_);
  EXPECT_EQ(AccountStore(database).verify("boss", "correct horse"), std::nullopt);
  EXPECT_NE(message_of<InputError>([&] { AttemptStore(database).begin_attempt(sample_start()); }), "");
  EXPECT_TRUE(accounts_kept(database.connection(), true));
}

/// Codes swapped for a moment: what is written in between would be the other's for good.
TEST_F(RewrittenHistory, NothingIsWrittenUnderACodeThatSomebodyMoved) {
  {
    Database database(file_);
    store_attempt(database, sample_start("T-other"), sample_result());
  }
  const char* const swap =
      "UPDATE person SET code = CASE code WHEN 'T-expert' THEN 'T-x' ELSE 'T-expert' END; UPDATE person SET code ="
      " 'T-other' WHERE code = 'T-x'";
  ASSERT_EQ(run_without_triggers(file_, swap), "");
  Database database(file_);
  const auto refused = [&](const std::function<void()>& write) {
    EXPECT_NE(message_of<InputError>(write).find("was changed by another way"), std::string::npos);
  };
  refused([&] { AttemptStore(database).begin_attempt(sample_start("T-other")); });
  refused([&] { AssessmentStore(database).add_note("T-other", "", "Good.", {"", "Ida Adler"}); });
  refused([&] { ConsentStore(database).record("T-other", "research", true, "I agree.", {"", "Ida Adler"}); });
  refused([&] { CurriculumStore(database).join("T-other", "nurses", {"", "Ida Adler"}); });
  refused([&] { StandingStore(database).set_active({"T-other"}, false, "", {"", "Ida Adler"}); });
}

/// The trail cut short while the program runs, so that it goes on from there.
TEST_F(RewrittenHistory, WhatWasSeenOfTheTrailMustStillBeThere) {
  Database database(file_);
  AccountStore(database).add("boss", "Boss", Role::kAdministrator, "", "correct horse", "");
  EXPECT_TRUE(accounts_kept(database.connection(), true));
  store_attempt(database, sample_start(), sample_result());
  ASSERT_EQ(run_without_triggers(file_,
                                 "DELETE FROM account; DELETE FROM audit WHERE position >= (SELECT position FROM audit"
                                 " WHERE action = 'account added')"),
            "");
  EXPECT_TRUE(accounts_kept(database.connection(), true));
  EXPECT_NE(message_of<InputError>([&] {
              store_attempt(database, sample_start(), sample_result());
            }).find("no longer holds what this program saw"),
            std::string::npos);
}

/// An index that was made to lead from a UUID to another row.
TEST_F(RewrittenHistory, WhoSignsInIsTheRowThatWasReadNotOneOfTheSameUuid) {
  std::string uuid;
  {
    Database database(file_);
    AccountStore accounts(database);
    uuid = accounts.add("boss", "Boss", Role::kAdministrator, "", "correct horse", "").uuid;
    accounts.add("other", "Other", Role::kTrainee, "T-expert", "482915", "");
  }
  const std::string password = "(SELECT password FROM account WHERE login = 'other')";
  const std::string forged = "FFFFFFFF" + uuid.substr(8);
  ASSERT_EQ(
      run_without_triggers(file_, "INSERT INTO account (uuid, login, name, role, password, created_utc) VALUES ('" +
                                      forged + "', 'mallory', 'M', 'administrator', " + password +
                                      ", '2026-01-01T00:00:00.000Z'); DELETE FROM account WHERE login = 'other'"),
      "");
  ASSERT_EQ(run_outside(file_, "PRAGMA wal_checkpoint(TRUNCATE)"), "");
  std::ifstream in(file_, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  const std::size_t in_row = bytes.find(forged + "mallory");
  ASSERT_NE(in_row, std::string::npos);
  bytes.replace(in_row, uuid.size(), uuid);
  write_file(file_, bytes);
  Database database(file_, OpenMode::kExisting);
  EXPECT_EQ(AccountStore(database).verify("mallory", "482915"), std::nullopt);
  EXPECT_TRUE(AccountStore(database).verify("boss", "correct horse"));
}

/// While its accounts are out of the way, or its trail does not say so, nobody may be let in as if there were none.
TEST_F(RewrittenHistory, ATrailThatIsNotWholeOpensNothing) {
  Database database(file_);
  EXPECT_FALSE(accounts_kept(database.connection(), true));
  AccountStore(database).add("boss", "Boss", Role::kAdministrator, "", "correct horse", "");
  ASSERT_EQ(run_without_triggers(file_,
                                 "DELETE FROM account; UPDATE audit SET action = 'x' || action WHERE action LIKE"
                                 " 'account %'"),
            "");
  EXPECT_TRUE(accounts_kept(database.connection(), true));
}

/// The trail's first entry says whose key it is: whoever writes another there is told by the key beside the file.
TEST_F(RewrittenHistory, UnderAnotherFirstKeyNobodySignsInWhileTheStationsOwnLiesThere) {
  constexpr const char* kPassword = "correct horse battery";
  {
    Database database(file_);
    AccountStore accounts(database);
    accounts.add("i.adler", "Ida Adler", Role::kInstructor, "", kPassword, "");
    ASSERT_TRUE(accounts.verify("i.adler", kPassword));
  }
  fs::rename(key_path(file_), folder_ / "kept");
  const SigningKey other = SigningKey::make();
  write_station_key(file_, other);
  rewrite(other.public_key());
  {
    Database database(file_);
    EXPECT_TRUE(AccountStore(database).verify("i.adler", kPassword)) << "it is sound in itself";
  }
  fs::remove(key_path(file_));
  fs::rename(folder_ / "kept", key_path(file_));
  Database database(file_);
  EXPECT_FALSE(AccountStore(database).verify("i.adler", kPassword));
}

TEST_F(RewrittenHistory, WithoutItsFirstKeyNothingIsOlderThanTheStations) {
  constexpr const char* kPassword = "correct horse battery";
  Database database(file_);
  AccountStore accounts(database);
  const Account made = accounts.add("i.adler", "Ida Adler", Role::kInstructor, "", kPassword, "");
  ASSERT_EQ(run_without_triggers(file_, "UPDATE account SET role = 'administrator'"), "");
  const std::string digest = digest_of_row(database.connection(), "account", made.uuid);
  ASSERT_EQ(run_without_triggers(file_, "UPDATE audit SET detail = '" + digest +
                                            "', signature = '' WHERE action = 'account added'; UPDATE audit SET detail"
                                            " = '' WHERE position = 1"),
            "");
  EXPECT_FALSE(accounts.verify("i.adler", kPassword));
}

/// Keys that were renewed vouch for those before them.
TEST_F(RewrittenHistory, ARenewedKeyVouchesForTheOldOneOverAWholeTrailAlone) {
  constexpr const char* kPassword = "correct horse battery";
  Database database(file_);
  AccountStore accounts(database);
  accounts.add("i.adler", "Ida Adler", Role::kInstructor, "", kPassword, "");
  fs::remove(key_path(file_));
  const SigningKey fresh = SigningKey::make();
  write_station_key(file_, fresh);
  {
    sql::Transaction transaction(database.connection());
    append_audit(database.connection(), kActionKey, kActionKey, fresh.public_key());
    transaction.commit();
  }
  EXPECT_TRUE(accounts.verify("i.adler", kPassword));
  ASSERT_EQ(run_without_triggers(
                file_, "UPDATE audit SET detail = '" + SigningKey::make().public_key() + "' WHERE position = 1"),
            "");
  EXPECT_FALSE(accounts.verify("i.adler", kPassword));
}

/// A record that another key signed, taken back to a schema that is migrated: the station's key would announce itself.
TEST_F(RewrittenHistory, ARecordWithoutItsKeysEntryIsNotMigrated) {
  rewrite(kNoKey);
  ASSERT_EQ(run_outside(file_, "PRAGMA user_version = 3"), "");
  EXPECT_NE(message_of<InputError>([&] { const Database database(file_); }).find("no entry names the station's key"),
            std::string::npos);
}

TEST_F(RewrittenHistory, WithoutTheKeyItShows) {
  fs::rename(key_path(file_), folder_ / "taken");
  rewrite();
  EXPECT_NE(said().find("is not signed with the station's key"), std::string::npos) << said();
  fs::rename(folder_ / "taken", key_path(file_));
  EXPECT_NE(said().find("is not signed with the station's key"), std::string::npos) << said();
}

TEST_F(RewrittenHistory, AsOneThatNeverHadAKeyItShows) {
  fs::remove(key_path(file_));
  rewrite(kNoKey);
  EXPECT_NE(said().find("no entry names the station's key"), std::string::npos) << said();
}

TEST_F(RewrittenHistory, WithAnotherKeyInItsPlaceItShows) {
  const SigningKey own = SigningKey::make();
  fs::remove(key_path(file_));
  write_station_key(file_, own);
  rewrite();
  EXPECT_NE(said().find("is not the one that the trail names"), std::string::npos) << said();
  EXPECT_NE(said().find("was not signed with the station's key"), std::string::npos) << said();
}

TEST_F(RewrittenHistory, AsAWholeUnderAnotherKeyOnlyAWitnessShowsIt) {
  const SigningKey own = SigningKey::make();
  fs::remove(key_path(file_));
  write_station_key(file_, own);
  rewrite(own.public_key());
  EXPECT_EQ(said(), "") << "this is what docs/data_store.md says, and why heads are kept elsewhere";
  ASSERT_EQ(witnessed().size(), 1u);
  EXPECT_NE(witnessed().front().find("is another"), std::string::npos);
}

TEST_F(RewrittenHistory, ARollbackOfEverythingTogetherIsFoundByTheWitness) {
  for (const char* more : {"", ".anchor"}) fs::copy_file(file_.string() + more, (folder_ / "old").string() + more);
  {
    Database database(file_);
    store_attempt(database, sample_start(), sample_result());
    write_file(witness_, exported_head(database));
  }
  EXPECT_TRUE(witnessed().empty());
  for (const char* more : {"-wal", "-shm"}) fs::remove(file_.string() + more);
  for (const char* more : {"", ".anchor"})
    fs::copy_file((folder_ / "old").string() + more, file_.string() + more, fs::copy_options::overwrite_existing);
  EXPECT_EQ(said(), "");
  ASSERT_EQ(witnessed().size(), 1u);
  EXPECT_NE(witnessed().front().find("the newest entries are missing"), std::string::npos);
}

TEST_F(RewrittenHistory, AWitnessThatWasChangedIsNone) {
  std::ifstream in(witness_);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto at = text.find("row_hash") + 15;
  text[at] = text[at] == 'a' ? 'b' : 'a';
  write_file(witness_, text);
  EXPECT_THROW(witnessed(), InputError);
  write_file(witness_, "{}");
  EXPECT_THROW(witnessed(), InputError);
}

/// Nor is one without a signature, and none is made of a trail that is not whole.
TEST_F(RewrittenHistory, AHeadThatNothingSignsIsNoWitness) {
  const std::string head = [&] {
    const Database database(file_);
    return audit_head(database.connection()).row_hash;
  }();
  write_file(witness_, "{\"format\": \"trocar-head-1\", \"position\": 10, \"row_hash\": \"" + head +
                           "\", \"utc\": \"\", \"key\": \"\", \"signature\": \"\"}");
  EXPECT_NE(message_of<InputError>([&] { witnessed(); }).find("is not signed"), std::string::npos);
  ASSERT_EQ(run_without_triggers(file_, "UPDATE audit SET detail = 'x' WHERE position = 3"), "");
  const Database database(file_);
  EXPECT_NE(message_of<InputError>([&] { exported_head(database); }).find("is not whole"), std::string::npos);
}

TEST_F(RewrittenHistory, ANewKeyIsToldAndWhatItSignsHolds) {
  Database database(file_);
  fs::remove(key_path(file_));
  EXPECT_EQ(problems_of(database), "") << "a copy without its key can still be looked at";
  renew_station_key(database);
  store_attempt(database, sample_start(), sample_result());
  EXPECT_EQ(problems_of(database), "");
  EXPECT_EQ(station_keys(database).size(), 2u);
  renew_station_key(database);
  EXPECT_EQ(problems_of(database), "");
  EXPECT_EQ(station_keys(database).size(), 3u);
  EXPECT_TRUE(fs::exists(key_path(file_).string() + "." + key_words(station_keys(database)[1].public_key)));
}

TEST_F(RewrittenHistory, AKeyThatOthersMayReadIsRefused) {
  fs::permissions(key_path(file_), fs::perms::others_read, fs::perm_options::add);
  EXPECT_NE(message_of<EnvironmentError>([&] {
              Database database(file_);
              store_attempt(database, sample_start(), sample_result());
            }).find("can be read by others"),
            std::string::npos);
}

}  // namespace
}  // namespace trocar::rewritten_history_test
