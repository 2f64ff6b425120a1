#include <gtest/gtest.h>

#include <algorithm>

#include "tests/trainees/desk/pages/page_checker.h"
#include "tests/trainees/desk/pages/page_samples.h"
#include "trainees/desk/pages/charts.h"

namespace trocar::review::cohort_page_test {
namespace {

using testing::Test;

std::vector<std::string> codes(const std::vector<CohortEntry>& lines) {
  std::vector<std::string> out;
  for (const CohortEntry& line : lines) out.push_back(line.code);
  return out;
}

/// Text of the counts in the four cards, by the card's class.
std::string count_of(const CheckedPage& page, const std::string& card) {
  const auto sections = page.all("section", card);
  if (sections.size() != 1) return "no card";
  const std::string& text = sections[0]->text;
  const std::size_t digit = text.find_first_of("0123456789");
  return text.substr(digit, text.find_first_not_of("0123456789", digit) - digit);
}

TEST(CohortPage, SaysAtTheTopWhoIsUnsafeRelapsedStuckAndReady) {
  const CheckedPage page = check_page(cohort_page(sample_cohort(), sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_EQ(count_of(page, "unsafe"), "2");
  EXPECT_EQ(count_of(page, "relapsed"), "1");
  EXPECT_EQ(count_of(page, "stuck"), "2");  // gupta is unsafe and stuck: in both cards
  EXPECT_EQ(count_of(page, "ready"), "1");
  const std::string unsafe = page.all("section", "unsafe")[0]->text;
  EXPECT_NE(unsafe.find("dubois"), std::string::npos);
  EXPECT_NE(unsafe.find("3 of the last 5 attempts went past 4.7 N"), std::string::npos);
  EXPECT_EQ(unsafe.find("brandt"), std::string::npos);
  EXPECT_NE(page.all("section", "ready")[0]->text.find("brandt"), std::string::npos);
}

TEST(CohortPage, CardsStandBeforeTheTable) {
  const std::string html = cohort_page(sample_cohort(), sample_frame());
  EXPECT_LT(html.find("class=\"states\""), html.find("<table"));
  EXPECT_LT(html.find("class=\"state unsafe\""), html.find("class=\"state ready\""));
}

TEST(CohortPage, RowsHaveTheNumbersOfTheirLine) {
  const CheckedPage page = check_page(cohort_page(sample_cohort(), sample_frame()));
  const auto rows = page.all("tr");
  const auto row =
      std::find_if(rows.begin(), rows.end(), [](const PageElement* r) { return r->text.starts_with("dubois"); });
  ASSERT_NE(row, rows.end());
  EXPECT_EQ((*row)->text,
            "duboisunsafe3 of the last 5 attempts went past 4.7 Nn = 5, reliability not known yet, rules 1Surface "
            "touch mouseL2770.070.06.3917 Mar 2026");
}

TEST(CohortPage, GravestFirstUnlessAskedOtherwise) {
  CohortView view = sample_cohort();
  EXPECT_EQ(codes(selected_lines(view)), (std::vector<std::string>{"dubois", "gupta", "eriksen", "chen", "h\xC3\xB8yer",
                                                                   "brandt", "alvarez", "farouk"}));
  view.asked.sort = "-best";
  EXPECT_EQ(codes(selected_lines(view)).front(), "brandt");
  view.asked.sort = "best";
  EXPECT_EQ(codes(selected_lines(view)).front(), "gupta");
  view.asked.sort = "-over";
  EXPECT_EQ(codes(selected_lines(view)).front(), "dubois");
  view.asked.sort = "name";
  EXPECT_EQ(codes(selected_lines(view)).front(), "alvarez");
  view.asked.sort = "-name";
  EXPECT_EQ(codes(selected_lines(view)).front(), "h\xC3\xB8yer");
  view.asked.sort = "nonsense; DROP TABLE";
  EXPECT_EQ(codes(selected_lines(view)).front(), "dubois");
}

TEST(CohortPage, TheWorstOfTheUnsafeStandsFirstInCardAndTable) {
  CohortView view = sample_cohort();
  Harm mild, bad;
  mild.peak_n = 2.2;
  bad.peak_n = 6;
  mild.limit_n = bad.limit_n = 2;
  for (CohortEntry& line : view.lines)
    if (line.state() == Flag::kUnsafe) line.harm = line.code == "gupta" ? bad : mild;
  EXPECT_EQ(codes(selected_lines(view)).front(), "gupta");
  EXPECT_EQ(trainees_in_state(view, Flag::kUnsafe).front()->code, "gupta");
  view.asked.sort = "-state";
  EXPECT_EQ(codes(selected_lines(view)).back(), "gupta");
}

TEST(CohortPage, WhoHasNotStartedIsCountedAndListedAndTheHeadlineFollowsTheFilters) {
  CohortView view = sample_cohort();
  CohortEntry idle;
  idle.code = "ivo";
  idle.judgements = {judged(Flag::kNotStarted, "registered 2026-03-01; no attempt yet", 0)};
  view.lines.push_back(idle);
  const auto title = [&view] { return check_page(cohort_page(view, sample_frame())).all("div", "title")[0]->text; };
  const CheckedPage page = check_page(cohort_page(view, sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_EQ(count_of(page, "not-started"), "1");
  EXPECT_NE(page.all("section", "state not-started")[0]->text.find("registered 1 Mar 2026"), std::string::npos);
  EXPECT_EQ(codes(selected_lines(view)).back(), "ivo");
  EXPECT_NE(title().find("9 trainees, 71 tries"), std::string::npos) << title();
  view.asked.state = "not-started";
  EXPECT_EQ(codes(selected_lines(view)), (std::vector<std::string>{"ivo"}));
  EXPECT_NE(title().find("1 trainee, 0 tries"), std::string::npos) << title();
}

TEST(CohortPage, LinesWithoutANumberStandLastInBothDirections) {
  CohortView view;
  view.lines = {sample_line("none", {}, {}), sample_line("low", {10}, {}), sample_line("high", {90}, {})};
  view.asked.sort = "best";
  EXPECT_EQ(codes(selected_lines(view)), (std::vector<std::string>{"low", "high", "none"}));
  view.asked.sort = "-best";
  EXPECT_EQ(codes(selected_lines(view)), (std::vector<std::string>{"high", "low", "none"}));
}

TEST(CohortPage, AStateFindsLinesThatHaveItAmongOthers) {
  CohortView view = sample_cohort();
  view.asked.state = "stuck";
  EXPECT_EQ(codes(selected_lines(view)), (std::vector<std::string>{"gupta", "chen"}));
  view.asked.state = "learning";
  EXPECT_EQ(codes(selected_lines(view)), (std::vector<std::string>{"alvarez", "farouk"}));
  view.asked.state = "no such state";
  EXPECT_EQ(selected_lines(view).size(), 8U);
  const CheckedPage page = check_page(cohort_page(view, sample_frame()));
  EXPECT_EQ(count_of(page, "unsafe"), "2");  // the cards stay those of everybody
}

TEST(CohortPage, SortLinksKeepTheFiltersAndTurnRound) {
  CohortView view = sample_cohort();
  view.asked = {"2026 A", "surface-touch", "L2", "", "-best", 1};
  const CheckedPage page = check_page(cohort_page(view, sample_frame()));
  std::vector<std::string> best;
  for (const PageElement* link : page.all("a"))
    if (link->text.starts_with("Best")) best.push_back(link->of("href"));
  ASSERT_EQ(best.size(), 1U);
  EXPECT_EQ(best[0], "?group=2026%20A&exercise=surface-touch&level=L2&sort=best#trainees");
  const auto heads = page.all("th");
  EXPECT_EQ(std::count_if(heads.begin(), heads.end(),
                          [](const PageElement* h) { return h->of("aria-sort") == "descending"; }),
            1);
}

TEST(CohortPage, FiltersShowWhatWasAsked) {
  CohortView view = sample_cohort();
  view.asked.group = "2026 B";
  const CheckedPage page = check_page(cohort_page(view, sample_frame()));
  std::vector<std::string> selected;
  for (const PageElement* option : page.all("option"))
    if (!option->of("selected").empty()) selected.push_back(option->text);
  EXPECT_EQ(selected, (std::vector<std::string>{"2026 B", "all exercises", "all levels", "any state"}));
  EXPECT_EQ(page.all("h1")[0]->text, "Cohort 2026 B");
}

TEST(CohortPage, EmptySaysWhatToExpect) {
  const CheckedPage page = check_page(cohort_page({}, sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_EQ(count_of(page, "unsafe"), "0");
  EXPECT_NE(page.by_id("trainees")->text.find("No attempts yet"), std::string::npos);
}

TEST(CohortPage, TenThousandLinesAreShownInParts) {
  CohortView view;
  for (int i = 0; i < 10000; ++i) {
    view.lines.push_back(sample_line("t" + std::to_string(10000 + i), {50, 60, 70}, {}));
    if (i < 7000) view.lines.back().judgements = {judged(Flag::kUnsafe, "too strong")};
  }
  view.any_attempt = true;
  view.asked.page = 3;
  const std::string html = cohort_page(view, sample_frame());
  EXPECT_LT(html.size(), 200000U);
  const CheckedPage page = check_page(html);
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_EQ(page.all("svg", "spark").size(), static_cast<std::size_t>(kLinesOnPage));
  EXPECT_EQ(count_of(page, "unsafe"), "7000");
  EXPECT_NE(html.find("and 6995 more"), std::string::npos);
  EXPECT_NE(html.find(">t10200<"), std::string::npos);
  EXPECT_EQ(html.find(">t10300<"), std::string::npos);
  view.asked.page = 999;
  EXPECT_NE(cohort_page(view, sample_frame()).find(">t19999<"), std::string::npos);
}

TEST(CohortPage, HostileTextsAreShownAndDoNothing) {
  CohortView view;
  CohortEntry line = sample_line(kHostile, {1, 2}, {judged(Flag::kUnsafe, kHostile)});
  line.name = line.exercise = line.exercise_id = line.level = line.hand = line.last_utc = kHostile;
  view.lines = {line};
  view.groups = view.levels = {kHostile};
  view.exercises = {{kHostile, kHostile}};
  view.asked = {kHostile, kHostile, kHostile, kHostile, kHostile, 1};
  view.rules_version = kHostile;
  view.asked.state = "unsafe";
  Frame frame = sample_frame();
  frame.who = kHostile;
  const std::string html = cohort_page(view, frame);
  const CheckedPage page = check_page(html);
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_EQ(page.all("script").size(), 1U);
  EXPECT_EQ(html.find("<script>"), std::string::npos);
}

TEST(CohortPage, ATraineeInSeveralLinesIsCountedOnce) {
  CohortView view;
  view.lines = {sample_line("bo", {50}, {judged(Flag::kStuck, "older")}),
                sample_line("bo", {50, 50}, {judged(Flag::kStuck, "newer")})};
  view.lines[1].level = "L3";
  const auto who = trainees_in_state(view, Flag::kStuck);
  ASSERT_EQ(who.size(), 1U);
  EXPECT_EQ(who[0]->level, "L3");
}

TEST(CohortPage, RibbonOnlyInTheDemo) {
  Frame frame = sample_frame();
  EXPECT_EQ(check_page(cohort_page(sample_cohort(), frame)).all("div", "ribbon").size(), 0U);
  frame.demo = true;
  EXPECT_EQ(check_page(cohort_page(sample_cohort(), frame)).all("div", "ribbon").size(), 1U);
}

TEST(CohortCsv, OneLineEachInTheOrderShown) {
  CohortView view;
  view.rules_version = "1";
  view.lines = {sample_line("bo", {50, 0.1 + 0.2}, {judged(Flag::kStuck, "5 tries, \"none\" passed")}),
                sample_line("=cmd|x", {}, {})};
  const std::string csv = cohort_csv(view);
  EXPECT_EQ(csv,
            "trainee,name,exercise,level,input,tries,best,last,pass_at,peak_force_n,over_force,last_utc,states,"
            "evidence,n,decided,reliability,rules\r\n"
            "bo,,surface-touch,L2,mouse,2,50,0.30000000000000004,75,,0,2026-03-12T09:30:00Z,stuck,\"5 tries, "
            "\"\"none\"\" passed\",5,0,,1\r\n"
            "'=cmd|x,,surface-touch,L2,mouse,0,,,75,,0,2026-03-10T09:30:00Z,,,0,0,,1\r\n");
}

TEST(Spark, PassLineAndPointsShareTheScale) {
  // 34 high, 3 margin: 40 at the bottom (31), 100 at the top (3), 75 at 31 - 28 * 35 / 60.
  const std::string svg = spark_svg({40, 100}, 75);
  EXPECT_NE(svg.find("points=\"3.0,31.0 115.0,3.0 \""), std::string::npos) << svg;
  EXPECT_NE(svg.find("y1=\"14.7\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("aria-label=\"last 2 scores, from 40 to 100\""), std::string::npos);
  EXPECT_EQ(spark_svg({}, 75).find("<circle"), std::string::npos);
  // A lower score widens the scale: 20 at the bottom.
  EXPECT_NE(spark_svg({20, 60}, 75).find("points=\"3.0,31.0 115.0,17.0 \""), std::string::npos);
}

}  // namespace
}  // namespace trocar::review::cohort_page_test
