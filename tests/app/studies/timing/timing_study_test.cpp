// The study of timing: its calculations on given samples, its words without rights, and that it can be done. No time of
// this machine is judged.
#include "app/studies/timing/timing_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/studies/study_files.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::timing_study_test {
namespace {

/// So many wakes a millisecond apart, all late by as much.
PatternRun even_run(const std::string& name, std::int64_t late_us, std::uint32_t wakes = 10'000) {
  PatternRun run{name, "SCHED_FIFO 80", ""};
  run.late.add(late_us * 1000, wakes);
  if (name != "cyclictest") {
    run.period.add(1'000'000, wakes > 0 ? wakes - 1 : 0);
    run.work.add(40'000, wakes);
    run.awake_s = wakes > 0 ? 1e-3 * (wakes - 1) : 0;
  }
  return run;
}

const StudyCase& case_of(const StudyResult& study, const std::string& name) {
  const auto at =
      std::find_if(study.cases.begin(), study.cases.end(), [&](const StudyCase& c) { return c.name == name; });
  if (at != study.cases.end()) return *at;
  ADD_FAILURE() << "no case " << name;
  return study.cases.front();
}

StudyResult result_of(const PatternRun& ours, const PatternRun& other) {
  const TimedLoad busy{2, {ours, even_run("wait alone", 8), other, even_run("spin", 0)}};
  return timing_result(busy, {0, {ours, even_run("wait alone", 8), other}}, "a machine");
}

TEST(PatternRun, RateGapsAndMissesAreThoseOfTheWakes) {
  const PatternRun run = pattern_of_wakes("spin", {0, 1'000'000, 2'000'500, 6'100'000, 7'100'000}, 1'000'000);
  EXPECT_EQ(run.missed, 3u) << "4.1 ms: three boundaries passed";
  EXPECT_EQ(run.longest_gap_ns, 4'099'500);
  EXPECT_NEAR(run.rate_hz(), 4 / 7.1e-3, 1e-9);
  EXPECT_EQ(run.late.max_ns(), 3'099'500);
  PatternRun sum;
  sum.add(run);
  sum.add(run);
  EXPECT_EQ(sum.name, "spin");
  EXPECT_EQ(sum.missed, 6u);
  EXPECT_NEAR(sum.rate_hz(), run.rate_hz(), 1e-9) << "what lies between two slices is no period";
}

TEST(Cyclictest, ItsHistogramIsRead) {
  PatternRun run;
  EXPECT_TRUE(
      read_cyclictest("# /dev/cpu_dma_latency set to 0us\n# Histogram\n000007 000090\n000012 000009\n"
                      "# Total: 000000100\n# Max Latencies: 25001\n# Histogram Overflows: 00001\n",
                      run));
  EXPECT_EQ(run.late.count(), 100u);
  EXPECT_EQ(run.late.percentile_us(0.9), 8) << "upper end of its bin, as ours";
  EXPECT_EQ(run.late.percentile_us(0.99), 13);
  EXPECT_EQ(run.late.max_ns(), 25'001'000) << "beyond its histogram its maximum stands";
  PatternRun nothing;
  for (const char* text : {"", "sh: 1: cyclictest: not found\n", "000007\n", "1 x\n", "99999999999999999999 3\n"})
    EXPECT_FALSE(read_cyclictest(text, nothing)) << text;
}

TEST(TimingStudy, APercentileIsHeldAgainstCyclictests) {
  const StudyResult good = result_of(even_run("Trocar, live", 14), even_run("cyclictest", 9));
  EXPECT_EQ(good.beside, "cyclictest");
  const StudyCase& late = case_of(good, "wake-up late, p99, 2 busy processes");
  EXPECT_EQ(late.value, 14) << "14 us, the longest of all, in the bin that ends at 15";
  EXPECT_EQ(*late.thesis, 9);
  EXPECT_EQ(late.bar, "<= 1.5 x cyclictest");
  EXPECT_FALSE(late.met) << "14 > 13.5";
  EXPECT_TRUE(
      case_of(result_of(even_run("Trocar, live", 13), even_run("cyclictest", 9)), "wake-up late, p99, 2 busy processes")
          .met);
  EXPECT_TRUE(case_of(good, "wake-up late, p99, idle").met) << "without load it is told, not judged";
}

TEST(TimingStudy, WithoutAWakeNothingIsMet) {
  const StudyResult study = result_of(even_run("Trocar, live", 0, 0), even_run("cyclictest", 9));
  EXPECT_FALSE(case_of(study, "wake-up late, p99, 2 busy processes").met);
  EXPECT_FALSE(case_of(study, "mean rate, Trocar, live, 2 busy processes").met);
}

TEST(TimingStudy, TheMeanRateIsAThousandToOneDecimal) {
  EXPECT_TRUE(case_of(result_of(even_run("Trocar, live", 9), even_run("cyclictest", 9)),
                      "mean rate, Trocar, live, 2 busy processes")
                  .met);
  PatternRun slow = even_run("Trocar, live", 9);
  slow.awake_s += 2e-3;
  slow.missed = 2;
  const StudyResult study = result_of(slow, even_run("cyclictest", 9));
  const StudyCase& rate = case_of(study, "mean rate, Trocar, live, 2 busy processes");
  EXPECT_FALSE(rate.met) << "999.8 Hz";
  EXPECT_NEAR(rate.value, 999.8, 0.01);
  EXPECT_NE(rate.definition.find("2 of 10002 periods passed without one"), std::string::npos) << rate.definition;
  PatternRun beside = even_run("cyclictest", 9);
  beside.late.add(2'100'000, 3);
  const std::string of_both =
      case_of(result_of(even_run("Trocar, live", 9), beside), "mean rate, Trocar, live, 2 busy processes").definition;
  EXPECT_NE(of_both.find("cyclictest waited beside it, 6 of 10009 passed so"), std::string::npos) << of_both;
}

TEST(TimingStudy, WithoutCyclictestOrRightsItSaysSoAndTakesItsOwnWait) {
  PatternRun none{"cyclictest", "SCHED_OTHER", "not installed (apt install rt-tests)"};
  PatternRun ours = even_run("Trocar, live", 60);
  ours.scheduler = "SCHED_OTHER";
  ours.refused = "Operation not permitted";
  const StudyResult study = result_of(ours, none);
  EXPECT_EQ(study.beside, "the wait alone");
  EXPECT_EQ(*case_of(study, "wake-up late, p50, 2 busy processes").thesis, 8);
  const std::string table = table_markdown(study);
  for (const char* words :
       {"| measure | unit | the wait alone |", "cyclictest not installed (apt install rt-tests): ours is held against",
        "Our loop did not get SCHED_FIFO (Operation not permitted)", "Trocar, live SCHED_OTHER"})
    EXPECT_NE(table.find(words), std::string::npos) << words << "\n" << table;
  for (const StudyCurves& curves : study.curves)
    for (const auto& series : curves.series) EXPECT_NE(series.name, "cyclictest");
}

TEST(TimingStudy, TheCurveIsTheShareThatCameLater) {
  const StudyResult study = result_of(even_run("Trocar, live", 100), even_run("cyclictest", 9));
  const StudyCurves& curves = study.curves.front();
  EXPECT_TRUE(curves.logarithmic);
  for (std::size_t i = 0; i < curves.x.size(); ++i) {
    const double later = curves.series.front().y[i];
    EXPECT_TRUE(curves.x[i] <= 100.001 ? later == 1 : std::isnan(later)) << curves.x[i] << ": " << later;
  }
  const std::string svg = curves_svg(curves);
  EXPECT_NE(svg.find(">100000<"), std::string::npos) << "decades in plain numbers";
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(TimingStudy, ItCanBeDoneHereWhateverTheRights) {
  const PatternRun live = live_attempt(0.3), wait = wait_alone(0.1), spin = busy_wait(0.05),
                   yield = sleep_and_yield(0.05);
  EXPECT_GT(live.period.count(), 0u);
  EXPECT_EQ(live.late.count(), live.period.count() + 1);
  EXPECT_EQ(live.refused.empty(), live.scheduler == "SCHED_FIFO 80");
  EXPECT_GT(live.work.percentile_us(0.5), wait.work.percentile_us(0.5)) << "the real tick, not an empty one";
  EXPECT_EQ(spin.scheduler, "SCHED_OTHER");
  EXPECT_LE(yield.period.count(), 50u) << "never more often than asked";
  const PatternRun peer = cyclictest(0.1);
  EXPECT_EQ(peer.late.count() > 0, peer.refused.empty()) << peer.refused;
  const BusyProcesses busy(1);
}

}  // namespace
}  // namespace trocar::timing_study_test
