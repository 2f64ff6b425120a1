// The store seen from outside: many programs on one database, :memory:, backups, cohorts.
#include "tests/system/system_fixture.h"

namespace trocar::test::store_test {
namespace {

namespace fs = std::filesystem;

using Store = SystemTest;

TEST_F(Store, TwoRunsAtOnceBothEndInTheDatabase) {
  exercise_of(3, 12);
  dip();
  const auto words = [](const char* trainee, const char* recording) {
    return Translator{"run",  "short.toml", "--hand", "dip.toml", "--json", "--db",
                      "t.db", "--trainee",  trainee,  "--record", recording};
  };
  RunningProgram first(launch(words("T-1", "1.trec"))), second(launch(words("T-2", "2.trec"))),
      third(launch(words("T-1", "3.trec")));
  Json results[3];
  int index = 0;
  for (RunningProgram* program : {&first, &second, &third}) {
    const Outcome outcome = program->wait();
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_EQ(outcome.err.find("cut off"), std::string::npos)
        << "a running attempt was taken for a dead one: " << outcome.err;
    results[index++] = Json::parse(outcome.out);
  }
  EXPECT_EQ(results[0]["state_hash"], results[1]["state_hash"]) << "nothing of one run reaches another";
  const Json check = json_of({"db", "check", "--db", "t.db", "--json"}, 0);
  EXPECT_EQ(check["problems"].size(), 0u) << check;
  EXPECT_EQ(json_of({"cohort", "--db", "t.db", "--json"}, 0).size(), 2u);
  EXPECT_EQ(json_of({"trainee", "show", "T-1", "--db", "t.db", "--json"}, 0)["history"].size(), 2u);
  EXPECT_EQ(json_of({"trainee", "show", "T-2", "--db", "t.db", "--json"}, 0)["history"].size(), 1u);
}

TEST_F(Store, AReaderDoesNotDisturbARunningAttempt) {
  RunningProgram run(launch({"run", exercise_of(40, 12), "--hand", "idle", "--db", "t.db", "--json"}));
  while (run.running() && !fs::exists(folder_ / "t.recordings")) {
  }
  while (run.running()) {
    const Outcome check = trocar({"db", "check", "--db", "t.db"});
    ASSERT_EQ(check.err.find("cut off"), std::string::npos) << check.err;
  }
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out)["status"], "timeout");
}

TEST_F(Store, MemoryKeepsNothing) {
  EXPECT_EQ(trocar(short_run({"--db", ":memory:"})).exit_code, 1);
  for (const auto& entry : fs::directory_iterator(folder_.path())) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(name == "short.toml" || name == "dip.toml" || name == ".streams") << name;
  }
}

TEST_F(Store, TraineesAreMadeByTheirFirstAttemptAndListed) {
  EXPECT_EQ(trocar(short_run({"--db", "t.db", "--trainee", "T-new"})).exit_code, 1);
  EXPECT_NE(trocar({"trainee", "list", "--db", "t.db"}).out.find("T-new"), std::string::npos);
  expect_refusal({"trainee", "show", "T-other", "--db", "t.db"}, 2, "no trainee \"T-other\"");
  expect_refusal(short_run({"--db", "t.db", "--trainee", "no spaces please"}), 2, "no spaces please");
  expect_refusal({"score", "ffffffff", "--db", "t.db"}, 2, "ffffffff");
}

TEST_F(Store, CohortAndTraineeSayWhatTheRulesFind) {
  EXPECT_EQ(trocar(short_run({"--db", "t.db", "--trainee", "T-1"})).exit_code, 1);
  const Json rows = json_of({"cohort", "--db", "t.db", "--json"}, 0);
  ASSERT_EQ(rows[0]["curves"].size(), 1u);
  const Json judgement = rows[0]["curves"][0]["judgements"][0];
  EXPECT_EQ(judgement["flag"], "learning");
  EXPECT_EQ(judgement["rules"], "1");
  EXPECT_EQ(judgement["n"], 1);
  EXPECT_EQ(json_of({"trainee", "show", "T-1", "--db", "t.db", "--json"}, 0)["curves"][0], rows[0]["curves"][0]);
  EXPECT_NE(trocar({"trainee", "show", "T-1", "--db", "t.db"}).out.find(judgement["evidence"].get<std::string>()),
            std::string::npos);
  EXPECT_NE(trocar({"cohort", "--db", "t.db"}).out.find("flags"), std::string::npos);
}

TEST_F(Store, ABackupIsADatabaseOfItsOwn) {
  const Json run = json_of(short_run({"--db", "t.db", "--trainee", "T-1"}), 1);
  const Outcome made = trocar({"db", "backup", "--db", "t.db", "--out", "b.db"});
  EXPECT_EQ(made.exit_code, 0);
  EXPECT_NE(made.err.find("b.recordings: 1 recordings, "), std::string::npos) << made.err;
  std::filesystem::remove_all(folder_ / "t.recordings");
  EXPECT_EQ(json_of({"trainee", "show", "T-1", "--db", "b.db", "--json"}, 0)["history"][0]["uuid"],
            run["attempt"]["uuid"]);
  EXPECT_EQ(trocar({"db", "check", "--db", "b.db"}).exit_code, 0);
  EXPECT_NE(trocar({"db", "migrate", "--db", "b.db"}).out.find("up to date"), std::string::npos);
}

TEST_F(Store, WhatStoodOpenToOthersIsClosedAndSaidOnce) {
  namespace fs = std::filesystem;
  EXPECT_EQ(trocar(short_run({"--db", "t.db", "--trainee", "T-1"})).exit_code, 1);
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "t.recordings"))
    EXPECT_EQ(entry.status().permissions(), fs::perms(0600));
  EXPECT_EQ(fs::status(folder_ / "t.recordings").permissions(), fs::perms(0700));
  fs::permissions(folder_ / "t.db", fs::perms(0644));
  fs::permissions(folder_ / "t.recordings", fs::perms(0755));
  const std::string words = "t.db: 2 of its files and folders could be opened by other users";
  EXPECT_NE(trocar({"trainee", "list", "--db", "t.db"}).err.find(words), std::string::npos);
  EXPECT_EQ(fs::status(folder_ / "t.db").permissions(), fs::perms(0600));
  EXPECT_EQ(trocar({"trainee", "list", "--db", "t.db"}).err, "");
}

TEST_F(Store, ATamperedDatabaseIsFound) {
  EXPECT_EQ(trocar(short_run({"--db", "t.db", "--trainee", "T-1"})).exit_code, 1);
  std::string bytes = file_bytes(folder_ / "t.db");
  const std::size_t at = bytes.find("below pass");
  ASSERT_NE(at, std::string::npos);
  folder_.write("t.db", bytes.replace(at, 10, "proficient"));
  const Outcome check = trocar({"db", "check", "--db", "t.db"});
  EXPECT_EQ(check.exit_code, 2) << check.out << check.err;
  EXPECT_NE(check.out, "");
}

}  // namespace
}  // namespace trocar::test::store_test
