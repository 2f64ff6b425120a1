// What `trocar run` makes of its options, and how it ends.
#include "app/cli/attempts/run_command.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "app/cli/attempts/attempt_json.h"
#include "haptics/input_error.h"
#include "tests/support/sample_attempt.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::run_command_test {
namespace {

using test::message_of;

std::string refusal(const std::string& text) {
  return message_of<InputError>([&] { parse_injection(text); });
}

RunOptions options() {
  RunOptions run;
  run.exercise = "surface-touch";
  run.hand = "expert";
  return run;
}

TEST(ParseInjection, ReadsKindChannelValueTimeAndDuration) {
  const InjectedFault fault = parse_injection("encoder-stuck:4:17.5@2.25+0.5");
  EXPECT_EQ(fault.kind, InjectedFaultKind::kEncoderStuck);
  EXPECT_EQ(fault.channel, 4);
  EXPECT_DOUBLE_EQ(fault.value, 17.5);
  EXPECT_DOUBLE_EQ(fault.at_s, 2.25);
  EXPECT_DOUBLE_EQ(fault.duration_s, 0.5);
}

TEST(ParseInjection, LeavesOutWhatIsNotSaid) {
  const InjectedFault fault = parse_injection("hand-lets-go@3");
  EXPECT_EQ(fault.kind, InjectedFaultKind::kHandLetsGo);
  EXPECT_EQ(fault.channel, 0);
  EXPECT_DOUBLE_EQ(fault.at_s, 3);
  EXPECT_DOUBLE_EQ(fault.duration_s, 0) << "for good";
  EXPECT_GT(parse_injection("encoder-jump@1").value, 100) << "a jump is large enough to be seen";
}

TEST(ParseInjection, KnowsEveryKind) {
  std::set<InjectedFaultKind> kinds;
  for (const char* name : {"encoder-jump", "encoder-stuck", "channel-invalid", "dac-stuck", "missed-sync", "hand-nan",
                           "hand-lets-go", "delay", "e-stop", "deadman-open", "drive-fault", "watchdog",
                           "over-temperature", "sensor-silence", "beam-dark", "beam-lit"}) {
    kinds.insert(parse_injection(std::string(name) + "@1").kind);
  }
  EXPECT_EQ(kinds.size(), 16u);
}

TEST(ParseInjection, RefusesValuesThatTheDeviceCannotHave) {
  EXPECT_EQ(parse_injection("delay@1").value, 5) << "not a jump's thousand";
  EXPECT_EQ(parse_injection("delay:0:63@1").value, 63);
  for (const char* bad : {"delay:0:0@1", "delay:0:64@1"}) {
    EXPECT_NE(refusal(bad).find("1 to 63 periods"), std::string::npos) << bad;
  }
  for (const char* bad : {"missed-sync:0:0.5@1", "missed-sync:0:1001@1"}) {
    EXPECT_NE(refusal(bad).find("missed SYNCs are 1 to 1000"), std::string::npos) << bad;
  }
  EXPECT_NE(refusal("encoder-jump:0:1e12@1").find("2147483647 counts"), std::string::npos);
}

TEST(ParseInjection, RefusesWithTheFormOrTheKnownKinds) {
  EXPECT_EQ(refusal("encoder-jump"), "--inject encoder-jump: KIND[:CHANNEL[:VALUE]]@SECONDS[+DURATION]");
  EXPECT_NE(refusal("gremlin@1")
                .find("known are beam-dark, beam-lit, channel-invalid, dac-stuck, deadman-open, delay, drive-fault"),
            std::string::npos);
  EXPECT_NE(refusal("@1").find("known are"), std::string::npos);
  EXPECT_NE(refusal("dac-stuck:7@1").find("channels are 0 to 6"), std::string::npos);
  EXPECT_NE(refusal("dac-stuck:-1@1").find("channels are 0 to 6"), std::string::npos);
}

TEST(ParseInjection, RefusesWhatIsNoFiniteNumberOrNoWholeChannel) {
  for (const char* bad :
       {"dac-stuck@", "dac-stuck@x", "dac-stuck@1s", "dac-stuck:@1", "dac-stuck:a@1", "dac-stuck:1:@1", "dac-stuck@1+",
        "dac-stuck@nan", "dac-stuck@inf", "dac-stuck:nan@1", "dac-stuck:1:inf@1"}) {
    EXPECT_NE(refusal(bad).find("is not a number"), std::string::npos) << bad;
  }
  EXPECT_NE(refusal("dac-stuck:2.7@1").find("channels are 0 to 6"), std::string::npos) << "not silently channel 2";
  EXPECT_NE(refusal("dac-stuck@-1").find("not be negative"), std::string::npos);
  EXPECT_NE(refusal("dac-stuck@1+-2").find("not be negative"), std::string::npos);
}

TEST(AttemptSetup, ResolvesNamesAndDrawsTheBoardFromTheSeed) {
  RunOptions run = options();
  run.seed = 7;
  run.contact_law = "thesis";
  run.passivity_law = "off";
  run.injections = {"hand-nan@3", "dac-stuck:1@4"};
  const AttemptSetup setup = attempt_setup(run, find_assets());
  EXPECT_EQ(setup.exercise.id, "surface-touch");
  EXPECT_EQ(setup.seed, 7);
  EXPECT_EQ(setup.contact_law, ContactLaw::kThesis);
  EXPECT_EQ(setup.passivity_law, PassivityLaw::kOff);
  EXPECT_EQ(setup.faults.size(), 2u);
  run.exercise = "E02";
  EXPECT_EQ(attempt_setup(run, find_assets()).exercise.id, "surface-touch");
}

TEST(AttemptSetup, PracticeBoardsAreNeverDrawn) {
  const AssetRoots assets = find_assets();
  RunOptions run = options();
  std::set<int> boards;
  for (const std::int64_t seed :
       {1LL, 2LL, 999999LL, 0LL, -1LL, -990LL, -999999LL, -5000000001LL, 9223372036854775807LL}) {
    run.seed = seed;
    const int board = attempt_setup(run, assets).board;
    EXPECT_GE(board, 20) << "seed " << seed;
    boards.insert(board);
  }
  EXPECT_EQ(boards.size(), 6u) << "1 and -999999, and 999999, -1 and -5000000001, share a remainder";
  run.seed = -1;
  run.level = "exam";
  EXPECT_EQ(attempt_setup(run, assets).board, 2999999) << "exams have boards of their own";
  run.board = 3;
  EXPECT_THROW(attempt_setup(run, assets), InputError) << "and none of practice";
  run.level = "L3";
  EXPECT_EQ(attempt_setup(run, assets).board, 3);
  for (const int board : {-1, 20}) {
    run.board = board;
    EXPECT_THROW(attempt_setup(run, assets), InputError) << board;
  }
}

TEST(AttemptSetup, RefusesUnknownLaws) {
  RunOptions run = options();
  run.contact_law = "magic";
  EXPECT_EQ(message_of<InputError>([&] { attempt_setup(run, find_assets()); }),
            "--contact magic: unknown; known are proxy, thesis");
}

TEST(ExitCode, FollowsTheGrade) {
  AttemptResult result = testing_support::sample_attempt(true);
  EXPECT_EQ(exit_code(result), 0);
  EXPECT_EQ(exit_code(testing_support::sample_attempt(false)), 1);
  for (const AttemptStatus status : {AttemptStatus::kTimeout, AttemptStatus::kAborted, AttemptStatus::kVoid}) {
    result.grade.status = status;
    result.grade.passed = false;
    EXPECT_EQ(exit_code(result), 1);
  }
  result.grade.status = AttemptStatus::kFault;
  EXPECT_EQ(exit_code(result), 4);
}

TEST(PrintResult, SaysScoreGradeSubscoresAndCaps) {
  std::ostringstream out;
  AttemptResult result = testing_support::sample_attempt(false);
  print_result(result, out);
  for (const char* part : {"status   completed", "score    59.0  (below pass)", "peak_force", "safety gate",
                           "cap      safety: peak_force below 0.5: at most 59", "hash     0123456789abcdef"}) {
    EXPECT_NE(out.str().find(part), std::string::npos) << part << " in\n" << out.str();
  }
  out.str("");
  result.grade.score.reset();
  result.device.fault = "encoder-jump";
  print_result(result, out);
  EXPECT_NE(out.str().find("score    none"), std::string::npos);
  EXPECT_NE(out.str().find("fault    encoder-jump"), std::string::npos);
}

TEST(RunCommand, AnUnknownHandIsRefusedBeforeAnythingIsStored) {
  const test::TemporaryFolder folder;
  RunOptions run = options();
  run.hand = "octopus";
  run.database = folder / "t.db";
  std::ostringstream out, err;
  EXPECT_THROW(run_command(run, out, err), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "t.db"));
}

TEST(AttemptSetup, ADeviceThatAPersonHoldsIsRefusedBeforeItIsTouched) {
  RunOptions run = options();
  run.card = "127.0.0.1:9";
  for (const char* held : {kHostmot2Backend, kMc4000Backend}) {
    run.backend = held;
    EXPECT_CONTAINS(message_of<InputError>([&] { attempt_setup(run, find_assets()); }), "no script moves it");
  }
}

}  // namespace
}  // namespace trocar::run_command_test
