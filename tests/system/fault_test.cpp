// Device faults end an attempt with exit code 4, a machine that lacks something with 3; neither leaves a score behind.
#include "tests/system/system_fixture.h"

namespace trocar::test::fault_test {
namespace {

class Faults : public SystemTest {
 protected:
  /// A run that must end as a device fault, stored as such.
  Json faulty(const std::string& injection) const {
    const Json json = json_of(short_run({"--db", "f.db", "--inject", injection}), 4);
    EXPECT_EQ(json["status"], "fault");
    EXPECT_TRUE(json["score"].is_null());
    EXPECT_FALSE(json["passed"].get<bool>());
    const Json stored = json_of({"trainee", "show", "guest", "--db", "f.db", "--json"}, 0);
    EXPECT_EQ(stored["history"][0]["status"], "fault") << stored;
    return json;
  }
};

using Machine = SystemTest;

TEST_F(Faults, AnEncoderJumpEndsTheAttempt) {
  const Json json = faulty("encoder-jump:2@3");
  EXPECT_EQ(json["device"]["fault"], "encoder-jump");
  EXPECT_GE(json["device"]["ticks"].get<int>(), 3000);
  EXPECT_LE(json["device"]["ticks"].get<int>(), 3120) << "it ends a moment after the fault";
}

TEST_F(Faults, ANonFiniteHandEndsTheAttempt) {
  const Json json = faulty("hand-nan@3");
  EXPECT_EQ(json["device"]["fault"], "hand-non-finite");
}

TEST_F(Faults, WhatWasMeasuredBeforeANonFiniteHandStands) {
  const Json json = json_of({"run", "E02", "--hand", "expert", "--inject", "hand-nan@9", "--db", "f.db", "--json"}, 4);
  const Json& path = json["metrics"]["path_m"]["value"];
  ASSERT_TRUE(path.is_number()) << "a number that is none would be null here";
  EXPECT_GT(path.get<double>(), 0.05);
  EXPECT_LT(path.get<double>(), 1.0);
}

/// One injected failure of the whole program: what ends it, on which channel, and when.
struct Injected {
  const char* injection;
  const char* cause;
  int channel;      ///< -1: none in particular
  double latest_s;  ///< loop time
};

TEST_F(Faults, EveryInjectedStopNamesItsCauseItsTimeAndWhatToDo) {
  const Injected table[] = {
      {"encoder-jump:2@2.5", "encoder-jump", 2, 2.502},  {"channel-invalid:1@2.5", "channel-invalid", 1, 2.502},
      {"missed-sync:0:50@2.5", "late-loop", -1, 2.552},  {"sensor-silence@2.5", "sensor-silent", -1, 2.502},
      {"dac-stuck:1@1.5", "dac-mismatch", 1, 1.51},      {"watchdog@2.5", "watchdog", -1, 2.518},
      {"e-stop@2.5", "emergency-stop", -1, 2.502},       {"drive-fault:5@2.5", "drive-fault", 5, 2.502},
      {"over-temperature:3@2.5", "drive-hot", 3, 2.502}, {"hand-nan@2.5+0.1", "hand-non-finite", -1, 2.502}};
  for (const Injected& row : table) {
    SCOPED_TRACE(row.injection);
    const Outcome outcome = trocar(short_run({"--db", "f.db", "--inject", row.injection}));
    EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
    const Json json = Json::parse(outcome.out);
    EXPECT_EQ(json["status"], "fault");
    EXPECT_TRUE(json["score"].is_null());
    const Json& fault = json["device"]["fault_detail"];
    EXPECT_EQ(fault["cause"], row.cause);
    EXPECT_EQ(fault["channel"], row.channel < 0 ? Json(nullptr) : Json(row.channel));
    EXPECT_GE(fault["first_s"].get<double>(), 1.4999);
    EXPECT_LE(fault["first_s"].get<double>(), row.latest_s);
    EXPECT_NE(outcome.err.find(std::string("device fault ") + row.cause), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("; then put the stylus into its jig and start again"), std::string::npos) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(folder_ / json["attempt"]["safety_log"].get<std::string>()));
  }
}

TEST_F(Faults, AnOpenDeadmanVoidsAndADelayIsBorne) {
  const Json open = json_of(short_run({"--db", ":memory:", "--inject", "deadman-open@3.5+0.2"}), 1);
  EXPECT_NE(open["status"], "fault") << "the operator may switch off";
  const Json late = json_of(short_run({"--db", ":memory:", "--inject", "delay:0:3@2"}), 1);
  EXPECT_TRUE(late["device"]["fault"].is_null()) << late["device"];
}

TEST_F(Faults, AClockThatALibrarySlowsDownVoidsALiveRun) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer wants to be loaded first itself";
#endif
  // A host that takes ticks away voids a live attempt as well: then another one is asked.
  const auto played = [](const Launch& live) {
    Json json;
    for (int attempt = 0; attempt < 4; ++attempt) {
      const Outcome outcome = run_program(live);
      json = Json::parse(outcome.out, nullptr, false);
      EXPECT_FALSE(json.is_discarded()) << outcome.err;
      if (json.is_discarded() || json["integrity"].dump().find("ticks are missing") == std::string::npos) break;
    }
    return json;
  };
  Launch live = launch(short_run({"--db", ":memory:", "--realtime"}));
  const Json honest = played(live);
  live.environment["LD_PRELOAD"] = TROCAR_SLOW_CLOCK;
  const Json slowed = played(live);
  ASSERT_FALSE(honest.is_discarded() || slowed.is_discarded());
  EXPECT_NE(honest["status"], "void") << honest["integrity"];
  EXPECT_EQ(slowed["status"], "void");
  EXPECT_TRUE(slowed["score"].is_null());
  EXPECT_EQ(slowed["integrity"], "void: the program's clock ran at 0.50 of the kernel's");
}

