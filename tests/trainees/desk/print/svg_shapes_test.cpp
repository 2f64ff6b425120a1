// The charts read back: each element's numbers, and that every chart of the desk is one that can be printed.
#include "trainees/desk/print/svg_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/trainees/desk/pages/page_samples.h"
#include "trainees/desk/pages/charts.h"
#include "trainees/desk/reports/reports.h"

namespace trocar::printed::svg_shapes_test {
namespace {

Drawing drawn(const std::string& inner) { return read_svg("<svg viewBox=\"0 0 200 100\">" + inner + "</svg>"); }

Shape one(const std::string& inner) {
  const Drawing drawing = drawn(inner);
  EXPECT_EQ(drawing.shapes.size(), 1U) << inner;
  return drawing.shapes.at(0);
}

TEST(SvgShapes, SizeAndLines) {
  const Drawing drawing = drawn(
      "<line x1=\"1\" y1=\"2\" x2=\"3.5\" y2=\"-4\" stroke=\"#ff8000\" stroke-width=\"2.5\" stroke-dasharray=\"7 "
      "4\"/>");
  EXPECT_EQ(drawing.width, 200);
  EXPECT_EQ(drawing.height, 100);
  const Shape& line = drawing.shapes.at(0);
  ASSERT_EQ(line.runs.at(0).points.size(), 2U);
  EXPECT_EQ(line.runs[0].points[1].x, 3.5);
  EXPECT_EQ(line.runs[0].points[1].y, -4);
  EXPECT_FALSE(line.fill);
  ASSERT_TRUE(line.stroke);
  EXPECT_NEAR((*line.stroke)[1], 128 / 255.0, 1e-12);
  EXPECT_EQ(line.stroke_width, 2.5);
  EXPECT_EQ(line.dash, (std::vector<double>{7, 4}));
}

TEST(SvgShapes, RectanglesCirclesPolylinesAndPolygons) {
  const Shape rect = one("<rect x=\"10\" y=\"20\" width=\"30\" height=\"5\" fill=\"#fff\" fill-opacity=\"0.25\"/>");
  ASSERT_EQ(rect.runs.at(0).points.size(), 4U);
  EXPECT_TRUE(rect.runs[0].closed);
  EXPECT_EQ(rect.runs[0].points[2].x, 40);
  EXPECT_EQ(rect.runs[0].points[2].y, 25);
  EXPECT_EQ(rect.fill_opacity, 0.25);
  EXPECT_EQ(*rect.fill, (Colour{1, 1, 1}));
  const Shape circle = one("<circle r=\"4.5\" cx=\"7\" cy=\"8\" fill=\"none\" stroke=\"#000\"/>");
  EXPECT_EQ(circle.kind, Shape::Kind::kCircle);
  EXPECT_EQ(circle.radius, 4.5);
  EXPECT_EQ(circle.at.y, 8);
  EXPECT_FALSE(circle.fill);
  EXPECT_EQ(one("<polyline points=\"1,2 3,4 5.5,6\" fill=\"none\" stroke=\"#000\"/>").runs.at(0).points.size(), 3U);
  EXPECT_TRUE(one("<polygon points=\"1,2 3,4 5,6\" fill=\"#56b4e9\"/>").runs.at(0).closed);
}

TEST(SvgShapes, PathsOfStraightLines) {
  const Shape triangle = one("<path fill=\"#d55e00\" d=\"M1 2H9L5 -3.5V7Z\"/>");
  ASSERT_EQ(triangle.runs.size(), 1U);
  const auto& points = triangle.runs[0].points;
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points[1].x, 9);
  EXPECT_EQ(points[1].y, 2);
  EXPECT_EQ(points[2].y, -3.5);
  EXPECT_EQ(points[3].x, 5);
  EXPECT_EQ(points[3].y, 7);
  EXPECT_TRUE(triangle.runs[0].closed);
  EXPECT_EQ(one("<path d=\"M0 0L4 4M0 4L4 0\" stroke=\"#555\"/>").runs.size(), 2U) << "a cross";
}

TEST(SvgShapes, WordsAreDecodedAndPlaced) {
  const Shape words =
      one("<text x=\"5\" y=\"6\" text-anchor=\"end\" font-weight=\"bold\" fill=\"#9c4100\">a &lt;b&gt; &amp; "
          "&quot;c&#39;</text>");
  EXPECT_EQ(words.words, "a <b> & \"c'");
  EXPECT_EQ(words.anchor, "end");
  EXPECT_TRUE(words.bold);
  EXPECT_EQ(words.at.x, 5);
}

TEST(SvgShapes, LinksGroupsTitlesAndPatternsLeaveTheirShapesAlone) {
  const Drawing drawing = drawn(
      "<defs><pattern id=\"hatch\"><path d=\"M0 0V8\"/></pattern></defs><a href=\"/x\"><title>attempt 1 &lt; "
      "2</title><circle r=\"1\" "
      "cx=\"1\" "
      "cy=\"1\"/></a><g transform=\"translate(10 2)\"><line x1=\"0\" y1=\"0\" x2=\"1\" y2=\"1\" "
      "stroke=\"#000\"/></g><rect x=\"0\" y=\"0\" "
      "width=\"4\" height=\"4\" fill=\"url(#hatch)\"/>");
  ASSERT_EQ(drawing.shapes.size(), 3U);
  EXPECT_EQ(drawing.shapes[1].runs[0].points[0].x, 10);
  EXPECT_EQ(drawing.shapes[1].runs[0].points[1].y, 3);
  EXPECT_TRUE(drawing.shapes[2].hatched);
  EXPECT_FALSE(drawing.shapes[2].fill);
  EXPECT_EQ(drawing.shapes[2].runs[0].points[0].x, 0) << "the move ended with its group";
}

TEST(SvgShapes, WhatCannotBeDrawnIsRefused) {
  for (const char* inner : {"<ellipse rx=\"2\"/>", "<path d=\"M0 0C1 1 2 2 3 3\"/>", "<line stroke=\"red\"/>",
                            "<g transform=\"rotate(3)\"></g>", "<path d=\"L1 1\"/>", "<rect x='1'/>"})
    EXPECT_THROW(drawn(inner), std::invalid_argument) << inner;
  EXPECT_THROW(read_svg("<svg></svg>"), std::invalid_argument);
  EXPECT_THROW(read_svg("<svg viewBox=\"0 0 1 1\"><line "), std::invalid_argument);
}

TEST(SvgShapes, EveryChartOfTheDeskIsDrawn) {
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
  for (const std::string& svg :
       {review::curve_svg(curve), review::cusum_svg(curve), review::weeks_svg(trainee.minutes_by_week),
        review::time_plot_svg(plot), review::path_svg(*attempt.trace, review::kFromAbove, attempt.limits, 12),
        review::heat_svg(*attempt.trace, review::kFromSide, true), review::spark_svg({40, 60, 80}, 75),
        review::score_bands_svg({{"Surface touch L2", {50, 60, 70}, 75, 88.5}})}) {
    const Drawing drawing = read_svg(svg);
    EXPECT_GT(drawing.shapes.size(), 2U);
    for (const Shape& shape : drawing.shapes)
      for (const Shape::Run& run : shape.runs)
        for (const Point& p : run.points) {
          EXPECT_GE(p.x, -20) << svg.substr(0, 80);
          EXPECT_LE(p.x, drawing.width + 20) << svg.substr(0, 80);
        }
  }
}

TEST(SvgShapes, AllPointsOfACurveAreInIt) {
  const review::CurveView curve = review::sample_trainee().curves.at(0);
  const Drawing drawing = read_svg(review::curve_svg(curve));
  const auto circles = std::count_if(drawing.shapes.begin(), drawing.shapes.end(),
                                     [](const Shape& s) { return s.kind == Shape::Kind::kCircle; });
  EXPECT_EQ(circles, curve.graded) << "a cross stands for the one without a score";
  const auto says = [&](const std::string& words) {
    return std::any_of(drawing.shapes.begin(), drawing.shapes.end(), [&](const Shape& s) { return s.words == words; });
  };
  EXPECT_TRUE(says("pass 75"));
  EXPECT_TRUE(says("bench 88.5"));
}

TEST(SvgShapes, AFileByItselfHasNoLinks) {
  const std::string svg = without_links(review::curve_svg(review::sample_trainee().curves.at(0)));
  EXPECT_EQ(svg.find("href"), std::string::npos);
  EXPECT_EQ(svg.find("<a "), std::string::npos);
  EXPECT_EQ(read_svg(svg).shapes.size(),
            read_svg(review::curve_svg(review::sample_trainee().curves.at(0))).shapes.size());
}

}  // namespace
}  // namespace trocar::printed::svg_shapes_test
