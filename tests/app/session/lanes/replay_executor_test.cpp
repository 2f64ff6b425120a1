// The replay executor: each tick with the patch that it saw, each step with the state that it saw; nonsense refused.
#include "app/session/lanes/replay_executor.h"

#include <gtest/gtest.h>

#include <string>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::replay_executor_test {
namespace {

using test::message_of;

std::vector<RecordedTick> rows(std::initializer_list<std::uint64_t> ticks) {
  std::vector<RecordedTick> out;
  for (const std::uint64_t tick : ticks) {
    RecordedTick& row = out.emplace_back();
    row.elapsed_periods = static_cast<std::uint32_t>(tick - (out.size() > 1 ? out[out.size() - 2].tick : 0));
    row.tick = tick;
  }
  return out;
}

/// Writes down which patch each tick sees.
class Ticking final : public Task {
 public:
  Ticking(Inlet<ContactPatch>& patches, std::string& log) : patches_(patches), log_(log) {}
  std::uint32_t period() const override { return 1; }
  void run(std::uint64_t row) override {
    log_ += " t" + std::to_string(row) + ":" + std::to_string(patches_.newest(row).stamp);
  }

 private:
  Inlet<ContactPatch>& patches_;
  std::string& log_;
};

/// Makes patches 1, 2, 3...
class Stepping final : public Task {
 public:
  Stepping(Outlet<ContactPatch>& patches, std::string& log) : patches_(patches), log_(log) {}
  std::uint32_t period() const override { return 10; }
  void run(std::uint64_t row) override {
    patches_.begin(row).stamp = ++stamp_;
    patches_.commit();
    log_ += " s" + std::to_string(stamp_);
  }

 private:
  Outlet<ContactPatch>& patches_;
  std::string& log_;
  std::uint64_t stamp_ = 0;
};

std::string replay(const std::vector<RecordedTick>& ticks, const Schedule& schedule) {
  const ReplayExecutor executor(ticks, schedule);
  RecordedPatches patches(executor.stamps());
  std::string log;
  Ticking ticking(patches, log);
  Stepping stepping(patches, log);
  executor.run(ticking, {&stepping});
  return log;
}

TEST(ReplayExecutor, RepeatsWhatEachTaskSaw) {
  EXPECT_EQ(replay(rows({1, 2, 5, 6}), {{{5, 1}, {6, 2}}, {1, 2, 6}}), " t0:0 s1 t1:0 s2 t2:1 t3:2 s3");
}

TEST(ReplayExecutor, StepsBeforeTheFirstTickAndAfterAStallKeepTheirPlace) {
  EXPECT_EQ(replay(rows({1, 2}), {{{1, 2}}, {0, 0, 1, 1}}), " s1 s2 t0:2 s3 s4 t1:2");
}

TEST(ReplayExecutor, PatchesThatNoTickSawAreMadeAllTheSame) {
  EXPECT_EQ(replay(rows({1, 2, 3, 4}), {{{4, 3}}, {1, 2, 3}}), " t0:0 s1 t1:0 s2 t2:0 s3 t3:3");
}

TEST(ReplayExecutor, StepsThatSawTicksAfterTheLastRowAreLeftOut) {
  EXPECT_EQ(replay(rows({1, 2}), {{{2, 1}}, {1, 3, 7}}), " t0:0 s1 t1:1");
}

TEST(ReplayExecutor, WhatCannotHaveHappenedIsRefused) {
  const auto refusal = [](const std::vector<RecordedTick>& ticks, const Schedule& schedule) {
    return message_of<InputError>([&] { ReplayExecutor(ticks, schedule); });
  };
  EXPECT_NE(refusal({}, {}).find("no tick"), std::string::npos);
  EXPECT_NE(refusal(rows({1, 2}), {{{2, 1}}, {}}).find("tick 2 is said to have seen patch 1"), std::string::npos);
  EXPECT_NE(refusal(rows({1, 2}), {{{2, 1}}, {2}}).find("had not been made"), std::string::npos)
      << "made from its own tick";
  EXPECT_NE(refusal(rows({1, 4}), {{}, {3}}).find("saw tick 3, which is missing"), std::string::npos);
  auto lost = rows({1, 2, 3});
  lost.erase(lost.begin() + 1);
  EXPECT_NE(refusal(lost, {}).find("1 of its ticks are missing"), std::string::npos);
}

}  // namespace
}  // namespace trocar::replay_executor_test
