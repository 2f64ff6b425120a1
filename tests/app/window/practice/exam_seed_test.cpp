// Whose seed an exam is drawn by.
#include <gtest/gtest.h>

#include <set>

#include "app/window/practice/practice_model_state.h"

namespace trocar::exam_seed_test {
namespace {

TEST(ExamSeed, IsChosenByNobodyWhoSitsIt) {
  std::set<std::int64_t> drawn;
  for (int i = 0; i < 20; ++i) drawn.insert(attempt_seed(7, false, kExamLevel));
  EXPECT_GT(drawn.size(), 15u);
  EXPECT_EQ(attempt_seed(7, false, "L3"), 7);
  EXPECT_EQ(attempt_seed(7, true, kExamLevel), 7) << "a scripted hand's run can be repeated";
  EXPECT_NE(attempt_seed({}, false, "L1"), attempt_seed({}, false, "L1"));
}

}  // namespace
}  // namespace trocar::exam_seed_test