TEST_F(Faults, AnAbortedAttemptSaysWhy) {
  const Outcome outcome = trocar(short_run({"--db", ":memory:", "--inject", "deadman-open@0"}));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(Json::parse(outcome.out)["status"], "aborted");
  EXPECT_NE(outcome.err.find("waiting for the deadman"), std::string::npos) << outcome.err;
}

TEST_F(Faults, AFaultAlsoShowsInTheTextForPeople) {
  Translator words = short_run({"--db", ":memory:", "--inject", "encoder-jump:2@3"});
  std::erase(words, "--json");
  const Outcome outcome = trocar(words);
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_NE(outcome.out.find("fault    encoder-jump"), std::string::npos) << outcome.out;
}

TEST_F(Faults, WithoutAnInjectionTheSameRunHasNone) {
  const Json json = json_of(short_run({"--db", ":memory:"}), 1);
  EXPECT_EQ(json["status"], "timeout");
  EXPECT_TRUE(json["device"]["fault"].is_null());
}

TEST_F(Machine, ADatabaseThatCannotBeMadeIsTheMachinesFault) {
  folder_.write("file", "not a folder");
  expect_refusal(short_run({"--db", "file/t.db"}), 3, "file/t.db");
  expect_refusal(short_run({"--db", "/proc/t.db"}), 3, "/proc/t.db");
  expect_refusal({"trainee", "add", "T-1", "--db", "/proc/t.db"}, 3, "/proc/t.db");
}

TEST_F(Machine, AFullDiskIsTheMachinesFault) {
  expect_refusal(short_run({"--db", "/dev/full"}), 3, "/dev/full");
  expect_refusal(short_run({"--db", ":memory:", "--record", "/dev/full"}), 3, "No space left on device");
  folder_.write("q.csv", "q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\n0,0,0,0,0,0\n");
  expect_refusal({"device", "eval", "--csv", "q.csv", "--out", "/proc/o.csv"}, 3, "cannot be written");
}

TEST_F(Machine, ARunThatCouldNotBeRecordedLeavesNoGradedAttempt) {
  expect_refusal(short_run({"--db", "t.db", "--record", "/dev/full"}), 3, "No space left on device");
  const Json stored = json_of({"trainee", "show", "guest", "--db", "t.db", "--json"}, 0);
  ASSERT_EQ(stored["history"].size(), 1u);
  EXPECT_EQ(stored["history"][0]["status"], "aborted");
  EXPECT_TRUE(stored["history"][0]["score"].is_null());
}

TEST_F(Machine, AFileThatIsNoDatabaseIsBadInputAndStaysAsItWas) {
  folder_.write("letter.txt", "Dear reader, this is not a database at all, whatever its name.");
  expect_refusal(short_run({"--db", "letter.txt"}), 2, "is not a database");
  EXPECT_EQ(file_bytes(folder_ / "letter.txt").substr(0, 4), "Dear");
}

TEST_F(Machine, ReadingWithoutADatabaseSaysThatThereIsNoneAndMakesNone) {
  for (const Translator& words : {Translator{"trainee", "list"}, {"cohort"}, {"db", "check"}, {"score", "latest"}}) {
    expect_refusal(words, 3, "there is no database yet");
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "data" / "trocar" / "trocar.db"));
}

TEST_F(Machine, TheDefaultDatabaseLiesInTheUsersDataFolder) {
  EXPECT_EQ(trocar(short_run()).exit_code, 1);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "data" / "trocar" / "trocar.db"));
  EXPECT_EQ(json_of({"cohort", "--json"}, 0).size(), 1u);
}

TEST_F(Machine, MissingAssetsAreNamedWithThePlacesLookedAt) {
  Launch here = launch({"exercises"});
  here.environment["TROCAR_ASSETS"] = (folder_ / "nothing-here").string();
  const Outcome outcome = run_program(here);
  EXPECT_EQ(outcome.exit_code, 3) << "a wrong TROCAR_ASSETS is never replaced by other assets in silence";
  EXPECT_NE(outcome.err.find("nothing-here"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace trocar::test::fault_test
