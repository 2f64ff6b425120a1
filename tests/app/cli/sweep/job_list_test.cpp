// A sweep as shell commands: each word survives a shell, each part is named once.
#include "app/cli/sweep/job_list.h"

#include <gtest/gtest.h>

namespace trocar::job_list_test {
namespace {

SweepOptions eight_jobs() {
  SweepOptions options;
  options.plan.exercises = {"E01"};
  options.plan.hands = {"expert", "population#1..20"};
  options.plan.levels = {"L2"};
  options.plan.boards = "0..4";
  options.out = "/tmp/a sweep's";
  options.list_jobs = 8;
  return options;
}

TEST(JobList, WordsAsAShellTakesThem) {
  EXPECT_EQ(shell_word("E01"), "E01");
  EXPECT_EQ(shell_word("a b"), "'a b'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word("population#1..20"), "'population#1..20'") << "no comment begins within a word, but be sure";
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("$(reboot)"), "'$(reboot)'");
}

TEST(JobList, OneCommandALine) {
  const std::string words =
      "/usr/bin/trocar sweep E01 --hand 'expert,population#1..20' --level L2 --seeds 1..10 --boards 0..4 --arm drawn "
      "--organ phantom-liver --out '/tmp/a sweep'\\''s' --jobs 1 --part ";
  std::string all;
  for (int part = 1; part <= 8; ++part) all += words + std::to_string(part) + "/8\n";
  EXPECT_EQ(job_lines(eight_jobs(), "/usr/bin/trocar"), all);
}

TEST(JobList, TheArrayHasATaskForEachPart) {
  const std::string script = slurm_script(eight_jobs(), "/usr/bin/trocar");
  EXPECT_EQ(script.find("#!/bin/sh\n"), 0u);
  EXPECT_NE(script.find("\n#SBATCH --array=1-8\n"), std::string::npos);
  EXPECT_NE(script.find("\nexec /usr/bin/trocar sweep E01 "), std::string::npos);
  EXPECT_NE(script.find(" --part \"$SLURM_ARRAY_TASK_ID/8\"\n"), std::string::npos);
  EXPECT_NE(script.find("# Then: /usr/bin/trocar sweep merge '/tmp/a sweep'\\''s'\n"), std::string::npos);
}

}  // namespace
}  // namespace trocar::job_list_test
