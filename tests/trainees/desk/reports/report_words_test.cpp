// Small words of the reports, the chart of a cohort's scores, the terms.
#include "trainees/desk/reports/report_words.h"

#include <gtest/gtest.h>

#include <regex>

namespace trocar::review::report_words_test {
namespace {

TEST(ReportWords, DatesPeriodsAndSpans) {
  EXPECT_EQ(moment_text("2026-03-09T10:07:33Z"), "9 Mar 2026, 10:07");
  EXPECT_EQ(moment_text("2026-03-09"), "9 Mar 2026");
  EXPECT_EQ(moment_text("never"), "never");
  EXPECT_EQ(period_words("2026-03-09T10:07:33Z", "2026-04-01T00:00:00Z"), "9 Mar 2026 to 1 Apr 2026");
  EXPECT_EQ(period_words("2026-03-09T10:07:33Z", "2026-03-09T12:00:00Z"), "9 Mar 2026");
  EXPECT_EQ(period_words("", ""), "");
  EXPECT_EQ(span_words(3, 8), "3 to 8");
  EXPECT_EQ(span_words(4, 4), "4");
}

TEST(ReportWords, CurvesAndResults) {
  EXPECT_EQ(curve_words("Surface touch", "L2", "mouse"), "Surface touch L2, mouse");
  EXPECT_EQ(curve_words("Surface touch", "L2", ""), "Surface touch L2");
  EXPECT_EQ(result_words(false, true), "no score");
  EXPECT_EQ(result_words(true, true), "passed");
  EXPECT_EQ(result_words(true, false), "not passed");
}

TEST(ReportWords, EvidenceAsASentence) {
  EXPECT_EQ(
      evidence_words(
          R"({"words":"competence shown at attempt 14 of 16, reliability 0.84; a person decides","n":16,"attempt":"x"})"),
      "competence shown at attempt 14 of 16, reliability 0.84 (n = 16)");
  EXPECT_EQ(evidence_words("14 passes in a row"), "14 passes in a row");
  EXPECT_EQ(evidence_words(R"({"n":16})"), R"({"n":16})");
  EXPECT_EQ(evidence_words(R"({"words":"shown"})"), "shown");
  EXPECT_EQ(evidence_words("{broken"), "{broken");
}

TEST(ReportWords, GraveStatesAreRedAndReadyIsGreen) {
  for (const Flag flag : {Flag::kUnsafe, Flag::kRelapsed, Flag::kStuck, Flag::kIntegrity})
    EXPECT_EQ(tone_of(flag), printed::Tone::kBad);
  EXPECT_EQ(tone_of(Flag::kReady), printed::Tone::kGood);
  EXPECT_EQ(tone_of(Flag::kLearning), printed::Tone::kPlain);
}

/// First groups of all that the pattern finds, as numbers.
std::vector<double> numbers(const std::string& svg, const std::string& pattern) {
  const std::regex sought(pattern);
  std::vector<double> out;
  for (std::sregex_iterator it(svg.begin(), svg.end(), sought), end; it != end; ++it)
    out.push_back(std::stod((*it)[1]));
  return out;
}

/// x of the circles of a chart of one band.
std::vector<double> dots(const std::string& svg) { return numbers(svg, "<circle[^>]* cx=\"([^\"]+)\""); }

constexpr const char *kBandX = "<rect x=\"([^\"]+)\"[^>]*fill-opacity=\"0.35\"",
                     *kBandWidth = "<rect[^>]* width=\"([^\"]+)\"[^>]*fill-opacity=\"0.35\"";

TEST(ScoreBands, DotsStandAtTheirScores) {
  const std::vector<double> x = dots(score_bands_svg({{"Surface touch L2", {0, 50, 100}, 75, {}}}));
  ASSERT_EQ(x.size(), 3U);
  EXPECT_NEAR(x[1], 0.5 * (x[0] + x[2]), 0.1);
  EXPECT_GT(x[2], x[0] + 300);
}

TEST(ScoreBands, QuartilesFromThreePeopleOn) {
  const auto bands = [](const std::vector<double>& scores) {
    return numbers(score_bands_svg({{"t", scores, 75, {}}}), kBandX).size();
  };
  EXPECT_EQ(bands({50, 60}), 0U) << "it would show single people";
  EXPECT_EQ(bands({50, 60, 70}), 1U);
  EXPECT_EQ(bands({}), 0U);
}

TEST(ScoreBands, ABandRunsFromTheLowerToTheUpperQuartile) {
  const std::string svg = score_bands_svg({{"t", {0, 25, 50, 75, 100}, 75, {}}});
  const std::vector<double> x = dots(svg), left = numbers(svg, kBandX), width = numbers(svg, kBandWidth);
  ASSERT_EQ(left.size(), 1U);
  EXPECT_NEAR(left[0], x[1], 0.1);
  EXPECT_NEAR(left[0] + width.at(0), x[3], 0.1);
}

TEST(ScoreBands, LongTitlesAreCutBetweenCharactersAndEscaped) {
  std::string umlauts;
  for (int i = 0; i < 40; ++i) umlauts += "\xC3\xBC";
  const std::string svg = score_bands_svg({{umlauts, {50}, 75, 88}, {"<b> & \"c\"", {50}, 75, {}}});
  EXPECT_NE(svg.find("\xC3\xBC\xE2\x80\xA6</text>"), std::string::npos) << svg;
  EXPECT_NE(svg.find(">&lt;b&gt; &amp; &quot;c&quot;</text>"), std::string::npos) << svg;
}

/// All words of the terms.
std::string words_of_terms(TermsOf report, const ProgressRules& rules) {
  std::string out;
  for (const printed::Block& block : report_terms(report, rules)) {
    if (const auto* heading = std::get_if<printed::Heading>(&block)) out += heading->words + "\n";
    if (const auto* paragraph = std::get_if<printed::Paragraph>(&block)) out += paragraph->words + "\n";
    if (const auto* table = std::get_if<printed::Table>(&block))
      for (const auto& row : table->rows) out += row[0].words + ": " + row[1].words + "\n";
  }
  return out;
}

TEST(Terms, CarryTheNumbersOfTheRulesInForce) {
  ProgressRules rules;
  rules.version = "9";
  rules.cusum = {0.08, 0.31, 3.25, 1.75};
  rules.stuck_after = 11;
  rules.unsafe_attempts = 4;
  rules.least_reliability = 0.66;
  rules.retention_days = {21, 99};
  const std::string words = words_of_terms(TermsOf::kTrainee, rules);
  for (const char* part : {"version 9", "0.08 adequate", "0.31 inadequate", "shown at 3.25", "reaches 1.75",
                           "11 attempts without a pass", "At least 4 of the newest", "asks for 0.66", "21 and 99 days"})
    EXPECT_NE(words.find(part), std::string::npos) << part << " in\n" << words;
  EXPECT_NE(words.find("at the least " + std::to_string(shortest_run(rules.cusum)) + " passes in a row"),
            std::string::npos);
}

TEST(Terms, AreThoseOfTheReport) {
  EXPECT_NE(words_of_terms(TermsOf::kAttempt, {}).find("Virtual newtons"), std::string::npos);
  EXPECT_EQ(words_of_terms(TermsOf::kAttempt, {}).find("LC-CUSUM"), std::string::npos);
  EXPECT_NE(words_of_terms(TermsOf::kCohort, {}).find("Peak force"), std::string::npos);
  EXPECT_NE(words_of_terms(TermsOf::kTrainee, {}).find("Time trained"), std::string::npos);
}

}  // namespace
}  // namespace trocar::review::report_words_test
