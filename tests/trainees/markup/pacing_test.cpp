// A receipt of the loop's pace: read, put into words, drawn, and what it says against a score.
#include "trainees/markup/pacing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "scenarios/scoring/attempt_result.h"

namespace trocar::pacing_test {
namespace {

constexpr const char* kReceipt = R"({"kernel":"Linux 6.1.0-rt7","kernel_realtime":true,"processors":2,"load":2.06,
 "memory_locked":true,"lost_records":0,"lanes":{"haptic":{"policy":"SCHED_FIFO 80","processor":1,"rate_hz":999.96,
 "wakes":60000,"missed":3,"overruns":1,"longest_gap_ms":3.214,
 "late_us":{"p50":12.0,"p90":18.0,"p99":31.0,"p99.9":96.0,"max":2214.5,"bins":{"10":59000,"70":990,"2000":1}},
 "period_us":{"p50":1001.0,"p90":1006.0,"p99":1020.0,"p99.9":1090.0,"max":3214.0,
   "off_bins":{"-2000":1,"-10":20000,"0":20000,"10":19997,"2000":1}},
 "cpu_us":{"p50":41.0,"p90":50.0,"p99":72.0,"p99.9":95.0,"max":326.0,"bins":{"30":50000,"50":9000,"300":1}}}}})";

std::string fact_of(const Pacing& pacing, const std::string& name) {
  const auto facts = pacing_facts(pacing);
  const auto at = std::find_if(facts.begin(), facts.end(), [&](const auto& fact) { return fact.first == name; });
  return at == facts.end() ? "not told" : at->second;
}

TEST(Pacing, AReceiptIsReadAndSaidInWords) {
  const auto pacing = parse_pacing(kReceipt);
  ASSERT_TRUE(pacing);
  EXPECT_EQ(pacing->missed, 3u);
  EXPECT_EQ(pacing->period.bins.at(-2000), 1u);
  EXPECT_EQ(fact_of(*pacing, "Scheduler"), "SCHED_FIFO 80");
  EXPECT_EQ(fact_of(*pacing, "Mean rate"), "1000.0 Hz");
  EXPECT_EQ(fact_of(*pacing, "Longest gap"), "3.21 ms");
  EXPECT_EQ(fact_of(*pacing, "Wake-up late"),
            "half within 12 \xC2\xB5s, 99 % within 31 \xC2\xB5s, 99.9 % within 96 \xC2\xB5s, longest 2.21 ms");
  EXPECT_EQ(fact_of(*pacing, "Period"),
            "half within 1 ms, 99 % within 1.02 ms, 99.9 % within 1.09 ms, longest 3.21 ms");
  EXPECT_EQ(fact_of(*pacing, "Kernel"), "Linux 6.1.0-rt7, real-time");
  EXPECT_EQ(fact_of(*pacing, "Load"), "2.1 on 2 processors");
  EXPECT_EQ(fact_of(*pacing, "Kept on processor"), "1");
}

TEST(Pacing, WhatIsNoReceiptIsNone) {
  for (const char* text : {"", "null", "[]", "{}", "{\"lanes\":3}", "{\"lanes\":{\"tissue\":{}}}", "{\"lanes\":{\"hap"})
    EXPECT_FALSE(parse_pacing(text)) << text;
}

TEST(Pacing, OfAForeignReceiptOnlyWhatCanBeReadIsTaken) {
  const auto pacing = parse_pacing(
      R"({"kernel":7,"processors":-2,"load":"high","lanes":{"haptic":{"policy":["x"],"wakes":-4,"missed":1e300,
      "late_us":{"p50":"x","bins":{"ten":4,"10":-3,"9999999999":1,"20":"y","30":2}},"cpu_us":[]}}})");
  ASSERT_TRUE(pacing);
  EXPECT_EQ(pacing->late.bins, (std::map<std::int64_t, std::uint64_t>{{30, 2}}));
  EXPECT_EQ(fact_of(*pacing, "Scheduler"), "not recorded");
  EXPECT_EQ(fact_of(*pacing, "Load"), "not told");
  EXPECT_NE(pacing_plot_svg(*pacing, 1000), "");
}

/// Texts of a drawing with their places: x, y, half of the width that they take.
struct PlacedText {
  double x = 0, y = 0, half = 0;
  std::string words;
};
std::vector<PlacedText> middle_texts(const std::string& svg) {
  std::vector<PlacedText> out;
  for (std::size_t at = svg.find("<text"); at != std::string::npos; at = svg.find("<text", at + 1)) {
    const auto number = [&](const char* name) { return std::stod(svg.substr(svg.find(name, at) + 4)); };
    const std::size_t begin = svg.find('>', at) + 1;
    const std::string words = svg.substr(begin, svg.find('<', begin) - begin);
    if (svg.compare(svg.find("text-anchor=\"", at) + 13, 6, "middle") == 0)
      out.push_back({number(" x=\""), number(" y=\""), 3.5 * static_cast<double>(words.size()), words});
  }
  return out;
}

TEST(PacingPlot, ABarForEachBinAndALineAtOnePeriod) {
  const std::string svg = pacing_plot_svg(*parse_pacing(kReceipt), 1000);
  std::size_t bars = 0;
  for (std::size_t at = svg.find("<rect"); at != std::string::npos; at = svg.find("<rect", at + 1)) ++bars;
  EXPECT_EQ(bars, 3u + 5u + 3u);
  EXPECT_NE(svg.find("stroke-dasharray"), std::string::npos) << "one late tick in sixty thousand is beyond it";
  for (const char* words : {"Wake-up: late by", "Period: off by", "Work of a tick"})
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  EXPECT_EQ(svg.find("style="), std::string::npos) << "the desk's policy forbids it";
}

TEST(PacingPlot, NamesOfTheAxesDoNotTouch) {
  for (const char* bins : {R"({"0":5})", R"({"-500000":1,"-5":4,"0":9,"700000":1})", R"({"-2":1,"3":1000000})",
                           R"({"1":1,"10":10,"100":100,"1000":1000,"10000":1,"100000":1,"1000000":1})"}) {
    const std::string receipt = std::string(R"({"lanes":{"haptic":{"period_us":{"off_bins":)") + bins + "}}}}";
    const auto texts = middle_texts(pacing_plot_svg(*parse_pacing(receipt), 1000));
    EXPECT_FALSE(texts.empty());
    for (const PlacedText& a : texts)
      for (const PlacedText& b : texts)
        EXPECT_FALSE(&a < &b && std::abs(a.y - b.y) < 12 && std::abs(a.x - b.x) < a.half + b.half)
            << a.words << " and " << b.words << " of " << bins;
  }
}

TEST(PacingPlot, WithoutHistogramsNothingIsDrawn) {
  EXPECT_EQ(pacing_plot_svg(*parse_pacing(R"({"lanes":{"haptic":{"policy":"SCHED_OTHER"}}})"), 1000), "")
      << "receipts of older programs";
}

TEST(SoftRealTime, OnlyALiveLoopOnADeviceThatWasRefusedIsMarked) {
  RunReport device;
  device.backend = "simulated";
  EXPECT_EQ(soft_real_time(device), "") << "lockstep";
  device.realtime = kReceipt;
  EXPECT_EQ(soft_real_time(device), "");
  device.realtime = R"({"lanes":{"haptic":{"policy":"SCHED_OTHER","refused":"Operation not permitted"}}})";
  EXPECT_NE(soft_real_time(device).find("Soft real time"), std::string::npos);
  device.backend = "pointer";
  EXPECT_EQ(soft_real_time(device), "") << "nothing was felt";
}

}  // namespace
}  // namespace trocar::pacing_test
