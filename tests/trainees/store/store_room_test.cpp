// A full disk, missing rights, a busy database, a damaged page: what people write is refused whole, with a message, and
// nothing stored is lost.
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>

#include "tests/trainees/records/store_samples.h"
#include "tests/trainees/store/next_schema.h"
#include "trainees/records/accounts.h"
#include "trainees/records/assessments.h"
#include "trainees/records/consents.h"
#include "trainees/records/curricula.h"
#include "trainees/records/erasure.h"
#include "trainees/store/disk_full.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::store_room_test {
namespace {

namespace fs = std::filesystem;

const Author kAuthor{"", "Ida Adler"};
constexpr const char* kReason = "The camera was knocked at 12 s";

struct Write {
  const char* name;
  std::function<void(Database&, const std::string& attempt)> write;
};

/// One of every kind.
const std::vector<Write>& writes() {
  static const std::vector<Write> kWrites{
      {"note", [](Database& d,
                  const std::string& a) { AssessmentStore(d).add_note("T-1", a, std::string(4000, 'x'), kAuthor); }},
      {"rating",
       [](Database& d, const std::string& a) { AssessmentStore(d).add_rating(a, "GOALS", "efficiency", 3, kAuthor); }},
      {"signature",
       [](Database& d, const std::string& a) {
         AssessmentStore(d).sign(a, "review", std::string(4000, 'x'), kAuthor);
       }},
      {"override",
       [](Database& d, const std::string& a) { AssessmentStore(d).override_verdict(a, true, kReason, kAuthor); }},
      {"certificate",
       [](Database& d, const std::string&) {
         AssessmentStore(d).certify("T-1", "surface-touch", "L1", "1", "{}", kAuthor);
       }},
      {"curriculum",
       [](Database& d, const std::string&) { CurriculumStore(d).add("course", std::string(20000, '#'), kAuthor); }},
      {"group", [](Database& d, const std::string&) { CurriculumStore(d).join("T-1", "autumn", kAuthor); }},
      {"consent",
       [](Database& d, const std::string&) { ConsentStore(d).record("T-1", "research", true, "I agree.", kAuthor); }},
      {"account",
       [](Database& d, const std::string&) {
         AccountStore(d).add("adler", "Ida", Role::kInstructor, "", "correct horse", "");
       }},
      {"erasure",
       [](Database& d, const std::string&) { erase_trainee(d, "T-1", ErasureKind::kTraining, "request", kAuthor); }}};
  return kWrites;
}

class StoreRoom : public TemporaryFolder {
 protected:
  StoreRoom() : file_(folder_ / "t.db") {
    Database database(file_);
    attempt_ = store_attempt(database, sample_start("T-1"), sample_result()).uuid;
    AssessmentStore(database).add_note("T-1", attempt_, "There before.", kAuthor);
  }
  static std::int64_t rows(const Database& database) {
    std::int64_t all = 0;
    for (const char* table : {"note", "rating", "signature", "verdict_override", "certificate", "curriculum",
                              "membership", "consent", "account", "erasure", "audit", "person", "metric"}) {
      all += sql::query_integer(database.connection(), std::string("SELECT count(*) FROM ") + table);
    }
    return all;
  }
  fs::path file_;
  std::string attempt_;
};

TEST_F(StoreRoom, ALockedDatabaseRefusesEachWithAMessage) {
  Database holder(file_), database(file_, OpenMode::kExisting, 20);
  const std::int64_t before = rows(database);
  sql::execute(holder.connection(), "BEGIN IMMEDIATE");
  for (const Write& write : writes()) {
    const std::string message = message_of<EnvironmentError>([&] { write.write(database, attempt_); });
    EXPECT_NE(message.find("another program has held the database too long"), std::string::npos)
        << write.name << ": " << message;
    EXPECT_NE(message.find("t.db"), std::string::npos) << write.name;
  }
  EXPECT_EQ(rows(database), before);
  sql::execute(holder.connection(), "ROLLBACK");
  for (const Write& write : writes()) EXPECT_NO_THROW(write.write(database, attempt_)) << write.name;
  EXPECT_EQ(problems_of(database), "");
}

TEST_F(StoreRoom, AFullDiskRefusesEachWholeAndLaterTakesIt) {
  // In a child: the limit on the size of a file stands for the disk and cannot be taken back.
  for (const Write& write : writes()) {
    const fs::path copy = folder_ / (std::string(write.name) + ".db");
    { Database(file_).backup(copy); }
    { Database database(copy); }  // its log, empty
    const pid_t child = fork();
    if (child == 0) {
      std::signal(SIGXFSZ, SIG_IGN);
      Database database(copy);
      const std::int64_t before = rows(database);
      const rlimit small{1000, 1000};  // not a page goes into the log
      setrlimit(RLIMIT_FSIZE, &small);
      const std::string message = message_of<EnvironmentError>([&] { write.write(database, attempt_); });
      const bool clear = message.find(copy.filename().string()) != std::string::npos;
      if (!clear) std::fprintf(stderr, "%s: \"%s\"\n", write.name, message.c_str());
      _exit(clear && rows(database) == before ? 0 : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << write.name;
    Database database(copy);
    EXPECT_EQ(problems_of(database), "") << write.name;
    EXPECT_NO_THROW(write.write(database, attempt_)) << write.name << ": there is room again";
    EXPECT_EQ(problems_of(database), "") << write.name;
  }
}

TEST_F(StoreRoom, WithoutRoomForTheIndexOfItsLogItSaysThatTheDiskIsFull) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{1000, 1000};
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string said = message_of<DiskFull>([&] { Database database(file_, OpenMode::kExisting); });
    const bool clear =
        said.find("t.db: cannot run a statement: the disk is full; make room on it") != std::string::npos;
    if (!clear) std::fprintf(stderr, "\"%s\"\n", said.c_str());
    _exit(clear ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(problems_of(Database(file_)), "") << "there is room again";
}

TEST_F(StoreRoom, ADamagedPageIsFoundAndSaidWhereItIsRead) {
  {
    Database database(file_);
    for (int i = 0; i < 300; ++i) AssessmentStore(database).add_note("T-1", "", std::string(1000, 'x'), kAuthor);
    sql::query_integer(database.connection(), "PRAGMA wal_checkpoint(TRUNCATE)");
  }
  const auto size = fs::file_size(file_);
  std::fstream bytes(file_, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekp(static_cast<std::streamoff>(size / 2 / 4096 * 4096));
  bytes << std::string(8192, '\x7f');
  bytes.close();
  const std::string said = message_of<InputError>([&] {
    const Database database(file_);
    const std::string problems = problems_of(database);
    if (!problems.empty()) throw InputError(problems);
  });
  EXPECT_NE(said, "");
  EXPECT_NE(said.find("t.db") != std::string::npos || said.find("integrity: ") != std::string::npos, false) << said;
}

TEST_F(StoreRoom, AMigrationWithoutRoomLeavesTheOldDatabase) {
  make_store(folder_ / "old.db", 30);
  const auto size = fs::file_size(folder_ / "old.db");
  for (const double share : {0.2, 1.01}) {  // no room for the backup; none for the log of the migration
    const pid_t child = fork();
    if (child == 0) {
      std::signal(SIGXFSZ, SIG_IGN);
      const auto bytes = static_cast<rlim_t>(static_cast<double>(size) * share);
      const rlimit small{bytes, bytes};
      setrlimit(RLIMIT_FSIZE, &small);
      const std::string message = message_of<EnvironmentError>([&] { open_by_next_program(folder_ / "old.db"); });
      _exit(message.empty() && share < 1 ? 1 : 0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << share;
  }
  Database database = open_by_next_program(folder_ / "old.db");
  EXPECT_EQ(AttemptStore(database).list().size(), 30u);
  EXPECT_EQ(problems_of(database), "");
}

}  // namespace
}  // namespace trocar::store_room_test
