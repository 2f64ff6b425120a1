// Curriculum, station, messages, style, script, and what all pages share.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "tests/trainees/desk/pages/page_checker.h"
#include "tests/trainees/desk/pages/page_samples.h"
#include "trainees/desk/assets/assets.h"

namespace trocar::review::desk_pages_test {
namespace {

TEST(CurriculumPage, EditorVersionsBenchmarksGroups) {
  const CheckedPage page = check_page(curriculum_page(sample_curriculum(), sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_NE(page.by_id("cur-toml")->text.find("passes_to_unlock = 4"), std::string::npos);
  EXPECT_NE(page.by_id("versions")->text.find("standard22 Mar 2026, 10:00ines"), std::string::npos)
      << page.by_id("versions")->text;
  const std::string editor = page.by_id("editor")->text, benchmarks = page.by_id("benchmarks")->text,
                    groups = page.by_id("groups")->text;
  EXPECT_NE(editor.find("1 of 2 would pass today; 2 pass as it stands. Nothing is saved yet."), std::string::npos)
      << editor;
  EXPECT_NE(benchmarks.find("Score 91.25 from input expert, n = 4, mean 97.25, SD 3."), std::string::npos)
      << benchmarks;
  EXPECT_NE(benchmarks.find("Fewer than 5"), std::string::npos);
  EXPECT_NE(groups.find("2026 A 3 trainees"), std::string::npos);
}

TEST(CurriculumPage, FaultsStandOverTheEditorAndTheTextIsKept) {
  CurriculumView view = sample_curriculum();
  view.problem = "standard:3:8: passes_to_unlock: a whole number from 1 to 20";
  view.text = "a\n\"</textarea><script>\n";
  const CheckedPage page = check_page(curriculum_page(view, sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_EQ(page.all("p", "error")[0]->text, view.problem);
  EXPECT_EQ(page.by_id("cur-toml")->text,
            "\n" + view.text);  // the first line break of a textarea is dropped by browsers
}

TEST(CurriculumPage, EmptyHostileAndReadOnly) {
  EXPECT_EQ(check_page(curriculum_page({}, sample_frame())).problems, std::vector<std::string>{});
  CurriculumView view = sample_curriculum();
  view.name = view.text = view.problem = view.saved = kHostile;
  for (Curriculum& c : view.versions) c.name = c.sha256 = c.author = c.utc = kHostile;
  for (Benchmark& b : view.benchmarks) b.exercise_id = b.level = b.metric = b.rule = b.source = b.utc = kHostile;
  for (PassPreview& p : *view.preview) p.trainee = p.exercise = p.level = p.why = kHostile;
  view.proposal->asked = {kHostile, kHostile, kHostile, kHostile, kHostile, kHostile, kHostile};
  view.proposal->source = kHostile;
  view.groups = {{kHostile, {kHostile, kHostile}}};
  view.trainees = view.levels = view.hands = {kHostile};
  view.exercises = {{kHostile, kHostile}};
  EXPECT_EQ(check_page(curriculum_page(view, sample_frame())).problems, std::vector<std::string>{});
  Frame reader = sample_frame();
  reader.may_write = false;
  EXPECT_EQ(check_page(curriculum_page(view, reader)).all("form").size(), 1U);  // signing out
  view.proposal->problem = "At least three people are needed";
  EXPECT_NE(curriculum_page(view, sample_frame()).find("At least three people"), std::string::npos);
}

TEST(MessagePage, SaysItEscaped) {
  const CheckedPage page = check_page(message_page("Not found", kHostile, sample_frame()));
  EXPECT_EQ(page.problems, std::vector<std::string>{});
  EXPECT_EQ(page.all("h1")[0]->text, "Not found");
}

TEST(Frame, NavigationOfATraineeLeadsToOwnPageOnly) {
  Frame frame = sample_frame();
  frame.own_code = "a b/../c";
  const CheckedPage page = check_page(message_page("x", "y", frame));
  const auto links = page.all("nav");
  ASSERT_EQ(links.size(), 1U);
  EXPECT_EQ(links[0]->text, "My page");
  bool found = false;
  for (const PageElement* link : page.all("a")) found = found || link->of("href") == "/trainee/a%20b%2F..%2Fc";
  EXPECT_TRUE(found);
}

TEST(Frame, WordsForDatesTimesNumbers) {
  EXPECT_EQ(date_html("2026-03-01T09:05:59Z"), "<time datetime=\"2026-03-01T09:05:59Z\">1 Mar 2026, 09:05</time>");
  EXPECT_EQ(day_html("2026-12-31T23:59:59Z"), "<time datetime=\"2026-12-31T23:59:59Z\">31 Dec 2026</time>");
  EXPECT_EQ(date_html("2026-13-01"), "2026-13-01");
  EXPECT_EQ(date_html("soon <b>"), "soon &lt;b&gt;");
  EXPECT_EQ(clock_text(65.4), "1:05");
  EXPECT_EQ(clock_text(59.6), "1:00");
  EXPECT_EQ(clock_text(-1), "n/a");
  EXPECT_EQ(score_text(74.96), "75.0");
  EXPECT_EQ(score_text({}), "\xE2\x80\x93");
  EXPECT_EQ(url_part("a/b?c=d&\"\xC3\xA9"), "a%2Fb%3Fc%3Dd%26%22%C3%A9");
  EXPECT_EQ(query_html({{"a", "1"}, {"b", ""}, {"c", "2 3"}}), "?a=1&amp;c=2%203");
  const AttemptNames nobody = [](const std::string&) { return std::string(); };
  EXPECT_EQ(evidence_html("14 passes", nobody), "<p><small>14 passes</small></p>");
  EXPECT_EQ(evidence_html("[1]", nobody), "<p><small>[1]</small></p>");
  EXPECT_EQ(dated("of 2026-11-30: 1 of 16, 2026-01-02"), "of 30 Nov 2026: 1 of 16, 2 Jan 2026");
  for (const char* kept : {"", "2026-13-01", "12026-11-30", "2026-11-300", "A-2026-11-30", "2026-11-30-b", "2026-11"})
    EXPECT_EQ(dated(kept), kept);
}

TEST(Frame, EveryStateHasItsOwnShapeWordAndStyle) {
  std::vector<std::string> seen;
  for (const Flag flag : {Flag::kUnsafe, Flag::kRelapsed, Flag::kInQuestion, Flag::kStuck, Flag::kPlateau,
                          Flag::kIntegrity, Flag::kRetentionDue, Flag::kReady, Flag::kCertified, Flag::kLearning}) {
    const std::string html = badge(flag);
    EXPECT_EQ(std::find(seen.begin(), seen.end(), html), seen.end());
    seen.push_back(html);
    const std::size_t at = html.find("badge ") + 6;
    const std::string key = html.substr(at, html.find('"', at) - at);
    EXPECT_EQ(state_named(key, Flag::kLearning), flag);
    EXPECT_NE(std::string(style_sheet()).find(".badge." + key + "{"), std::string::npos) << key;
    EXPECT_NE(message_page("x", "y", sample_frame()).find("id=\"s-" + key + "\""), std::string::npos) << key;
  }
}

/// WCAG 2.1: relative luminance of "#rrggbb" or "#rgb".
double luminance(std::string hex) {
  if (hex.size() == 4) hex = {'#', hex[1], hex[1], hex[2], hex[2], hex[3], hex[3]};
  double sum = 0;
  const double weight[] = {0.2126, 0.7152, 0.0722};
  for (int i = 0; i < 3; ++i) {
    const double c = std::stoi(hex.substr(static_cast<std::size_t>(1 + 2 * i), 2), nullptr, 16) / 255.0;
    sum += weight[i] * (c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return sum;
}

double contrast(const std::string& a, const std::string& b) {
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

TEST(Frame, CellsOfAStackedTableSayTheirColumn) {
  const std::string html =
      stacked_table("x", {">No.", "A & b", ""},
                    "<tr><th scope=\"row\">1</th><td class=\"n\">2</td><td>3</td></tr>"
                    "<tr class=\"grave\"><td>4</td><td>5</td></tr><tr><td colspan=\"3\">6</td></tr>",
                    "audit");
  for (const char* part :
       {"<table class=\"stacked audit\">",
        "<th scope=\"row\">1</th><td data-label=\"A &amp; b\" class=\"n\">2</td><td>3</td>",
        "<td data-label=\"No.\">4</td><td data-label=\"A &amp; b\">5</td>", "<td colspan=\"3\">6</td>"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
}

TEST(Style, TextHoldsFourAndAHalfToOne) {
  EXPECT_NEAR(contrast("#000", "#ffffff"), 21, 1e-9);
  EXPECT_NEAR(contrast("#777777", "#ffffff"), 4.48, 0.01);
  const std::string css = style_sheet();
  const std::regex rule(R"(\{([^{}]*)\})"), text(R"((^|;)color:(#[0-9a-f]{3,6}))"),
      ground(R"(background:(#[0-9a-f]{3,6}))");
  int looked_at = 0;
  for (std::sregex_iterator it(css.begin(), css.end(), rule), end; it != end; ++it) {
    const std::string body = (*it)[1];
    std::smatch ink, paper;
    if (!std::regex_search(body, ink, text)) continue;
    const bool own = std::regex_search(body, paper, ground);
    ++looked_at;
    // Without a ground of its own: the page's grey, and for light text the header's dark blue.
    const std::string under = own ? std::string(paper[1]) : luminance(ink[2]) > 0.4 ? "#1d2935" : "#f2f4f6";
    EXPECT_GE(contrast(ink[2], under), 4.5) << body;
  }
  EXPECT_GE(looked_at, 25);
}

TEST(Style, AsksNothingOfOthersAndHasPrintAndPhone) {
  const std::string css = style_sheet();
  for (const char* word : {"http:", "https:", "url(", "@import", "//"})
    EXPECT_EQ(css.find(word), std::string::npos) << word;
  for (const char* word : {"@media print", "max-width:560px", ":focus-visible", ".scroll{overflow-x:auto",
                           ".scroll,.plot{background:linear-gradient", ".stacked tr{display:flex", "attr(data-label)"})
    EXPECT_NE(css.find(word), std::string::npos) << word;
}

TEST(Script, IsSmallAndAsksNothingOfOthers) {
  const std::string script = desk_script();
  EXPECT_LT(script.size(), 10000U);
  for (const char* word : {"http", "eval", "innerHTML", "document.write", "import", "fetch"})
    EXPECT_EQ(script.find(word), std::string::npos) << word;
}

}  // namespace
}  // namespace trocar::review::desk_pages_test
