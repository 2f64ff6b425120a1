// What kill -9 in the middle of an attempt leaves: an aborted attempt and a recording readable to its last whole chunk.
#include <chrono>
#include <thread>

#include "tests/system/system_fixture.h"

namespace trocar::test::crash_test {
namespace {

namespace fs = std::filesystem;

class Crash : public SystemTest {
 protected:
  /// Starts a long attempt and kills it as soon as its recording holds some chunks. @return the recording.
  fs::path kill_during_attempt() const {
    const fs::path recording = folder_ / "cut.trec";
    Translator words{"run", exercise_of(3600, 12), "--hand", "idle", "--db", "t.db", "--record", "cut.trec"};
    RunningProgram program(launch(words));
    std::error_code missing;
    while (program.running() && (!fs::exists(recording) || fs::file_size(recording, missing) < kEnough)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_TRUE(program.running()) << "it ended before it could be killed";
    program.kill_at_once();
    EXPECT_EQ(program.wait().signal, SIGKILL);
    return recording;
  }

  static constexpr std::uintmax_t kEnough = 24000;  // bytes: the header and some seconds of ticks
};

TEST_F(Crash, TheAttemptIsAbortedWhenTheDatabaseIsNextOpened) {
  kill_during_attempt();
  const Outcome check = trocar({"db", "check", "--db", "t.db"});
  EXPECT_EQ(check.exit_code, 0) << check.out;
  EXPECT_NE(check.out.find(": sound"), std::string::npos) << check.out;
  EXPECT_NE(check.err.find("was cut off and is now marked as aborted"), std::string::npos) << check.err;
  EXPECT_NE(check.err.find("cut.trec"), std::string::npos) << check.err;
  const Json stored = json_of({"trainee", "show", "guest", "--db", "t.db", "--json"}, 0);
  ASSERT_EQ(stored["history"].size(), 1u);
  EXPECT_EQ(stored["history"][0]["status"], "aborted");
  EXPECT_TRUE(stored["history"][0]["score"].is_null());
  EXPECT_EQ(trocar({"db", "check", "--db", "t.db"}).err, "") << "said once";
}

TEST_F(Crash, TheRecordingReadsToItsLastWholeChunk) {
  kill_during_attempt();
  const Outcome scored = trocar({"score", "cut.trec", "--json"});
  EXPECT_EQ(scored.exit_code, 1) << scored.err;
  EXPECT_NE(scored.err.find("cut.trec"), std::string::npos) << "says that the recording is torn: " << scored.err;
  const Json json = Json::parse(scored.out);
  EXPECT_EQ(json["status"], "aborted");
  EXPECT_TRUE(json["score"].is_null());
  const Outcome replayed = trocar({"replay", "cut.trec"});
  EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
  EXPECT_GT(std::stol(replayed.out.substr(replayed.out.find_first_of("0123456789"))), 1000) << replayed.out;
  const Outcome verified = trocar({"replay", "cut.trec", "--verify"});
  EXPECT_EQ(verified.exit_code, 2);
  EXPECT_NE(verified.err.find("has no end, so there is no hash to verify"), std::string::npos) << verified.err;
}

TEST_F(Crash, ACutInTheMiddleOfAChunkCostsOnlyThatChunk) {
  const fs::path recording = kill_during_attempt();
  const auto ticks = [&] {
    const Outcome replayed = trocar({"replay", "cut.trec"});
    EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
    return std::stol(replayed.out.substr(replayed.out.find_first_of("0123456789")));
  };
  const long before = ticks();
  const std::string bytes = file_bytes(recording);
  folder_.write("cut.trec", bytes.substr(0, bytes.size() * 3 / 4));
  const long after = ticks();
  EXPECT_LT(after, before);
  EXPECT_GE(after, before / 2) << "the head of the file, with the exercise in it, is a part of the quarter";
}

TEST_F(Crash, WhatWasStoredBeforeIsUntouchedAndTheNextAttemptRuns) {
  const Json first = json_of(short_run({"--db", "t.db"}), 1);
  kill_during_attempt();
  const Json next = json_of(short_run({"--db", "t.db"}), 1);
  EXPECT_EQ(first["state_hash"], next["state_hash"]);
  const Json stored = json_of({"trainee", "show", "guest", "--db", "t.db", "--json"}, 0);
  ASSERT_EQ(stored["history"].size(), 3u);
  EXPECT_EQ(stored["history"][0]["status"], "timeout");
  EXPECT_EQ(stored["history"][1]["status"], "aborted");
  EXPECT_EQ(stored["history"][2]["status"], "timeout");
  EXPECT_EQ(trocar({"db", "check", "--db", "t.db"}).exit_code, 0);
}

}  // namespace
}  // namespace trocar::test::crash_test
