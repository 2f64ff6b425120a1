// What the chain of attempts alone cannot show: a missing end, dropped triggers, an altered schema.
#include "trainees/integrity/audit.h"

#include <sqlite3.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>

#include "tests/trainees/records/store_samples.h"
#include "trainees/integrity/anchor_file.h"
#include "trainees/integrity/station_key.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::audit_test {
namespace {

namespace fs = std::filesystem;

class Audit : public TemporaryFolder {
 protected:
  Audit() : file_(folder_ / "t.db") {
    Database database(file_);
    for (int i = 0; i < 3; ++i) store_attempt(database, sample_start(), sample_result(70 + i));
  }
  std::string problems() const {
    std::string all;
    const Database database(file_);
    for (const std::string& problem : database.check()) all += problem + "\n";
    return all;
  }
  void outside(const std::string& sql) const { ASSERT_EQ(run_outside(file_, sql), "") << sql; }
  /// The newest attempt and its rows taken out, the triggers put back as they were.
  void remove_newest(bool with_audit) const {
    std::string sql, restore;
    for (const char* table : {"event_row", "metric_row", "subscore_row", "score_cap", "score", "device_warning",
                              "device_transition_row", "attempt", "audit"}) {
      const std::string name = std::string(table) + "_no_delete";
      sqlite3* raw = nullptr;
      sqlite3_open(file_.c_str(), &raw);
      restore += trigger_text(raw, name) + ";";
      sqlite3_close(raw);
      sql += "DROP TRIGGER " + name + ";";
    }
    sql +=
        "DELETE FROM event_row WHERE id >> 20 = 3; DELETE FROM metric_row WHERE id >> 10 = 3; DELETE FROM subscore_row"
        " WHERE id >> 10 = 3; DELETE FROM score_cap WHERE score_id = 3; DELETE FROM score WHERE id = 3;"
        "DELETE FROM device_warning WHERE attempt_id = 3; DELETE FROM device_transition_row WHERE id >> 20 = 3;"
        "DELETE FROM attempt WHERE id = 3; UPDATE sqlite_sequence SET seq = 2 WHERE name = 'attempt';";
    if (with_audit) sql += "DELETE FROM audit WHERE position > 8;";
    outside(sql + restore);
  }
  static std::string trigger_text(sqlite3* raw, const std::string& name) {
    std::string text;
    const auto take = [](void* to, int, char** values, char**) {
      *static_cast<std::string*>(to) = values[0];
      return 0;
    };
    sqlite3_exec(raw, ("SELECT sql FROM sqlite_schema WHERE name = '" + name + "'").c_str(), take, &text, nullptr);
    return text;
  }
  fs::path file_;
};

TEST_F(Audit, ADatabaseThatWasOnlyUsedIsSound) {
  EXPECT_EQ(problems(), "");
  std::ifstream in(anchor_path(file_));
  EXPECT_EQ(std::count(std::istreambuf_iterator<char>(in), {}, '\n'), 7)
      << "made, and that three attempts began (the first with trainee and exercise) and ended";
}

TEST_F(Audit, ADeletedNewestAttemptIsNoticed) {
  remove_newest(false);
  EXPECT_NE(problems().find("audit trail: attempt "), std::string::npos) << problems();
  EXPECT_NE(problems().find("is missing or was changed"), std::string::npos) << problems();
  EXPECT_EQ(problems().find("schema"), std::string::npos) << "everything else was put back: " << problems();
}

TEST_F(Audit, ADeletedNewestAttemptWithItsEntryIsNoticedByTheAnchor) {
  remove_newest(true);
  EXPECT_EQ(problems().find("audit trail"), std::string::npos) << problems();
  EXPECT_NE(problems().find("anchor: the newest entries are missing: entry 9"), std::string::npos) << problems();
}

TEST_F(Audit, AnOlderCopyPutBackIsNoticed) {
  { Database(file_).backup(folder_ / "copy.db"); }
  EXPECT_TRUE(Database(folder_ / "copy.db").check().empty()) << "a backup brings its anchor along";
  {
    Database database(file_);
    store_attempt(database, sample_start(), sample_result());
  }
  for (const char* log : {"-wal", "-shm"}) fs::remove(file_.string() + log);
  fs::copy_file(folder_ / "copy.db", file_, fs::copy_options::overwrite_existing);
  EXPECT_NE(problems().find("entry 11"), std::string::npos) << problems();
}

TEST_F(Audit, AnotherAttemptInThePlaceOfTheNewestIsNoticed) {
  remove_newest(true);
  {
    Database database(file_);
    EXPECT_NE(message_of<InputError>([&] {
                store_attempt(database, sample_start(), sample_result(99));
              }).find("no longer holds what this program saw"),
              std::string::npos);
  }
  // A program that saw nothing of it goes on.
  const fs::path elsewhere = folder_ / "elsewhere.db";
  const auto move = [](const fs::path& from, const fs::path& to) {
    for (const char* part : {"", ".anchor", ".key"}) fs::rename(from.string() + part, to.string() + part);
  };
  move(file_, elsewhere);
  {
    Database database(elsewhere);
    store_attempt(database, sample_start(), sample_result(99));
  }
  move(elsewhere, file_);
  EXPECT_NE(problems().find("entry 10 of "), std::string::npos) << problems();
  EXPECT_NE(problems().find("is not the one that was anchored"), std::string::npos) << problems();
}

TEST_F(Audit, AMissingAnchorIsAProblemUntilItIsRenewedOnRecord) {
  fs::remove(anchor_path(file_));
  EXPECT_NE(problems().find("t.db.anchor is missing"), std::string::npos) << problems();
  {
    Database database(file_);
    store_attempt(database, sample_start(), sample_result());
  }
  EXPECT_NE(problems().find("begins with entry 11: it is younger than the database"), std::string::npos) << problems();
  { Database(file_).renew_anchor(); }
  EXPECT_EQ(problems(), "");
  sqlite3* raw = nullptr;
  sqlite3_open(file_.c_str(), &raw);
  EXPECT_EQ(audit_action(raw, audit_head(raw).position), kActionRenewed);
  sqlite3_close(raw);
}

/// A link would have lines written into another file, a pipe would have everybody wait.
TEST_F(Audit, ALinkOrAPipeIsNoAnchor) {
  const fs::path other = folder_ / "other.txt";
  std::ofstream(other) << "mine";
  fs::remove(anchor_path(file_));
  fs::create_symlink(other, anchor_path(file_));
  {
    Database database(file_);
    store_attempt(database, sample_start(), sample_result());
  }
  EXPECT_EQ(fs::file_size(other), 4U);
  EXPECT_NE(problems().find("t.db.anchor is missing"), std::string::npos) << problems();
  fs::remove(anchor_path(file_));
  ASSERT_EQ(mkfifo(anchor_path(file_).c_str(), 0600), 0);
  EXPECT_NE(problems().find("t.db.anchor is missing"), std::string::npos) << problems();
}

TEST_F(Audit, AnAnchorThatLagsOrWasCutOffByACrashIsNone) {
  std::ifstream in(anchor_path(file_));
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::ofstream(anchor_path(file_)) << text.substr(0, text.size() - 20);
  EXPECT_EQ(problems(), "");
  {
    Database database(file_);
    store_attempt(database, sample_start(), sample_result());
  }
  EXPECT_EQ(problems(), "") << "the next line is one of its own";
  EXPECT_NE(read_anchor(file_).find("~\n11 "), std::string::npos) << read_anchor(file_);
  std::ofstream(anchor_path(file_), std::ios::app) << "nonsense\n";
  EXPECT_NE(problems().find("a line is not readable"), std::string::npos);
}

TEST_F(Audit, AChangedOrMissingEntryIsNoticed) {
  outside("DROP TRIGGER audit_no_update; UPDATE audit SET detail = 'x' WHERE position = 6");
  EXPECT_NE(problems().find("audit trail: entry 6 (attempt finished) was changed"), std::string::npos) << problems();
  outside("DROP TRIGGER audit_no_delete; DELETE FROM audit WHERE position = 6");
  EXPECT_NE(problems().find("before entry 7 (attempt begun): entries are missing"), std::string::npos);
  EXPECT_NE(problems().find("has no entry"), std::string::npos);
}

/// Who may write the files runs a program of his own, with a key of his own, and puts the station's back.
TEST_F(Audit, EntriesUnderAnotherKeyAreNoticedWhateverFollowsThem) {
  const fs::path key = key_path(file_), kept = folder_ / "kept.key";
  fs::rename(key, kept);
  { Database other(folder_ / "other.db"); }
  fs::copy_file(key_path(folder_ / "other.db"), key);
  {
    Database database(file_);
    EXPECT_NE(message_of<InputError>([&] { store_attempt(database, sample_start(), sample_result(99)); }), "")
        << "the person's row is signed with another key";
    store_attempt(database, sample_start("T-other"), sample_result(99));
  }
  fs::remove(key);
  fs::rename(kept, key);
  {
    Database database(file_);
    store_attempt(database, sample_start(), sample_result());
  }
  EXPECT_EQ(problems(), "audit trail: entry 11 was not signed with the station's key, nor 3 of those after it\n");
}

TEST_F(Audit, AnAttemptThatWasBegunAndDeletedIsNoticed) {
  { AttemptStore(*std::make_unique<Database>(file_)).begin_attempt(sample_start()); }
  outside("DROP TRIGGER attempt_no_delete; DELETE FROM attempt WHERE status = 'running'");
  EXPECT_NE(problems().find(", is missing"), std::string::npos) << problems();
  EXPECT_NE(problems().find("the newest attempts were deleted"), std::string::npos) << problems();
}

TEST_F(Audit, DroppedAndAlteredTriggersAndTablesAreNoticed) {
  outside("DROP TRIGGER score_no_update");
  EXPECT_NE(problems().find("schema: trigger score_no_update is missing"), std::string::npos) << problems();
  outside("CREATE TRIGGER score_no_update BEFORE UPDATE ON score BEGIN SELECT 1; END");
  EXPECT_NE(problems().find("schema: trigger score_no_update was altered"), std::string::npos) << problems();
  outside(
      "CREATE TABLE mine (x INTEGER); ALTER TABLE rating ADD COLUMN extra TEXT; DROP INDEX attempt_running; DROP "
      "TRIGGER exam_once");
  EXPECT_NE(problems().find("schema: table mine does not belong here"), std::string::npos);
  EXPECT_NE(problems().find("schema: table rating was altered"), std::string::npos);
  EXPECT_NE(problems().find("schema: index attempt_running is missing"), std::string::npos);
  EXPECT_NE(problems().find("schema: trigger exam_once is missing"), std::string::npos);
}

TEST_F(Audit, ARecordingWithoutItsAttemptIsNoticed) {
  Database database(file_);
  const AttemptId id = AttemptStore(database).begin_attempt(sample_start());
  fs::create_directories(id.recording.parent_path());
  std::ofstream(id.recording) << "x";
  EXPECT_TRUE(AttemptStore(database).check_recordings().empty());
  std::ofstream(id.recording.parent_path() / "0000.trec") << "x";
  ASSERT_EQ(AttemptStore(database).check_recordings().size(), 1u);
  EXPECT_NE(AttemptStore(database).check_recordings()[0].find("belongs to no attempt"), std::string::npos);
}

TEST_F(Audit, AClockThatWasSetBackIsToldAndNoProblem) {
  Database database(file_);
  EXPECT_TRUE(audit_remarks(database.connection()).empty());
  sql::execute(database.connection(), "DROP TRIGGER audit_no_update");
  const auto say = [&](int position, const char* utc) {
    sql::Statement(database.connection(), "UPDATE audit SET utc = ? WHERE position = ?").bind(utc).bind(position).run();
  };
  const std::int64_t last = audit_head(database.connection()).position;
  for (int position = 1; position <= last; ++position) say(position, "2026-03-02T10:00:05.000Z");
  say(4, "2026-03-02T10:00:03.500Z");
  EXPECT_TRUE(audit_remarks(database.connection()).empty()) << "what keeps a clock right";
  for (int position = 4; position <= last; ++position) say(position, "2026-03-01T09:00:00.000Z");
  const auto told = audit_remarks(database.connection());
  ASSERT_EQ(told.size(), 1U) << "once, not at every entry after it";
  EXPECT_EQ(told[0],
            "the clock was set back before entry 4, from 2026-03-02T10:00:05.000Z to 2026-03-01T09:00:00.000Z: entries "
            "and decisions hold in their order, whatever times they bear");
}

}  // namespace
}  // namespace trocar::audit_test
