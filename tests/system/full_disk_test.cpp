// A disk that fills up at any point of an attempt: clear message, exit code 3, nothing stored is lost, and of an
// attempt that was over the recording gives the same score to a person who decides on it. The limit on file size stands
// for the disk.
#include <sys/resource.h>

#include <csignal>
#include <set>

#include "tests/system/system_fixture.h"

namespace trocar::test::full_disk_test {
namespace {

namespace fs = std::filesystem;

class FullDisk : public SystemTest {
 protected:
  void SetUp() override {
    std::signal(SIGXFSZ, SIG_IGN);  // inherited by the program: a write fails as on a full disk, instead of a signal
    getrlimit(RLIMIT_FSIZE, &before_);
  }
  void TearDown() override { std::signal(SIGXFSZ, SIG_DFL); }

  Outcome with_room(rlim_t bytes, const Translator& words) const {
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    RunningProgram program(launch(words));
    setrlimit(RLIMIT_FSIZE, &before_);
    return program.wait();
  }
  rlimit before_{};
};

TEST_F(FullDisk, WhereverItFillsUpAFinishedAttemptIsNotLost) {
  const Json wanted = json_of(short_run({"--db", ":memory:"}), 1);
  EXPECT_EQ(trocar({"trainee", "add", "guest", "--db", "t.db"}).exit_code, 0);
  std::set<std::string> seen;
  std::size_t stored = 0;
  for (rlim_t room = 4000; room < 220000 && seen.count("stored") == 0; room += 4000) {
    const Outcome run = with_room(room, short_run({"--db", "t.db"}));
    const Outcome check = trocar({"db", "check", "--quick", "--db", "t.db"});  // there is room again
    EXPECT_EQ(check.exit_code, 0) << room << ": " << check.out << check.err;
    const Json history = json_of({"trainee", "show", "guest", "--db", "t.db", "--limit", "0", "--json"}, 0)["history"];
    ASSERT_GE(history.size(), stored);
    if (run.exit_code == 1) {
      seen.insert("stored");
      continue;
    }
    EXPECT_EQ(run.exit_code, 3) << room << ": " << run.err;
    EXPECT_NE(run.err.find("trocar: "), std::string::npos) << room << ": " << run.err;
    if (history.size() == stored) {
      seen.insert("never begun");
      continue;
    }
    stored = history.size();
    const Json& attempt = history[0];
    if (run.err.find("holds the result") != std::string::npos) {
      seen.insert("kept in its recording");
      EXPECT_EQ(attempt["status"], "aborted") << room << ": no program has seen it stored";
      EXPECT_TRUE(attempt["score"].is_null()) << room;
      EXPECT_NE(check.err.find("was cut off and is now marked as aborted"), std::string::npos) << check.err;
      const Outcome again = trocar({"score", "latest", "--db", "t.db", "--json"});
      EXPECT_EQ(Json::parse(again.out)["score"], wanted["score"]) << "for a person who decides";
      EXPECT_NE(again.err.find("until a person decides"), std::string::npos) << again.err;
    } else {
      seen.insert("aborted");
      EXPECT_EQ(attempt["status"], "aborted") << room << ": " << run.err;
      EXPECT_TRUE(attempt["integrity"].is_string()) << attempt;
    }
  }
  for (const char* end : {"never begun", "kept in its recording", "stored"}) EXPECT_TRUE(seen.contains(end)) << end;
}

TEST_F(FullDisk, ARecordingThatCannotBeWrittenAbortsTheAttemptWithTheReason) {
  EXPECT_EQ(trocar({"trainee", "add", "guest", "--db", "t.db"}).exit_code, 0);
  const Translator words = short_run({"--db", "t.db", "--record", "/dev/full"});
  const Outcome run = trocar(words);
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_NE(run.err.find("/dev/full: the recording cannot be written: No space left on device"), std::string::npos)
      << run.err;
  const Json shown = json_of({"trainee", "show", "guest", "--db", "t.db", "--json"}, 0);
  EXPECT_EQ(shown["history"][0]["status"], "aborted");
  EXPECT_NE(shown["history"][0]["integrity"].get<std::string>().find("No space left"), std::string::npos);
}

TEST_F(FullDisk, WithoutRoomForADatabaseNothingIsStarted) {
  const Outcome run = with_room(1000, short_run({"--db", "new.db"}));
  EXPECT_EQ(run.exit_code, 3) << run.err;
  EXPECT_NE(run.err.find("new.db"), std::string::npos) << run.err;
  EXPECT_EQ(trocar(short_run({"--db", "new.db"})).exit_code, 1) << "with room it works, whatever was left behind";
}

TEST_F(FullDisk, AnExportThatDoesNotFitLeavesNothing) {
  for (const Translator& words :
       {Translator{"organ", "export", "phantom-abdomen", "-o", "a.glb"},
        Translator{"organ", "export", "phantom-abdomen", "-o", "organs"},
        Translator{"organ", "export", "phantom-gallbladder", "-o", "g.msh", "--tetrahedra", "6"}}) {
    const Outcome run = with_room(20000, words);
    EXPECT_EQ(run.exit_code, 3) << run.err;
    EXPECT_NE(run.err.find("cannot be written: File too large"), std::string::npos) << run.err;
    EXPECT_EQ(run.out, "");
  }
  for (const char* name : {"a.glb", "a.glb.part", "organs", "g.msh", "g.msh.part"})
    EXPECT_FALSE(fs::exists(folder_ / name)) << name;
}

}  // namespace
}  // namespace trocar::test::full_disk_test
