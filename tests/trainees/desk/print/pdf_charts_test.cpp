// Charts on a page: every one of the desk's is drawn as lines and text, and no chart brings anything else along.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/trainees/desk/pages/page_samples.h"
#include "tests/trainees/desk/print/pdf_reader.h"
#include "trainees/desk/pages/charts.h"
#include "trainees/desk/print/pdf_pages.h"
#include "trainees/desk/reports/reports.h"
#include "trainees/markup/svg.h"

namespace trocar::printed::pdf_charts_test {
namespace {

/// The file of a page with that chart alone, as wide as the page's words are. @param height of the chart.
std::string page_of(const std::string& svg, double& height) {
  PdfPages pages("t", "");
  pages.add();
  height = pages.chart(svg, 46, 66, 500);
  EXPECT_EQ(height, pages.height_of_chart(svg, 500));
  return pages.bytes();
}

std::size_t count_of(const std::string& text, const std::string& piece) {
  std::size_t out = 0;
  for (std::size_t at = 0; (at = text.find(piece, at)) != std::string::npos; at += piece.size()) ++out;
  return out;
}

/// Bytes of a page beside those of its words' fonts: what is drawn on it.
std::size_t drawn_bytes(const std::string& inner) {
  double height = 0;
  return page_of("<svg viewBox=\"0 0 200 100\">" + inner + "</svg>", height).size();
}

TEST(PdfCharts, EveryChartOfTheDeskIsDrawn) {
  const review::TraineeView trainee = review::sample_trainee();
  const review::AttemptView attempt = review::sample_attempt();
  review::TimePlot plot;
  plot.lines = {{&*attempt.trace, false, "tissue force", "#1d2630", ""},
                {&*attempt.trace, true, "grip force", "#56b4e9", "6 2"}};
  plot.limits = attempt.limits;
  plot.events = attempt.result.events;
  plot.cursor_s = 3;
  plot.moment_href_html = "?t=";
  const review::CurveView& curve = trainee.curves.at(0);
  for (const auto& [svg, words] : std::vector<std::pair<std::string, std::string>>{
           {review::curve_svg(curve), "bench 88.5"},
           {review::cusum_svg(curve), "0"},
           {review::weeks_svg(trainee.minutes_by_week), "to 16 Mar 2026"},
           {review::time_plot_svg(plot), "grip force"},
           {review::path_svg(*attempt.trace, review::kFromAbove, attempt.limits, 12), "mm"},
           {review::heat_svg(*attempt.trace, review::kFromSide, true), "mm"},
           {review::spark_svg({40, 60, 80}, 75), ""},
           {review::score_bands_svg({{"Surface touch L2", {50, 60, 70}, 75, 88.5}}), "Surface touch L2"}}) {
    double height = 0;
    const std::string bytes = page_of(svg, height);
    EXPECT_GT(height, 0) << svg.substr(0, 80);
    EXPECT_TRUE(read_pdf(bytes).holds(words)) << svg.substr(0, 80);
    EXPECT_EQ(outside(bytes, 40), std::vector<std::string>{}) << svg.substr(0, 80);
    EXPECT_EQ(bytes.find("/Subtype /Image"), std::string::npos) << "lines, not pixels: " << svg.substr(0, 80);
    EXPECT_EQ(bytes.find("/URI"), std::string::npos) << "a link on paper: " << svg.substr(0, 80);
  }
}

TEST(PdfCharts, WordsAreScaledToBeReadAndPlaced) {
  PdfPages pages("t", "");
  pages.add();
  const std::string svg =
      "<svg viewBox=\"0 0 1000 500\"><text x=\"500\" y=\"250\" text-anchor=\"middle\">centre</text><g "
      "transform=\"translate(100 0)\"><text x=\"800\" y=\"400\" text-anchor=\"end\" "
      "font-weight=\"bold\">&lt;ends&gt;</text></g></svg>";
  EXPECT_NEAR(pages.chart(svg, 100, 100, 200), 100, 1e-6);
  const std::vector<WordBox> words = word_boxes(pages.bytes());
  ASSERT_EQ(words.size(), 2U);
  EXPECT_NEAR(0.5 * (words[0].x0 + words[0].x1), 200, 0.5);
  EXPECT_NEAR(words[1].x1, 280, 0.5);
  EXPECT_GT(words[0].y1 - words[0].y0, 6) << "not shrunk to 2.8 points";
}

TEST(PdfCharts, WhatIsBrokenTakesNoRoom) {
  for (const char* svg : {"", "words", "<svg viewBox=\"0 0 9 9\">", "<svg viewBox=\"0 0 9 9\"><line </svg>",
                          "<svg></svg>", "<svg viewBox=\"0 0 9 0\"></svg>", "<svg viewBox=\"0 0 0 9\"></svg>",
                          "<svg viewBox=\"0 0 1 1e9\"></svg>", "<svg viewBox=\"0 0 nan inf\"></svg>"}) {
    double height = 1;
    EXPECT_EQ(read_pdf(page_of(svg, height)).pages.size(), 1U) << svg;
    EXPECT_EQ(height, 0) << svg;
  }
}

TEST(PdfCharts, NumbersThatAreNoneDrawNothingWild) {
  const std::size_t empty = drawn_bytes("");
  for (const char* inner :
       {"<circle cx=\"nan\" cy=\"inf\" r=\"1\" fill=\"#000\"/>", "<polyline points=\"\" stroke=\"#000\"/>",
        "<polyline points=\"1,1\" fill=\"none\" stroke=\"#000\"/>", "<rect width=\"-1\" height=\"1e400\"/>",
        "<line x1=\"1\" y1=\"1\" x2=\"1e300\" y2=\"2\" stroke=\"#000\" transform=\"scale(0)\"/>"})
    EXPECT_LT(drawn_bytes(inner), empty + 400) << inner;
}

TEST(PdfCharts, NothingOutsideAChartIsReadOrAsked) {
  const std::filesystem::path secret = std::filesystem::temp_directory_path() / "trocar_pdf_charts_secret.svg";
  std::ofstream(secret) << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 9 9\"><text id=\"t\" "
                           "y=\"5\">secret</text></svg>";
  const std::string url = "file://" + secret.string();
  double height = 0;
  for (const std::string& inner :
       {"<image href=\"" + url + "\" width=\"90\" height=\"90\"/>", "<use href=\"" + url + "#t\"/>",
        "<xi:include xmlns:xi=\"http://www.w3.org/2001/XInclude\" href=\"" + url + "\" parse=\"text\"/>",
        "<style>@import url('" + url + "');</style>", "<text y=\"20\" style=\"font-family:url(" + url + ")\">a</text>"})
    EXPECT_FALSE(read_pdf(page_of("<svg viewBox=\"0 0 200 100\">" + inner + "</svg>", height)).holds("secret"))
        << inner;
  const std::string entity = "<!DOCTYPE svg [<!ENTITY e SYSTEM \"" + url +
                             "\">]><svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 200 100\"><text "
                             "y=\"20\">&e;</text></svg>";
  EXPECT_FALSE(read_pdf(page_of(entity, height)).holds("secret"));
  std::filesystem::remove(secret);
}

TEST(PdfCharts, WordsThatGrowWithoutEndAreGivenUp) {
  std::string svg = "<!DOCTYPE svg [<!ENTITY a0 \"words words words words\">";
  for (int i = 1; i < 12; ++i) {
    svg += "<!ENTITY a" + std::to_string(i) + " \"";
    for (int k = 0; k < 10; ++k) svg += "&a" + std::to_string(i - 1) + ";";
    svg += "\">";
  }
  double height = 0;
  page_of(svg + "]><svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 200 100\"><text>&a11;</text></svg>", height);
  EXPECT_EQ(height, 0);
}

TEST(PdfCharts, AFileByItselfHasNoLinks) {
  const std::string chart = review::curve_svg(review::sample_trainee().curves.at(0));
  const std::string svg = svg::without_links(chart);
  EXPECT_NE(chart.find("href"), std::string::npos);
  EXPECT_EQ(svg.find("href"), std::string::npos);
  EXPECT_EQ(svg.find("<a "), std::string::npos);
  EXPECT_EQ(count_of(svg, "</g>"), count_of(svg, "<g"));
  EXPECT_EQ(svg::without_links("<svg><a><b/></a><abc/></svg>"), "<svg><g><b/></g><abc/></svg>");
  EXPECT_EQ(svg::without_links("<svg><a href=\"x"), "<svg><g");
}

}  // namespace
}  // namespace trocar::printed::pdf_charts_test
