// The file by itself: read by expat, nothing asked of elsewhere, nothing run, every block in it.
#include <gtest/gtest.h>

#include <expat.h>

#include <regex>

#include "tests/trainees/desk/pages/page_samples.h"
#include "trainees/desk/print/report.h"

namespace trocar::printed::report_html_test {
namespace {

/// Problem of the markup; "" when it is well-formed.
std::string problem_of(const std::string& html) {
  const XML_Parser parser = XML_ParserCreate("UTF-8");
  const bool fine = XML_Parse(parser, html.data(), static_cast<int>(html.size()), XML_TRUE) == XML_STATUS_OK;
  const std::string out = fine ? ""
                               : std::string(XML_ErrorString(XML_GetErrorCode(parser))) + " in line " +
                                     std::to_string(XML_GetCurrentLineNumber(parser));
  XML_ParserFree(parser);
  return out;
}

Report hostile() {
  const std::string evil = review::kHostile;
  Report out;
  out.kind = "Trainee report";
  out.title = out.subtitle = out.who = evil;
  out.newest_utc = "2026-03-19T09:30:00Z";
  out.mark = "DEMO";
  out.blocks = {
      Heading{evil, 1, true},
      Paragraph{evil, Tone::kBad, true},
      Facts{{{evil, evil}}, 2, true},
      Table{evil,
            {{evil, 1, true}, {"Drawn", 1}},
            {{Cell(evil, Tone::kGood), Cell::drawn("<svg class=\"spark\" viewBox=\"0 0 1 1\"><a href=\"/x\"><line "
                                                   "x1=\"0\" stroke=\"#000\"/></a></svg>")}}},
      Table{evil, {}, {}, evil},
      Figures{{{"<svg viewBox=\"0 0 1 1\"></svg>", evil, 0.5}}},
      Picture{"\x89PNG\r\n", evil, 0.5},
      Verdict{evil, evil, evil, evil, Tone::kGood}};
  return out;
}

TEST(ReportHtml, IsWellFormedWhateverIsWritten) {
  const std::string html = html_of(hostile());
  EXPECT_EQ(problem_of(html), "");
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_NE(html.find("&lt;script&gt;alert(1)"), std::string::npos) << "it is shown as text";
}

TEST(ReportHtml, AsksNothingOfAnybody) {
  const std::string html = html_of(hostile());
  EXPECT_FALSE(std::regex_search(html, std::regex("(href|src|action)=\"(?!data:image/png;base64,)")))
      << html.substr(0, 400);
  EXPECT_EQ(html.find("url("), std::string::npos);
  EXPECT_EQ(html.find("@import"), std::string::npos);
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos) << "and the browser is told so";
}

TEST(ReportHtml, HoldsEveryBlock) {
  Report report;
  report.kind = "Cohort report";
  report.title = "Cohort 2026 A";
  report.newest_utc = "2026-03-19T09:30:00Z";
  report.blocks = {Heading{"Part one", 1},
                   Paragraph{"A sentence."},
                   Facts{{{"Tries", "101"}}, 4, false},
                   Table{"Numbers", {{"n", 1, true}}, {{"42"}}},
                   Table{"Due", {{"n", 1}}, {}, "Nothing is due."},
                   Verdict{"Pass", "Nothing lost.", "91.0", "of 100", Tone::kGood}};
  const std::string html = html_of(report);
  for (const char* words :
       {"<h1>Cohort 2026 A</h1>", "<h2>Part one</h2>", "A sentence.", "<dt>Tries</dt><dd>101</dd>",
        "<td class=\"plain n\">42</td>", "Due: Nothing is due.", "Nothing lost.", "record to 19 Mar 2026"})
    EXPECT_NE(html.find(words), std::string::npos) << words;
  EXPECT_EQ(problem_of(html), "");
  EXPECT_EQ(html.find("invented"), std::string::npos);
  EXPECT_EQ(html, html_of(report));
}

TEST(ReportHtml, TheCertificateIsAFileByItselfToo) {
  CertificateSheet sheet;
  sheet.holder = sheet.code = sheet.skill = sheet.statement = sheet.certified_by = sheet.uuid = sheet.withdrawn =
      review::kHostile;
  sheet.facts = {{review::kHostile, review::kHostile}};
  sheet.columns = {{"No.", 1, true}, {"Hash", 1, false, true}};
  sheet.evidence = {{"1", review::kHostile}};
  sheet.not_attested = {review::kHostile};
  const std::string html = html_of(sheet);
  EXPECT_EQ(problem_of(html), "");
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_NE(html.find("What it does not attest"), std::string::npos);
  EXPECT_EQ(html.find("href"), std::string::npos);
}

}  // namespace
}  // namespace trocar::printed::report_html_test
