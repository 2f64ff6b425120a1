// Opening: new, existing, missing, foreign, damaged, newer, busy, full, two at once.
#include "trainees/store/database.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>

#include "tests/trainees/records/store_samples.h"
#include "trainees/records/trainee_store.h"

namespace trocar::database_test {
namespace {

namespace fs = std::filesystem;
using DatabaseFile = TemporaryFolder;

TEST_F(DatabaseFile, IsMadeWithItsFolderAtTheNewestSchema) {
  const Database database(folder_ / "a" / "b" / "t.db");
  EXPECT_EQ(database.schema_version(), shipped_migrations().back().version);
  EXPECT_TRUE(fs::exists(folder_ / "a" / "b" / "t.db"));
  EXPECT_EQ(database.migration().from, 0);
  EXPECT_TRUE(database.migration().backup.empty());
  EXPECT_TRUE(database.check().empty());
}

TEST_F(DatabaseFile, KeepsWhatWasStored) {
  {
    Database database(folder_ / "t.db");
    store_attempt(database, sample_start(), sample_result());
  }
  Database database(folder_ / "t.db", OpenMode::kExisting);
  EXPECT_EQ(AttemptStore(database).list().size(), 1u);
  EXPECT_TRUE(database.check().empty());
}

TEST_F(DatabaseFile, MissingIsAnEnvironmentErrorWhereItMustExist) {
  const auto open = [&] { Database database(folder_ / "none.db", OpenMode::kExisting); };
  EXPECT_NE(message_of<EnvironmentError>(open).find("none.db: there is no database yet"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "none.db"));
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The message where it is to be read, and the file as it was, with nothing beside it.
std::string refused_unread(const fs::path& file, OpenMode mode) {
  const std::string before = bytes_of(file), message = message_of<InputError>([&] { Database(file, mode, 50); });
  EXPECT_TRUE(bytes_of(file) == before) << file;
  for (const char* beside : {"-wal", "-shm", "-journal", ".anchor"})
    EXPECT_FALSE(fs::exists(file.string() + beside)) << beside;
  return message;
}

/// Whether another program would see that this one has the database open: SQLite's shared lock on the file.
bool locked_for_others(const fs::path& file) {
  const pid_t child = fork();
  if (child == 0) {
    const int opened = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
    struct flock shared = {};
    shared.l_type = F_WRLCK;
    shared.l_whence = SEEK_SET;
    shared.l_start = 0x40000002;
    shared.l_len = 510;
    const bool held = opened >= 0 && fcntl(opened, F_GETLK, &shared) == 0 && shared.l_type != F_UNLCK;
    _exit(held ? 1 : 0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 1;
}

TEST_F(DatabaseFile, ASecondConnectionOfTheProgramLeavesTheFirstItsLock) {
  const fs::path file = folder_ / "t.db";
  Database first(file);
  TraineeStore(first).ensure_trainee("T-1");
  ASSERT_TRUE(locked_for_others(file));
  Database second(file, OpenMode::kExisting);
  EXPECT_TRUE(locked_for_others(file)) << "else the next program takes itself for the only one and removes the log";
  { Database third(file, OpenMode::kExisting); }
  EXPECT_TRUE(locked_for_others(file));
}

TEST_F(DatabaseFile, AnEmptyFileIsNotMadeIntoOneByReading) {
  std::ofstream(folder_ / "empty.db").flush();
  EXPECT_NE(refused_unread(folder_ / "empty.db", OpenMode::kExisting).find("empty.db: is empty, no database"),
            std::string::npos);
  { Database database(folder_ / "empty.db", OpenMode::kCreate); }
  EXPECT_TRUE(Database(folder_ / "empty.db", OpenMode::kExisting).check().empty()) << "what makes databases may use it";
}

TEST_F(DatabaseFile, ADatabaseWithoutTablesIsNotMadeIntoOneByReading) {
  ASSERT_EQ(run_outside(folder_ / "bare.db", "CREATE TABLE t (x); DROP TABLE t"), "");
  EXPECT_NE(refused_unread(folder_ / "bare.db", OpenMode::kExisting).find("bare.db: holds no tables"),
            std::string::npos);
}

TEST_F(DatabaseFile, WhatIsNoDatabaseIsLeftAsItIs) {
  for (const std::string& content :
       {std::string("x"), std::string("not a database\n"), std::string(100, '\0'), std::string(5000, 'z')}) {
    std::ofstream(folder_ / "text.db") << content;
    for (const OpenMode mode : {OpenMode::kExisting, OpenMode::kCreate}) {
      EXPECT_NE(refused_unread(folder_ / "text.db", mode).find("text.db: is not a database"), std::string::npos)
          << content.size();
    }
  }
}

int rights_of(const fs::path& path) { return static_cast<int>(fs::status(path).permissions() & fs::perms(0777)); }

TEST_F(DatabaseFile, BackupsAndNewFoldersAreForTheirOwnerAloneWhateverTheUmask) {
  for (const mode_t mask : {mode_t{0}, mode_t{022}, mode_t{0777}}) {
    const fs::path place = folder_ / ("umask" + std::to_string(mask));
    const mode_t before = umask(0);
    fs::create_directories(place);
    umask(mask);
    { Database(place / "deep" / "t.db").backup(place / "copies" / "of" / "t.backup"); }
    umask(before);
    for (const char* folder : {"deep", "copies", "copies/of"})
      EXPECT_EQ(rights_of(place / folder), 0700) << folder << " under " << mask;
    for (const char* file : {"copies/of/t.backup", "copies/of/t.backup.anchor"})
      EXPECT_EQ(rights_of(place / file), 0600) << file;
  }
}

TEST_F(DatabaseFile, ABackupOfWhatAllMayReadIsNarrower) {
  Database database(folder_ / "t.db");
  fs::permissions(folder_ / "t.db", fs::perms(0666));
  database.backup(folder_ / "t.backup");
  EXPECT_EQ(rights_of(folder_ / "t.backup"), 0600);
  EXPECT_EQ(rights_of(folder_), 0755) << "a folder that was there stays as it was";
}

TEST_F(DatabaseFile, AFolderThatCannotBeMadeOrOpenedIsAnEnvironmentError) {
  std::ofstream(folder_ / "plain") << "x";
  EXPECT_NE(message_of<EnvironmentError>([&] { Database(folder_ / "plain" / "sub" / "t.db"); }).find("t.db"),
            std::string::npos);
  EXPECT_THROW(Database{folder_}, EnvironmentError);
  EXPECT_THROW(Database{"/proc/trocar/t.db"}, EnvironmentError);
}

TEST_F(DatabaseFile, WhatIsNoDatabaseIsAnInputError) {
  std::ofstream(folder_ / "text.db") << std::string(5000, 'z');
  const std::string message = message_of<InputError>([&] { Database(folder_ / "text.db"); });
  EXPECT_NE(message.find("text.db: is not a database"), std::string::npos) << message;
}

TEST_F(DatabaseFile, AnotherProgramsDatabaseIsLeftAlone) {
  ASSERT_EQ(run_outside(folder_ / "other.db", "CREATE TABLE song (title TEXT)"), "");
  const std::string message = message_of<InputError>([&] { Database(folder_ / "other.db"); });
  EXPECT_NE(message.find("other.db: is a database of another program"), std::string::npos) << message;
  EXPECT_EQ(run_outside(folder_ / "other.db", "INSERT INTO song VALUES ('x')"), "");
}

TEST_F(DatabaseFile, ANewerSchemaIsRefusedAndNotTouched) {
  { Database database(folder_ / "t.db"); }
  ASSERT_EQ(run_outside(folder_ / "t.db", "PRAGMA user_version = 99"), "");
  const std::string message = message_of<EnvironmentError>([&] { Database(folder_ / "t.db"); });
  EXPECT_NE(message.find("newer trocar (schema 99, this program knows up to "), std::string::npos) << message;
}

TEST_F(DatabaseFile, DamagedPagesAreFound) {
  {
    Database database(folder_ / "t.db");
    for (int i = 0; i < 200; ++i) TraineeStore(database).ensure_trainee("T" + std::to_string(i));
  }
  std::fstream file(folder_ / "t.db", std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(4096);
  file << std::string(20000, '\x7f');
  file.close();
  std::string found = message_of<InputError>([&] {
    const Database database(folder_ / "t.db");
    if (!database.check().empty()) throw InputError("check: " + database.check().front());
  });
  EXPECT_NE(found, "");
}

TEST_F(DatabaseFile, WaitsForAWriterButNotForEver) {
  Database holder(folder_ / "t.db");
  sqlite3_exec(holder.connection(), "BEGIN IMMEDIATE", nullptr, nullptr, nullptr);
  Database second(folder_ / "t.db", OpenMode::kExisting, 50);
  const std::string message = message_of<EnvironmentError>([&] { TraineeStore(second).ensure_trainee("T-late"); });
  EXPECT_NE(message.find("t.db"), std::string::npos) << message;
  EXPECT_NE(message.find("another program"), std::string::npos) << message;
  sqlite3_exec(holder.connection(), "COMMIT", nullptr, nullptr, nullptr);
  EXPECT_EQ(TraineeStore(second).ensure_trainee("T-late").code, "T-late");
}

TEST_F(DatabaseFile, ALongReaderHoldsUpNobody) {
  Database database(folder_ / "t.db");
  store_attempt(database, sample_start(), sample_result());
  Database reader(folder_ / "t.db", OpenMode::kExisting, 50);
  sqlite3_exec(reader.connection(), "BEGIN; SELECT count(*) FROM attempt", nullptr, nullptr, nullptr);
  Database writer(folder_ / "t.db", OpenMode::kExisting, 50);
  for (int i = 0; i < 20; ++i) store_attempt(writer, sample_start(), sample_result());
  EXPECT_EQ(AttemptStore(reader).list().size(), 1u) << "the reader sees what was there when it began";
  sqlite3_exec(reader.connection(), "COMMIT", nullptr, nullptr, nullptr);
  EXPECT_EQ(AttemptStore(reader).list().size(), 21u);
  EXPECT_TRUE(reader.check().empty());
}

/// Runs the action in a child that may not write what it does not own. @returns the child's verdict.
bool as_nobody(const std::function<bool()>& action) {
  const pid_t child = fork();
  if (child == 0) _exit((getuid() != 0 || setuid(65534) == 0) && action() ? 0 : 1);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST_F(DatabaseFile, AReadOnlyFileOrFolderIsAnEnvironmentErrorAndNothingIsTouched) {
  fs::create_directories(folder_ / "shut");
  { Database database(folder_ / "shut" / "t.db"); }
  const auto refused = [&] {
    return message_of<EnvironmentError>([&] { Database(folder_ / "shut" / "t.db"); }).find("t.db") != std::string::npos;
  };
  fs::permissions(folder_ / "shut" / "t.db", fs::perms(0444));
  EXPECT_TRUE(as_nobody(refused)) << "the file";
  fs::permissions(folder_ / "shut" / "t.db", fs::perms(0666));
  fs::permissions(folder_ / "shut", fs::perms(0555));
  EXPECT_TRUE(as_nobody(refused)) << "the folder: no room for the log beside it";
  fs::permissions(folder_ / "shut", fs::perms(0755));
  EXPECT_TRUE(Database(folder_ / "shut" / "t.db").check().empty());
}

TEST_F(DatabaseFile, AFullDiskIsAnEnvironmentErrorAndCostsNothingStored) {
  Database database(folder_ / "t.db");
  store_attempt(database, sample_start(), sample_result());
  sqlite3_exec(database.connection(), "PRAGMA max_page_count = 1", nullptr, nullptr, nullptr);
  AttemptStart big = sample_start();
  big.exercise_text = std::string(100000, '#');
  const std::string message = message_of<EnvironmentError>([&] { AttemptStore(database).begin_attempt(big); });
  EXPECT_NE(message.find("full"), std::string::npos) << message;
  EXPECT_EQ(AttemptStore(database).list().size(), 1u);
  EXPECT_TRUE(database.check().empty());
}

TEST_F(DatabaseFile, ManyProgramsMayMakeItAtOnce) {
  constexpr int kPrograms = 6;
  for (int program = 0; program < kPrograms; ++program) {
    if (fork() == 0) {
      try {
        Database database(folder_ / "t.db");
        store_attempt(database, sample_start("T" + std::to_string(program)), sample_result());
        _exit(0);
      } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        _exit(1);
      }
    }
  }
  for (int program = 0; program < kPrograms; ++program) {
    int status = 0;
    wait(&status);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
  Database database(folder_ / "t.db");
  EXPECT_EQ(AttemptStore(database).list().size(), 6u);
  EXPECT_TRUE(database.check().empty());
}

TEST_F(DatabaseFile, BackupIsAWholeCopyAndNeverOverwrites) {
  Database database(folder_ / "t.db");
  store_attempt(database, sample_start(), sample_result());
  database.backup(folder_ / "copies" / "t.backup");
  EXPECT_NE(message_of<InputError>([&] { database.backup(folder_ / "copies" / "t.backup"); }).find("exists already"),
            std::string::npos);
  Database copy(folder_ / "copies" / "t.backup", OpenMode::kExisting);
  EXPECT_TRUE(copy.check().empty());
  EXPECT_EQ(AttemptStore(copy).list().size(), 1u);
  std::ofstream(folder_ / "plain") << "x";
  EXPECT_THROW(database.backup(folder_ / "plain" / "t.backup"), EnvironmentError);
}

TEST(DatabaseInMemory, NeedsNoFileAndRecordsNothing) {
  Database database(":memory:");
  const AttemptId id = store_attempt(database, sample_start(), sample_result());
  EXPECT_TRUE(id.recording.empty());
  EXPECT_TRUE(database.check().empty());
}

TEST(DatabasePath, FollowsTheDesktopConvention) {
  const std::string home = std::getenv("HOME") == nullptr ? "" : std::getenv("HOME");
  setenv("XDG_DATA_HOME", "/data", 1);
  EXPECT_EQ(default_database_path(), "/data/trocar/trocar.db");
  setenv("XDG_DATA_HOME", "relative", 1);
  setenv("HOME", "/home/x", 1);
  EXPECT_EQ(default_database_path(), "/home/x/.local/share/trocar/trocar.db");
  unsetenv("XDG_DATA_HOME");
  unsetenv("HOME");
  EXPECT_THROW(default_database_path(), EnvironmentError);
  if (!home.empty()) setenv("HOME", home.c_str(), 1);
}

}  // namespace
}  // namespace trocar::database_test
