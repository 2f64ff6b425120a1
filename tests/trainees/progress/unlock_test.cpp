// Three in a row on three boards open the next level, and it stays open.
#include "trainees/progress/unlock.h"

#include <gtest/gtest.h>

namespace trocar::unlock_test {
namespace {

/// Newest first: upper case passed, lower case failed, the letter is the board; '-' left, '!' switched off or ended by
/// the device in the run, '?' before its clock began, '.' running.
std::vector<AttemptSummary> attempts(const std::string& newest_first) {
  std::vector<AttemptSummary> out;
  for (const char c : newest_first) {
    AttemptSummary a;
    a.status = c == '!' || c == '?' ? "void" : c == '.' ? "running" : c == '-' ? "aborted" : "completed";
    a.passed = c >= 'A' && c <= 'Z';
    a.board = a.passed ? c - 'A' : c - 'a';
    a.begun = c != '?';
    out.push_back(a);
  }
  return out;
}

TEST(Unlock, CountsBoardsNotAttempts) {
  struct Row {
    const char* newest_first;
    int in_a_row;
    bool opens;
  };
  for (const Row& row : {Row{"", 0, false},
                         {"A", 1, false},
                         {"AB", 2, false},
                         {"ABC", 3, true},
                         {"AAA", 1, false},
                         {"ABA", 2, false},
                         {"ABAC", 3, true},
                         {"ABcD", 2, false},
                         {"aABC", 0, true},
                         {"-ABC", 0, true},
                         {"A-BC", 1, false},
                         {"A!BC", 1, false},
                         {"A?BC", 3, true},
                         {".ABC", 3, true},
                         {"A.BC", 1, false},
                         {"aBcDEFg", 0, true},
                         {"ABcAB", 2, false}}) {
    EXPECT_EQ(passes_in_a_row(attempts(row.newest_first)), row.in_a_row) << row.newest_first;
    EXPECT_EQ(opens_next(attempts(row.newest_first)), row.opens) << row.newest_first;
  }
}

TEST(Unlock, NumberIsTheRules) {
  EXPECT_TRUE(opens_next(attempts("AB"), 2));
  EXPECT_FALSE(opens_next(attempts("ABC"), 4));
  EXPECT_TRUE(opens_next(attempts("ABCD"), 4));
}

}  // namespace
}  // namespace trocar::unlock_test
