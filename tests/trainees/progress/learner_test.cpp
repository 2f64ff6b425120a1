// Acceptance of training.md 5.4, item 7: who learns is seen, who has stopped learning is not, who forgets is seen
// again.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "trainees/progress/cusum.h"
#include "trainees/progress/judgement.h"

namespace trocar::learner_test {
namespace {

constexpr int kRuns = 2000;

class Learner {
 public:
  explicit Learner(unsigned seed) : random_(seed) {}

  bool passes(double failure_rate) { return random_() / 4294967296.0 >= failure_rate; }

  /// Score of a hand whose faults decay from a novice's to an expert's (table 5.3: 49.1 and 97.8) with time constant 8,
  /// spread 5.6 to 1.2.
  double score(int attempt) {
    const double left = std::exp(-attempt / 8.0);
    return 97.8 - (97.8 - 49.1) * left + (1.2 + 4.4 * left) * normal_(random_);
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

TEST(Acceptance, ALearnerIsDeclaredBetween15And60Attempts) {
  int in_time = 0;
  for (unsigned seed = 0; seed < kRuns; ++seed) {
    Learner learner(seed);
    std::vector<bool> passed;
    for (int k = 0; k < 60; ++k) passed.push_back(learner.score(k) >= 75);
    const auto first = competence_of(cusum(passed)).first_shown;
    in_time += first && *first >= 15 && *first <= 60 ? 1 : 0;
  }
  EXPECT_GE(in_time, 0.90 * kRuns);
}

TEST(Acceptance, AFailureRateThatDecaysIsDeclaredInTimeToo) {
  int in_time = 0;
  for (unsigned seed = 0; seed < kRuns; ++seed) {
    Learner learner(seed);
    std::vector<bool> passed;
    for (int k = 0; k < 60; ++k) passed.push_back(learner.passes(0.02 + 0.93 * std::exp(-k / 8.0)));
    const auto first = competence_of(cusum(passed)).first_shown;
    in_time += first && *first >= 15 && *first <= 60 ? 1 : 0;
  }
  EXPECT_GE(in_time, 0.90 * kRuns);
}

TEST(Acceptance, APlateauedIntermediateIsHardlyEverDeclared) {
  int declared = 0;
  for (unsigned seed = 0; seed < kRuns; ++seed) {
    Learner learner(seed);
    std::vector<bool> passed;
    for (int k = 0; k < 60; ++k) passed.push_back(learner.passes(0.5));
    declared += competence_of(cusum(passed)).first_shown ? 1 : 0;
  }
  EXPECT_LE(declared, 0.01 * kRuns);
}

TEST(Acceptance, ARelapseAlarmsWithin15Attempts) {
  int seen = 0, before = 0;
  for (unsigned seed = 0; seed < kRuns; ++seed) {
    Learner learner(seed);
    std::vector<bool> passed;
    while (!competence_of(cusum(passed)).shown) passed.push_back(learner.passes(0.1));
    const int relapses = competence_of(cusum(passed)).relapses;
    for (int k = 0; k < 15; ++k) passed.push_back(learner.passes(0.4));
    const auto points = cusum(passed);
    for (std::size_t k = passed.size() - 15; k < passed.size(); ++k)
      if (points[k].decided && points[k].test == CusumPoint::Test::kKeeping) {
        ++seen;
        break;
      }
    before += relapses > 0 ? 1 : 0;
  }
  EXPECT_GE(seen, 0.90 * kRuns);
  EXPECT_EQ(before, 0) << "competence was shown once, on its way up";
}

TEST(Acceptance, TheDeskSaysSo) {
  // The same learner as the desk sees it: ready in the end; after a relapse to 0.4 no longer.
  int ready = 0, relapsed = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    Learner learner(seed);
    std::vector<CurveAttempt> attempts;
    const auto add = [&](double score) {
      CurveAttempt a;
      a.started_s = static_cast<std::int64_t>(attempts.size());
      a.score = score;
      a.passed = score >= 75;
      attempts.push_back(a);
    };
    for (int k = 0; k < 60; ++k) add(learner.score(k));
    const auto at_first = judge(attempts, {}, 0.9, "", "2026-01-01T00:00:00Z");
    ready += at_first.front().flag == Flag::kReady ? 1 : 0;
    for (int k = 0; k < 15; ++k) {
      add(learner.passes(0.4) ? 80 : 60);
      const auto now = judge(attempts, {}, 0.9, "", "2026-01-01T00:00:00Z");
      if (now.front().flag != Flag::kRelapsed) continue;
      ++relapsed;
      break;
    }
  }
  EXPECT_GE(ready, 270);
  EXPECT_GE(relapsed, 255);
}

}  // namespace
}  // namespace trocar::learner_test
