// A sweep that is kept: killed and gone on with, parted by GNU parallel and by an array of Slurm's, merged, reported.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "tests/system/system_fixture.h"

namespace trocar::test::sweep_folder_test {
namespace {

class KeptSweep : public SystemTest {
 protected:
  /// Twelve attempts of three seconds.
  Translator sweep_into(const std::string& folder, const Translator& more = {}) {
    Translator words{"sweep", exercise_of(3, 12), "--hand", "idle," + dip(), "--level",
                     "L1",    "--seeds",          "1..6",   "--out",         folder};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  /// All rows of a folder, sorted.
  std::string merged(const std::string& folder) const {
    const Outcome merge = trocar({"sweep", "merge", folder});
    EXPECT_EQ(merge.exit_code, 0) << merge.err;
    return file_bytes(folder_ / folder / "attempts.jsonl");
  }
  Outcome shell(const std::string& command) const {
    Launch launched = launch({"-c", command});
    launched.program = "/bin/sh";
    return run_program(launched);
  }
  std::size_t kept_lines(const std::string& folder) const {
    const std::string rows = file_bytes(folder_ / folder / "attempts.jsonl");
    return static_cast<std::size_t>(std::count(rows.begin(), rows.end(), '\n'));
  }
  void wait_for_lines(RunningProgram& program, const std::string& folder, std::size_t lines) const {
    while (program.running() && kept_lines(folder) < lines) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
};

TEST_F(KeptSweep, KilledAtAnyMomentItGoesOnToTheSameBytes) {
  ASSERT_EQ(trocar(sweep_into("whole", {"--jobs", "1"})).exit_code, 0);
  const std::string whole = merged("whole");
  ASSERT_EQ(std::count(whole.begin(), whole.end(), '\n'), 12);
  int killed = 0;
  for (const std::size_t lines : {1u, 4u, 9u}) {
    RunningProgram program(launch(sweep_into("cut", {"--jobs", "2"})));
    wait_for_lines(program, "cut", lines);
    program.kill_at_once();
    killed += program.wait().signal == SIGKILL ? 1 : 0;
    EXPECT_GE(kept_lines("cut"), lines);
  }
  EXPECT_GE(killed, 2) << "it must have been killed, not have ended by itself";
  const std::size_t before = kept_lines("cut");
  const Outcome rest = trocar(sweep_into("cut"));
  EXPECT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_NE(
      rest.err.find("12 attempts on the simulated plant, " + std::to_string(before) + " of them are in cut already"),
      std::string::npos)
      << rest.err;
  EXPECT_TRUE(merged("cut") == whole);
  const Outcome again = trocar(sweep_into("cut"));
  EXPECT_NE(again.err.find("12 of them are in cut already"), std::string::npos) << again.err;
  EXPECT_EQ(again.out, rest.out) << "from the rows alone";
}

TEST_F(KeptSweep, ATornLineIsMadeAgain) {
  ASSERT_EQ(trocar(sweep_into("torn")).exit_code, 0);
  const std::string whole = merged("torn");
  std::filesystem::resize_file(folder_ / "torn" / "attempts.jsonl", whole.size() - 20);
  const Outcome again = trocar(sweep_into("torn"));
  EXPECT_NE(again.err.find("the last line was cut off; it is dropped"), std::string::npos) << again.err;
  EXPECT_TRUE(merged("torn") == whole);
}

TEST_F(KeptSweep, CtrlCKeepsWhatIsOverAndSaysHowToGoOn) {
  RunningProgram program(launch(sweep_into("half", {"--jobs", "1"})));
  wait_for_lines(program, "half", 2);
  program.interrupt();
  const Outcome stopped = program.wait();
  EXPECT_EQ(stopped.exit_code, 3) << stopped.err;
  EXPECT_NE(stopped.err.find("of 12 attempts are in half; the same command makes the others"), std::string::npos)
      << stopped.err;
  EXPECT_EQ(trocar(sweep_into("half")).exit_code, 0);
  EXPECT_EQ(kept_lines("half"), 12u);
}

TEST_F(KeptSweep, JobsOfGnuParallelMakeTheSameRows) {
  const Outcome listed = trocar(sweep_into("parts", {"--list-jobs", "5"}));
  ASSERT_EQ(listed.exit_code, 0) << listed.err;
  EXPECT_EQ(std::count(listed.out.begin(), listed.out.end(), '\n'), 5);
  EXPECT_EQ(file_bytes(folder_ / "parts" / "jobs.txt"), listed.out);
  if (shell("command -v parallel").exit_code != 0) GTEST_SKIP() << "GNU parallel is not installed (package parallel)";
  const Outcome ran = shell("parallel --will-cite --jobs 2 < parts/jobs.txt");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.out.find("part 5 of 5: 2 attempts in "), std::string::npos) << ran.out;
  ASSERT_EQ(trocar(sweep_into("whole")).exit_code, 0);
  EXPECT_TRUE(merged("parts") == merged("whole"));
}

TEST_F(KeptSweep, TasksOfASlurmArrayMakeTheSameRows) {
  // The script as Slurm starts it: by a shell, with the task's number in the environment.
  ASSERT_EQ(trocar(sweep_into("tasks", {"--list-jobs", "3"})).exit_code, 0);
  for (int task = 1; task <= 3; ++task) {
    const Outcome ran = shell("SLURM_ARRAY_TASK_ID=" + std::to_string(task) + " sh tasks/jobs.slurm");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
  }
  ASSERT_EQ(trocar(sweep_into("whole")).exit_code, 0);
  EXPECT_TRUE(merged("tasks") == merged("whole"));
}

TEST_F(KeptSweep, RefusesAnotherRulesetInItsFolder) {
  ASSERT_EQ(trocar(sweep_into("mixed")).exit_code, 0);
  folder_.write("short.toml", replaced(file_bytes(folder_ / "short.toml"), "pass_at = 75", "pass_at = 70"));
  expect_refusal({"sweep", "short.toml", "--hand", "idle", "--level", "L1", "--seeds", "9", "--out", "mixed"}, 2,
                 "this command: ruleset of surface-touch is ");
  folder_.write("dip.toml", replaced(kDip, "hold_s = 0.2", "hold_s = 0.3"));
  exercise_of(3, 12);
  expect_refusal({"sweep", "short.toml", "--hand", "dip.toml", "--level", "L1", "--seeds", "9", "--out", "mixed"}, 2,
                 "script of hand dip is ");
}

TEST_F(KeptSweep, RefusesPartsAndBoardsThatThereAreNot) {
  const auto words = [&](const Translator& more) {
    Translator all{"sweep", exercise_of(3, 12), "--hand", "idle", "--level", "L1", "--seeds", "1"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  for (const char* part : {"0/3", "4/3", "3", "1/", "/3", "1/x", "1/3/5", "1/99999"})
    expect_refusal(words({"--out", "p", "--part", part}), 2, "--part " + std::string(part) + ": K/N");
  expect_refusal(words({"--part", "1/3"}), 2, "--part needs --out");
  expect_refusal(words({"--list-jobs", "3"}), 2, "--list-jobs needs --out");
  for (const char* boards : {"0..20", "-1", "19..1001", "1001000"})
    expect_refusal(words({"--boards=" + std::string(boards)}), 2,
                   "practice boards are 0 to 19, unseen ones begin at 1000");
  expect_refusal(words({"--boards", "3..1"}), 2, "--boards 3..1: A..B");
  expect_refusal({"sweep", "E01", "--hand", "idle", "--level", "exam", "--boards", "1"}, 2, "do not go with an exam");
  expect_refusal({"sweep", "E01", "--hand", "population#9..3"}, 2, "--hand 9..3: A..B");
  expect_refusal({"sweep", "E01", "--hand", "population"}, 2, "name one of it");
  expect_refusal({"sweep", "merge", "nowhere"}, 2, "nowhere");
  expect_refusal({"sweep", "report", "nowhere"}, 2, "nowhere");
}

TEST_F(KeptSweep, AShortSeededSweepTellsHandsAndPersonsApart) {
  // Ordinary boards of practice, so that the whole chain is run on what trainees play.
  const auto add = [&](const std::string& hands, const std::string& seeds) {
    const Outcome ran = trocar(
        {"sweep", "E01", "--level", "L2", "--hand", hands, "--boards", "0..1", "--seeds", seeds, "--out", "short"});
    EXPECT_LE(ran.exit_code, 1) << ran.err;
  };
  add("expert,intermediate,novice", "1..2");
  add("population#1..5", "1..2");
  const Outcome report = trocar({"sweep", "report", "short"});
  EXPECT_LE(report.exit_code, 1) << report.err;
  const Json json = Json::parse(file_bytes(folder_ / "short" / "validity.json"));
  EXPECT_EQ(json["humans_measured"], 0);
  ASSERT_EQ(json["cells"].size(), 1u);
  const Json& cell = json["cells"][0];
  EXPECT_EQ(cell["left_out_by_subscores"]["all"], 12);
  EXPECT_EQ(cell["population"]["components"]["design"], Json({5, 2, 2}));
  EXPECT_GE(cell["population"]["correlation"], 0.7);
  for (const Json& check : cell["checks"]) {
    const std::string name = check["name"];
    const bool ordering = name.starts_with("expert") || name.starts_with("intermediate") || name.starts_with("Cliff");
    EXPECT_TRUE(!ordering || check["met"]) << check;
  }
  for (const Json& scorer : cell["bad_scorers"]) EXPECT_FALSE(scorer["lost"].empty()) << scorer;
  const std::string page = file_bytes(folder_ / "short" / "report.html");
  EXPECT_NE(page.find("No human has been measured."), std::string::npos);
  EXPECT_EQ(page.find("http"), page.find("http-equiv")) << "nothing is fetched";
  EXPECT_EQ(page.find("<script"), std::string::npos);
  const std::string table = file_bytes(folder_ / "short" / "table.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 12 + 20);
  EXPECT_EQ(trocar({"sweep", "report", "short"}).out, report.out);
  EXPECT_TRUE(file_bytes(folder_ / "short" / "report.html") == page) << "same rows, same bytes";
}

}  // namespace
}  // namespace trocar::test::sweep_folder_test
