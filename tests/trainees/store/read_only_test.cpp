// A database that may only be read: what people write is refused with a clear message, and what stood there stands.
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "tests/trainees/records/store_samples.h"
#include "trainees/records/accounts.h"
#include "trainees/records/assessments.h"
#include "trainees/records/curricula.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::read_only_test {
namespace {

namespace fs = std::filesystem;

const Author kAuthor{"0192-account", "Ida Adler"};
constexpr const char* kPassword = "correct horse";

/// What the desk and the window write, each against an open database.
std::vector<std::pair<std::string, std::function<void(Database&)>>> writings() {
  return {
      {"note", [](Database& d) { AssessmentStore(d).add_note("T-1", "", "Slower.", kAuthor); }},
      {"note met", [](Database& d) { AssessmentStore(d).mark_seen(AssessmentStore(d).newest_unseen("T-1")->uuid); }},
      {"signature",
       [](Database& d) { AssessmentStore(d).sign(AttemptStore(d).latest()->uuid, "review", "", kAuthor); }},
      {"certificate",
       [](Database& d) { AssessmentStore(d).certify("T-1", "surface-touch", "L2", "1", "{}", kAuthor); }},
      {"revocation",
       [](Database& d) {
         AssessmentStore(d).revoke(AssessmentStore(d).certificates_of("")[0].uuid, "issued too early", kAuthor);
       }},
      {"account", [](Database& d) { AccountStore(d).add("second", "Second", Role::kInstructor, "", kPassword, ""); }},
      {"password", [](Database& d) { AccountStore(d).set_password("i.adler", "a longer secret", ""); }},
      {"sign-in", [](Database& d) { AccountStore(d).signed_in(AccountStore(d).find("i.adler")->uuid); }},
      {"group", [](Database& d) { CurriculumStore(d).join("T-1", "autumn", kAuthor); }},
      {"name", [](Database& d) { TraineeStore(d).edit("T-1", "Anna", std::nullopt, ""); }}};
}

class ReadOnly : public TemporaryFolder {
 protected:
  ReadOnly() : file_(folder_ / "shut" / "t.db") {
    Database database(file_);
    const std::string attempt = store_attempt(database, sample_start("T-1"), sample_result()).uuid;
    AssessmentStore(database).add_note("T-1", attempt, "Keep the left hand still.", kAuthor);
    AssessmentStore(database).certify("T-1", "surface-touch", "L1", "1", "{}", kAuthor);
    AccountStore(database).add("i.adler", "Ida Adler", Role::kInstructor, "", kPassword, "");
    before_ = state(database);
    fs::permissions(folder_, fs::perms(0755));
  }
  ~ReadOnly() override { fs::permissions(folder_ / "shut", fs::perms(0755)); }
  static std::string state(const Database& database) {
    sqlite3* connection = database.connection();
    std::string all = database.head();
    for (const char* table :
         {"note", "note_seen", "signature", "certificate", "revocation", "account", "membership", "person"}) {
      all += std::string(" ") + table + ":" +
             std::to_string(sql::query_integer(connection, std::string("SELECT count(*) FROM ") + table));
    }
    return all;
  }
  /// In a child that may not write what it does not own. @returns its verdict.
  static bool as_nobody(const std::function<bool()>& action) {
    const pid_t child = fork();
    if (child == 0) _exit((getuid() != 0 || setuid(65534) == 0) && action() ? 0 : 1);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
  void nothing_lost() {
    fs::permissions(folder_ / "shut", fs::perms(0755));
    fs::permissions(file_, fs::perms(0644));
    Database database(file_);
    EXPECT_EQ(state(database), before_);
    EXPECT_EQ(problems_of(database), "");
    EXPECT_TRUE(AccountStore(database).verify("i.adler", kPassword));
  }
  fs::path file_;
  std::string before_;
};

TEST_F(ReadOnly, AFileThatMayNotBeWrittenIsRefusedByEveryStoreAsItIsOpened) {
  fs::permissions(folder_ / "shut", fs::perms(0755));
  fs::permissions(file_, fs::perms(0444));
  for (const auto& [what, write] : writings()) {
    EXPECT_TRUE(as_nobody([&, &action = write] {
      const std::string message = message_of<EnvironmentError>([&] {
        Database database(file_, OpenMode::kExisting);
        action(database);
      });
      return message.find("t.db: is not writable") != std::string::npos;
    })) << what;
  }
  nothing_lost();
}

TEST_F(ReadOnly, AFolderThatMayNotBeWrittenHasNoRoomForTheLog) {
  fs::permissions(file_, fs::perms(0666));
  fs::permissions(folder_ / "shut", fs::perms(0555));
  for (const auto& [what, write] : writings()) {
    EXPECT_TRUE(as_nobody([&, &action = write] {
      const std::string message = message_of<EnvironmentError>([&] {
        Database database(file_, OpenMode::kExisting);
        action(database);
      });
      return message.find("t.db") != std::string::npos;
    })) << what;
  }
  nothing_lost();
}

TEST_F(ReadOnly, ADatabaseThatBecomesSoWhileItIsOpenRefusesEveryWordAndKeepsWhatItHas) {
  {
    Database database(file_);
    sql::execute(database.connection(), "PRAGMA query_only = ON");
    for (const auto& [what, write] : writings()) {
      const std::string message = message_of<EnvironmentError>([&, &action = write] { action(database); });
      EXPECT_NE(message.find("t.db: "), std::string::npos) << what << ": " << message;
      EXPECT_NE(message.find("readonly"), std::string::npos) << what << ": " << message;
      EXPECT_EQ(state(database), before_) << what;
    }
    sql::execute(database.connection(), "PRAGMA query_only = OFF");
    for (const auto& [what, write] : writings()) EXPECT_NO_THROW(write(database)) << what << ": goes on when it may";
    before_ = state(database);
  }
  Database database(file_);
  EXPECT_EQ(state(database), before_);
  EXPECT_EQ(problems_of(database), "");
}

}  // namespace
}  // namespace trocar::read_only_test
