// Several programs store attempts at once, some are killed in the middle: every commit that was reported is there.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "tests/trainees/records/store_samples.h"

namespace trocar::attempt_concurrency_test {
namespace {

using AttemptConcurrency = TemporaryFolder;

TEST_F(AttemptConcurrency, ProgramsInterleaveAndTheChainStaysWhole) {
  constexpr int kPrograms = 3, kAttempts = 15;
  { Database made(folder_ / "t.db"); }
  for (int program = 0; program < kPrograms; ++program) {
    if (fork() == 0) {
      Database database(folder_ / "t.db");
      for (int i = 0; i < kAttempts; ++i) {
        store_attempt(database, sample_start("T" + std::to_string(program)), sample_result(50 + i));
      }
      _exit(0);
    }
  }
  for (int program = 0; program < kPrograms; ++program) {
    int status = 0;
    wait(&status);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
  Database database(folder_ / "t.db");
  EXPECT_EQ(AttemptStore(database).list().size(), static_cast<std::size_t>(kPrograms * kAttempts));
  const auto problems = database.check();
  EXPECT_TRUE(problems.empty()) << problems.front();
}

TEST_F(AttemptConcurrency, NothingThatWasReportedAsCommittedIsLostByKillMinusNine) {
  for (int round = 0; round < 5; ++round) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
      Database database(folder_ / "t.db");
      for (;;) {
        store_attempt(database, sample_start(), sample_result());
        if (write(ends[1], "x", 1) != 1) _exit(1);
      }
    }
    close(ends[1]);
    std::size_t reported = 0;
    char byte = 0;
    while (reported < 10 && read(ends[0], &byte, 1) == 1) ++reported;
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    while (read(ends[0], &byte, 1) == 1) ++reported;
    close(ends[0]);
    Database database(folder_ / "t.db");
    std::size_t completed = 0, running = 0;
    for (const AttemptSummary& attempt : AttemptStore(database).list()) {
      completed += attempt.status == "completed";
      running += attempt.status == "running";
    }
    static std::size_t before = 0;
    EXPECT_GE(completed - before, reported);
    EXPECT_LE(completed - before, reported + 1);  // committed, killed before it could say so
    EXPECT_EQ(running, 0u);
    before = completed;
    EXPECT_TRUE(database.check().empty());
  }
}

}  // namespace
}  // namespace trocar::attempt_concurrency_test
