// Programmes: what the text says, when a step is reached, and which state it has at a time that is given.
#include "trainees/progress/programme.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "trainees/progress/calendar.h"
#include "trainees/progress/unlock.h"

namespace trocar::programme_test {
namespace {

constexpr std::int64_t kDay = kSecondsADay;
constexpr std::int64_t kBegin = 20000 * kDay + 3600;

std::string complaint_of(const std::string& toml) {
  try {
    read_programme(toml, "mine");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

ProgrammeStep step_of(int passes, int days = 1, bool in_a_row = false, bool sign_off = false) {
  ProgrammeStep step{"surface-touch", "L1"};
  step.passes = passes;
  step.days = days;
  step.in_a_row = in_a_row;
  step.sign_off = sign_off;
  return step;
}

/// 'p' passed, 'f' failed, 'n' not begun; each an hour after the one before, ' ' the next day. Boards by `boards`.
std::vector<StepAttempt> attempts_of(const std::string& said) {
  std::vector<StepAttempt> out;
  std::int64_t at = kBegin;
  for (const char c : said) {
    if (c == ' ')
      at += kDay;
    else
      out.push_back({static_cast<std::int64_t>(out.size()) + 1, at += 3600, c == 'p', c != 'n'});
  }
  return out;
}

int own_board(std::int64_t row) { return static_cast<int>(row); }

std::int64_t reached(const ProgrammeStep& step, const std::string& said,
                     const std::function<int(std::int64_t)>& board = own_board) {
  const auto attempts = attempts_of(said);
  const StepProgress progress = progress_of(step, attempts, board);
  if (!progress.reached_s) return 0;
  for (const StepAttempt& attempt : attempts)
    if (attempt.started_s == *progress.reached_s) return attempt.row;
  return -1;
}

TEST(Programme, IsReadAndWrittenBackTheSame) {
  const std::string toml =
      "[[step]]\nexercise = \"surface-touch\"\nlevel = \"L1\"\npasses = 3\nin_a_row = true\ndays = 2\nsign_off = true\n"
      "due_days = 30\ninput = \"device\"\n\n[[step]]\nexercise = \"a \\\"b\\\"\"\nlevel = \"exam\"\npasses = 1\n";
  const Programme programme = read_programme(toml, "mine");
  ASSERT_EQ(programme.steps.size(), 2U);
  EXPECT_EQ(programme_toml(programme), toml);
  EXPECT_EQ(read_programme(programme_toml(programme), "mine").steps, programme.steps);
  EXPECT_EQ(rule_words(programme.steps[0]),
            "3 passes in a row, on as many boards, on 2 days, with device, and signed off");
  EXPECT_EQ(rule_words(programme.steps[1]), "1 pass");
  EXPECT_TRUE(is_programme(toml));
  EXPECT_TRUE(is_programme("[[step]]\n")) << "one that cannot be read is none of the rules'";
  EXPECT_FALSE(is_programme("version = \"1\"\n"));
  EXPECT_FALSE(is_programme("[[step\n"));
}

TEST(Programme, FaultsAreSaidWithTheirPlace) {
  const std::string one = "[[step]]\nexercise = \"x\"\nlevel = \"L1\"\n";
  for (const auto& [toml, place, what] : {
           std::tuple{std::string(), "mine:1:1:", "at least one"},
           {"version = \"1\"\n" + one, "mine:1:1:", "unknown key 'version'"},
           {"step = 1\n", "mine:", "at least one"},
           {"[[step]]\nlevel = \"L1\"\n", "mine:1:", "missing key 'exercise'"},
           {one + "passes = 0\n", "mine:4:10:", "from 1 to 100"},
           {one + "passes = 2.5\n", "mine:4:10:", "whole number"},
           {one + "days = 2\n", "mine:1:", "must not exceed"},
           {one + "input = \"expert\"\n", "mine:1:1:", "none that a person holds"},
           {one + "sign_off = 1\n", "mine:4:12:", "true or false"},
           {one + "due_days = 4000\n", "mine:4:12:", "from 1 to 3660"},
           {one + "pases = 2\n", "mine:4:1:", "unknown key 'pases' in [[step]]: known are exercise"},
           {one + one, "mine:4:", "a step already"},
           {std::string("[[step]\n"), "mine:1:", ""},
           {std::string("[[step]]\nexercise = \"\"\nlevel = \"L1\"\n"), "mine:2:12:", "1 to 64"},
       }) {
    const std::string said = complaint_of(toml);
    EXPECT_TRUE(said.starts_with(place)) << toml << said;
    EXPECT_NE(said.find(what), std::string::npos) << toml << said;
  }
  std::string many;
  for (std::size_t i = 0; i <= kMostSteps; ++i)
    many += "[[step]]\nexercise = \"x" + std::to_string(i) + "\"\nlevel = \"L1\"\n";
  EXPECT_NE(complaint_of(many).find("at most 60"), std::string::npos);
}

TEST(Programme, AStepIsReachedByTheAttemptThatFulfilsItsRule) {
  EXPECT_EQ(reached(step_of(1), "ffp"), 3);
  EXPECT_EQ(reached(step_of(3), "pfpfp"), 5);
  EXPECT_EQ(reached(step_of(3), "pfpf"), 0);
  EXPECT_EQ(reached(step_of(3), "ppp ff"), 3) << "once reached it stays so";
  EXPECT_EQ(reached(step_of(2, 2), "pp p"), 3) << "on two days";
  EXPECT_EQ(reached(step_of(2, 2), "ppppp"), 0);
  EXPECT_EQ(reached(step_of(3, 2), "pp p"), 3);
  EXPECT_EQ(reached(step_of(3, 1, true), "ppfppp"), 6);
  EXPECT_EQ(reached(step_of(3, 1, true), "ppnp"), 4) << "what never began breaks no row";
  EXPECT_EQ(reached(step_of(3, 1, true), "pppp", [](std::int64_t row) { return row < 3 ? 1 : static_cast<int>(row); }),
            4)
      << "the same board twice counts once";
  EXPECT_EQ(reached(step_of(2, 2, true), "pp fp"), 4) << "the row once, the days over all passes";
}

TEST(Programme, ARowIsTheOneThatOpensLevels) {
  // Every way that six attempts can go, over boards of which some are the same.
  constexpr int kBoards[] = {1, 2, 2, 3, 1, 4};
  const auto board = [&](std::int64_t row) { return kBoards[row - 1]; };
  for (int ways = 0; ways < 64; ++ways) {
    std::string said;
    std::vector<AttemptSummary> newest_first;
    for (int i = 0; i < 6; ++i) {
      said += (ways >> i & 1) != 0 ? 'p' : 'f';
      AttemptSummary summary;
      summary.passed = said.back() == 'p';
      summary.begun = true;
      summary.status = "completed";
      summary.board = kBoards[i];
      newest_first.insert(newest_first.begin(), summary);
    }
    EXPECT_EQ(reached(step_of(3, 1, true), said, board) > 0, opens_next(newest_first, 3)) << said;
  }
}

TEST(Programme, BoardsAreAskedForOnlyWhereARowIsLongEnough) {
  int asked = 0;
  const auto counted = [&](std::int64_t row) {
    ++asked;
    return static_cast<int>(row);
  };
  reached(step_of(3), "pppppp", counted);
  reached(step_of(3, 1, true), "ppfppfpp", counted);
  EXPECT_EQ(asked, 0);
  reached(step_of(3, 1, true), "pppppppppp", counted);
  EXPECT_EQ(asked, 3);
}

TEST(Programme, WhatIsMissingIsSaid) {
  const auto missing = [](const ProgrammeStep& step, const std::string& said) {
    return missing_words(step, progress_of(step, attempts_of(said), own_board));
  };
  EXPECT_EQ(missing(step_of(3), "pf"), "1 of 3 passes");
  EXPECT_EQ(missing(step_of(3), ""), "0 of 3 passes");
  EXPECT_EQ(missing(step_of(3), "ppp"), "");
  EXPECT_EQ(missing(step_of(2, 2), "pp"), "1 of 2 days");
  EXPECT_EQ(missing(step_of(3, 2), "pp"), "2 of 3 passes, 1 of 2 days");
  EXPECT_EQ(missing(step_of(3, 1, true), "ppfppf"), "2 of 3 passes in a row");
}

TEST(Programme, TheStateFollowsRuleSignatureAndTheGivenClock) {
  const auto state = [](const ProgrammeStep& step, const std::string& said, bool certified,
                        std::optional<std::int64_t> due, std::int64_t now) {
    return state_of(step, progress_of(step, attempts_of(said), own_board), certified, due, now);
  };
  const std::int64_t due = end_of_day("2024-10-10");
  EXPECT_EQ(state(step_of(1), "", false, due, due - 1), StepState::kNotStarted) << "the whole day is in time";
  EXPECT_EQ(state(step_of(1), "", false, due, due), StepState::kOverdue);
  EXPECT_EQ(state(step_of(1), "f", false, due, due), StepState::kOverdue);
  EXPECT_EQ(state(step_of(1), "f", false, due, due - 1), StepState::kLearning);
  EXPECT_EQ(state(step_of(1), "", false, std::nullopt, due + 1000 * kDay), StepState::kNotStarted);
  EXPECT_EQ(state(step_of(1), "p", false, due, due + kDay), StepState::kPassed) << "late, but done";
  EXPECT_EQ(state(step_of(1, 1, false, true), "p", false, due, due + kDay), StepState::kToSign);
  EXPECT_EQ(state(step_of(1, 1, false, true), "f", true, due, due + kDay), StepState::kCertified);
  for (const StepState each : kStepStates) EXPECT_EQ(step_state_keyed(step_state_key(each)), each);
  EXPECT_FALSE(step_state_keyed("done"));
}

TEST(Programme, TheEarlierDeadlineHolds) {
  const std::int64_t given = seconds_of_utc("2026-01-01T15:00:00Z").value();
  ProgrammeStep step = step_of(1);
  EXPECT_FALSE(step_due(step, "", given));
  EXPECT_EQ(step_due(step, "2026-02-28", given), seconds_of_utc("2026-03-01T00:00:00Z"));
  step.due_days = 30;
  EXPECT_EQ(step_due(step, "", given), seconds_of_utc("2026-02-01T00:00:00Z")) << "31 January is the last day";
  EXPECT_EQ(step_due(step, "2026-02-28", given), seconds_of_utc("2026-02-01T00:00:00Z"));
  EXPECT_EQ(step_due(step, "2026-01-05", given), seconds_of_utc("2026-01-06T00:00:00Z"));
  for (const char* no_day : {"2026-02-30", "2026-1-1", "01.02.2026", "2026-01-01T00:00:00Z", " "})
    EXPECT_THROW(end_of_day(no_day), InputError) << no_day;
}

}  // namespace
}  // namespace trocar::programme_test
