// The same command gives the same attempt; replay and regrade agree with it; damage and swaps are noticed.
#include "tests/system/system_fixture.h"

namespace trocar::test::repeat_test {
namespace {

namespace fs = std::filesystem;

class Repeat : public SystemTest {
 protected:
  Json recorded_run() const { return json_of(short_run({"--db", "t.db", "--record", "a.trec"}), 1); }
};

/// Two discs and the squeeze by the expert hand: short, complete and graded.
class Graded : public SystemTest {
 protected:
  Translator expert(const Translator& more) const {
    Translator words{"run", exercise_of(60, 2), "--hand", "expert", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

/// What is of the attempt and not of what happened in it: a recording kept with a database says whose it is.
Json without_identity(Json json) {
  json.erase("attempt");
  json.erase("recording_sha256");
  return json;
}

TEST_F(Repeat, TheSameCommandGivesTheSameAttemptToTheByte) {
  Json first = json_of(short_run({"--db", "a.db", "--record", "a.trec"}), 1);
  Json second = json_of(short_run({"--db", "b.db", "--record", "b.trec"}), 1);
  EXPECT_EQ(without_identity(first).dump(), without_identity(second).dump());
  EXPECT_NE(file_bytes(folder_ / "a.trec"), file_bytes(folder_ / "b.trec")) << "each is of its attempt";
  for (const char* file : {"c.trec", "d.trec"}) json_of(short_run({"--db", ":memory:", "--record", file}), 1);
  EXPECT_EQ(file_bytes(folder_ / "c.trec"), file_bytes(folder_ / "d.trec"));
  EXPECT_NE(first["attempt"]["uuid"], second["attempt"]["uuid"]);
}

TEST_F(Repeat, AnotherSeedGivesAnotherAttempt) {
  const Json first = json_of(short_run({"--db", ":memory:", "--seed", "1", "--board", "0"}), 1);
  const Json second = json_of(short_run({"--db", ":memory:", "--seed", "2", "--board", "0"}), 1);
  EXPECT_NE(first["state_hash"], second["state_hash"]);
}

TEST_F(Repeat, TheDatabaseDoesNotReachTheResult) {
  const Json stored = recorded_run(), unattended = json_of(short_run({"--db", ":memory:"}), 1);
  EXPECT_EQ(without_identity(stored).dump(), without_identity(unattended).dump());
  EXPECT_EQ(unattended["attempt"]["recording"], "") << "nothing is kept";
}

TEST_F(Repeat, ReplayOfAnAttemptAndOfItsRecordingVerify) {
  const Json run = recorded_run();
  for (const Translator& words :
       {Translator{"replay", "a.trec", "--verify"}, {"replay", "latest", "--db", "t.db", "--verify"}}) {
    const Outcome outcome = trocar(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    EXPECT_NE(outcome.out.find("verified: every tick"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find(run["state_hash"].get<std::string>()), std::string::npos) << outcome.out;
  }
}

TEST_F(Repeat, AFlippedByteIsFoundByItsChecksum) {
  recorded_run();
  const std::string whole = file_bytes(folder_ / "a.trec");
  const auto damage = [&](std::size_t at) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    folder_.write("a.trec", bytes);
  };
  damage(100);
  expect_refusal({"replay", "a.trec", "--verify"}, 2, "a.trec: its header (byte 12) is damaged");
  damage(whole.size() * 9 / 10);
  expect_refusal({"replay", "a.trec", "--verify"}, 2, "CRC");
  expect_refusal({"score", "a.trec"}, 2, "CRC");
  expect_refusal({"replay", "latest", "--db", "t.db"}, 2, "a.trec");
  const Outcome check = trocar({"db", "check", "--db", "t.db"});
  EXPECT_EQ(check.exit_code, 2);
  EXPECT_NE(check.out.find("a.trec"), std::string::npos) << check.out;
  folder_.write("a.trec", whole);
  EXPECT_EQ(trocar({"db", "check", "--db", "t.db"}).exit_code, 0);
}

TEST_F(Repeat, AnotherRecordingIsNotTakenForTheGradedOne) {
  recorded_run();
  json_of(short_run({"--db", ":memory:", "--seed", "9", "--record", "b.trec"}), 1);
  fs::copy_file(folder_ / "b.trec", folder_ / "a.trec", fs::copy_options::overwrite_existing);
  expect_refusal({"score", "latest", "--db", "t.db"}, 2, "not the one that was graded");
}

TEST_F(Repeat, AnotherOrganIsRefusedAndTheSameOrganElsewhereIsTaken) {
  recorded_run();
  expect_refusal({"replay", "a.trec", "--verify", "--organ", "phantom-gallbladder"}, 2,
                 "not the organ of the recording");
  for (const char* part : {"phantom-liver.organ.toml", "phantom-liver.ply"}) {
    fs::copy_file(fs::path(TROCAR_SOURCE_DIR) / "assets/organs" / part, folder_ / part);
  }
  const Outcome moved = trocar({"replay", "a.trec", "--verify", "--organ", "phantom-liver.organ.toml"});
  EXPECT_EQ(moved.exit_code, 0) << moved.out << moved.err;
}

TEST_F(Graded, ScoreOfAnAttemptEqualsTheStoredOne) {
  const Json run = json_of(expert({"--db", "t.db", "--trainee", "T-7"}), 0);
  EXPECT_EQ(run["status"], "completed");
  EXPECT_TRUE(run["passed"].get<bool>());
  const Outcome again = trocar({"score", "latest", "--db", "t.db", "--json"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.err.find("equal to the stored score"), std::string::npos) << again.err;
  const Json regraded = Json::parse(again.out);
  EXPECT_NEAR(regraded["score"].get<double>(), run["score"].get<double>(), 1e-9);
  EXPECT_EQ(regraded["metrics"].dump(), run["metrics"].dump());
  EXPECT_EQ(regraded["subscores"].dump(), run["subscores"].dump());
  EXPECT_EQ(regraded["events"].dump(), run["events"].dump());
  EXPECT_EQ(regraded["state_hash"], run["state_hash"]);
}

TEST_F(Graded, RegradingWithAnEditedRubricChangesTheGradeNotTheStore) {
  const Json run = json_of(expert({"--db", "t.db", "--record", "a.trec"}), 0);
  const std::string edited = replaced(file_bytes(folder_ / "short.toml"), "pass_at = 75", "pass_at = 84");
  folder_.write("strict.toml", replaced(replaced(edited, "expert_time_s = 37.5", "expert_time_s = 2.0"),
                                        "weight = 0.15", "weight = 0.15"));
  const Outcome strict = trocar({"score", "a.trec", "--rubric", "strict.toml", "--json"});
  const Json regraded = Json::parse(strict.out);
  EXPECT_LT(regraded["score"].get<double>(), run["score"].get<double>() - 5) << "no marks for time any more";
  EXPECT_EQ(strict.exit_code, regraded["passed"].get<bool>() ? 0 : 1);
  EXPECT_NE(regraded["rubric_sha256"], run["rubric_sha256"]);
  EXPECT_EQ(regraded["metrics"]["time_s"], run["metrics"]["time_s"]) << "what happened does not change";
  EXPECT_EQ(trocar({"score", "latest", "--db", "t.db"}).exit_code, 0) << "the stored attempt keeps its own rubric";
  folder_.write("broken.toml", replaced(edited, "pass_at = 84", "pass_at = \"most\""));
  expect_refusal({"score", "a.trec", "--rubric", "broken.toml"}, 2, "broken.toml:");
}

TEST_F(Graded, JsonHoldsEveryKeyThatOthersRelyOn) {
  const Json json = json_of(expert({"--db", ":memory:", "--trainee", "T-9", "--seed", "4"}), 0);
  for (const char* key : {"exercise", "trainee", "hand", "status", "score", "passed", "grade", "subscores", "caps",
                          "events", "metrics", "device", "organ", "rubric_sha256", "recording_sha256", "state_hash"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  for (const char* key : {"id", "version", "level", "seed"}) EXPECT_TRUE(json["exercise"].contains(key)) << key;
  for (const char* key : {"backend", "rate_hz", "ticks", "overruns", "saturated_contact_share",
                          "passivity_active_share", "min_energy_j"}) {
    EXPECT_TRUE(json["device"].contains(key)) << key;
  }
  for (const char* key : {"source", "sha256"}) EXPECT_TRUE(json["organ"].contains(key)) << key;
  ASSERT_FALSE(json["subscores"].empty());
  double weights = 0;
  for (const Json& row : json["subscores"]) {
    for (const char* key : {"name", "value", "weight", "raw", "unit", "full_at", "zero_at", "gate"})
      EXPECT_TRUE(row.contains(key)) << key;
    weights += row["weight"].get<double>();
  }
  EXPECT_NEAR(weights, 1, 1e-12);
  ASSERT_FALSE(json["events"].empty());
  for (const char* key : {"t_s", "type", "severity"}) EXPECT_TRUE(json["events"][0].contains(key)) << key;
  for (const auto& [name, metric] : json["metrics"].items())
    EXPECT_TRUE(metric.contains("value") && metric.contains("unit")) << name;
  EXPECT_EQ(json["exercise"]["seed"], 4);
  EXPECT_EQ(json["trainee"], "T-9");
  EXPECT_EQ(json["hand"], "expert");
  EXPECT_EQ(json["device"]["backend"], "simulated");
  EXPECT_EQ(json["state_hash"].get<std::string>().size(), 16u);
}

TEST_F(Graded, EveryRateRunsAndReplays) {
  for (const std::string rate : {"1000", "2000", "4000"}) {
    const std::string recording = rate + ".trec";
    const Json json = json_of(short_run({"--db", ":memory:", "--rate", rate, "--record", recording}), 1);
    EXPECT_EQ(json["device"]["rate_hz"].get<double>(), std::stod(rate));
    EXPECT_EQ(json["status"], "timeout");
    EXPECT_EQ(trocar({"replay", recording, "--verify"}).exit_code, 0) << rate;
  }
}

TEST_F(Repeat, ARecordingIsNeverOverwritten) {
  const Json first = recorded_run();
  const std::string bytes = file_bytes(folder_ / "a.trec");
  expect_refusal(short_run({"--db", "t.db", "--record", "a.trec", "--seed", "9"}), 2,
                 "a.trec: exists; a recording is never overwritten");
  EXPECT_TRUE(file_bytes(folder_ / "a.trec") == bytes);
  EXPECT_EQ(trocar({"score", "a.trec"}).exit_code, 1);
  const Json stored = json_of({"trainee", "show", "guest", "--db", "t.db", "--json"}, 0);
  ASSERT_EQ(stored["history"].size(), 1u) << "a refused run leaves no attempt";
  EXPECT_EQ(stored["history"][0]["uuid"], first["attempt"]["uuid"]);
}

TEST_F(Graded, LawsOfTheBaselineRunAndReplayToo) {
  const Json proxy = json_of(expert({"--db", ":memory:"}), 0);
  const Outcome thesis =
      trocar(expert({"--db", ":memory:", "--contact", "thesis", "--passivity", "off", "--record", "t.trec"}));
  EXPECT_TRUE(thesis.exit_code == 0 || thesis.exit_code == 1) << thesis.err;
  EXPECT_NE(Json::parse(thesis.out)["state_hash"], proxy["state_hash"]);
  EXPECT_EQ(trocar({"replay", "t.trec", "--verify"}).exit_code, 0);
}

}  // namespace
}  // namespace trocar::test::repeat_test
