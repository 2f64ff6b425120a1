// What is said of a device that stopped: every fault has a cause and advice, every ungraded end a reason.
#include "app/session/grading/device_words.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "haptics/fault.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::device_words_test {
namespace {

RunReport stopped(const std::string& fault) {
  RunReport run_report;
  run_report.fault = fault;
  run_report.fault_channel = 2;
  run_report.fault_s = 3.0006;
  run_report.fault_value = 1234.5;
  return run_report;
}

TEST(FaultWords, EveryFaultOfTheDeviceHasACauseAndAdvice) {
  std::set<std::string> texts;
  for (int code = 1; code <= static_cast<int>(FaultCode::kDriveHot); ++code) {
    const std::string name = fault_name(static_cast<FaultCode>(code));
    ASSERT_NE(name, "unknown") << code;
    const std::string words = fault_words(stopped(name));
    EXPECT_EQ(words.find(name + " on channel 2 at 3.001 s: "), 0u) << words;
    EXPECT_CONTAINS(words, "; then put the stylus into its jig and start again: the device homes anew.");
    EXPECT_EQ(words.find('%'), std::string::npos) << "the value stands in its place: " << words;
    texts.insert(words.substr(words.find(": ")));
  }
  EXPECT_EQ(texts.size(), static_cast<std::size_t>(FaultCode::kDriveHot)) << "each says something else";
}

TEST(FaultWords, SayTheNumberWhereThereIsOne) {
  EXPECT_CONTAINS(fault_words(stopped("encoder-jump")), "the counter moved by 1234.5 counts in one period");
  EXPECT_EQ(fault_words(stopped("emergency-stop")).find("1234"), std::string::npos) << "a button has no number";
  RunReport endless = stopped("overspeed");
  endless.fault_value = std::numeric_limits<double>::infinity();
  EXPECT_CONTAINS(fault_words(endless), "it moved at inf (rad/s");
}

TEST(FaultWords, NoChannelIsNotNamedAndNoFaultIsSilence) {
  RunReport run_report = stopped("late-loop");
  run_report.fault_channel = -1;
  EXPECT_EQ(fault_words(run_report).find("late-loop at 3.001 s: 1234.5 periods were missed. Close"), 0u);
  EXPECT_EQ(fault_words(stopped("")), "");
  EXPECT_EQ(fault_words(stopped("of-tomorrow")), "of-tomorrow on channel 2 at 3.001 s") << "no cause is made up";
}

TEST(EndWords, SayWhyAnAttemptWasNotGraded) {
  const RunReport none;
  EXPECT_EQ(end_words(AttemptStatus::kFault, stopped("drive-hot"), LoopState::kFault, true),
            "device fault " + fault_words(stopped("drive-hot")));
  EXPECT_CONTAINS(end_words(AttemptStatus::kVoid, none, LoopState::kActive, true), "the deadman was opened");
  EXPECT_EQ(end_words(AttemptStatus::kAborted, none, LoopState::kActive, true),
            "the exercise did not end within its time");
  EXPECT_EQ(end_words(AttemptStatus::kAborted, none, LoopState::kHomed, false),
            "the exercise never began: the device was homed, waiting for the deadman to be closed");
  EXPECT_EQ(end_words(AttemptStatus::kAborted, none, LoopState::kSelfTest, false),
            "the exercise never began: the device was self-test");
  EXPECT_EQ(end_words(AttemptStatus::kAborted, none, LoopState::kUnhomed, false,
                      {.step = HomingStep::kJig, .trouble = HomingTrouble::kDark}),
            "the exercise never began: the device was unhomed. Put the stylus into its jig. No light: turn the stylus, "
            "look at the light's wires.");
  for (const AttemptStatus graded : {AttemptStatus::kCompleted, AttemptStatus::kTimeout}) {
    EXPECT_EQ(end_words(graded, stopped("drive-hot"), LoopState::kActive, true), "") << status_name(graded);
  }
}

}  // namespace
}  // namespace trocar::device_words_test
