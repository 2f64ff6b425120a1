// The pages themselves: where things land, how wide words are, what a picture or a chart takes.
#include "trainees/desk/print/pdf_pages.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/trainees/desk/print/pdf_reader.h"
#include "trainees/desk/print/png_check.h"

namespace trocar::printed::pdf_pages_test {
namespace {

/// 2 x 1 pixels, RGB: red and blue.
const std::string kPng = [] {
  const unsigned char bytes[] = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
                                 0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00,
                                 0x00, 0x7b, 0x40, 0xe8, 0xdd, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x44, 0x41, 0x54, 0x78,
                                 0x9c, 0x63, 0xf8, 0xcf, 0x00, 0x04, 0xff, 0x01, 0x07, 0x00, 0x01, 0xff, 0xe2, 0x23,
                                 0x9e, 0x59, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  return std::string(reinterpret_cast<const char*>(bytes), sizeof bytes);
}();

WordBox box_of(const std::string& bytes, const std::string& words) {
  for (const WordBox& box : word_boxes(bytes))
    if (box.words == words) return box;
  ADD_FAILURE() << words << " is not on the page";
  return {};
}

TEST(PdfPages, WordsLandWhereTheyWerePut) {
  PdfPages pages("t", "");
  pages.add();
  pages.text(100, 200, "left", Face::kPlain, 12, kInk);
  pages.text_right(400, 300, "right", Face::kBold, 12, kInk);
  pages.text_middle(300, 400, "middle", Face::kMono, 12, kInk);
  const double middle = pages.width_of("middle", Face::kMono, 12);
  const std::string bytes = pages.bytes();
  EXPECT_NEAR(box_of(bytes, "left").x0, 100, 0.5);
  EXPECT_LT(box_of(bytes, "left").y0, 200);
  EXPECT_GT(box_of(bytes, "left").y1, 200) << "the base line is there, from the top down";
  EXPECT_NEAR(box_of(bytes, "right").x1, 400, 0.5);
  EXPECT_NEAR(box_of(bytes, "middle").x0, 300 - 0.5 * middle, 0.5);
  EXPECT_NEAR(box_of(bytes, "middle").x1 - box_of(bytes, "middle").x0, middle, 0.5);
}

TEST(PdfPages, WidthsGrowWithSizeAndAddUp) {
  PdfPages pages("t", "");
  const double one = pages.width_of("n", Face::kPlain, 10);
  EXPECT_GT(one, 4);
  EXPECT_LT(one, 10);
  EXPECT_NEAR(pages.width_of("nnnn", Face::kPlain, 10), 4 * one, 1e-6);
  EXPECT_NEAR(pages.width_of("n", Face::kPlain, 20), 2 * one, 1e-6);
  EXPECT_NEAR(pages.width_of("i", Face::kMono, 10), pages.width_of("W", Face::kMono, 10), 1e-9);
  EXPECT_GT(pages.width_of("n", Face::kBold, 10), one);
  EXPECT_NEAR(pages.width_of("\xC3\xBC", Face::kPlain, 10), pages.width_of("u", Face::kPlain, 10), 1e-6)
      << "a letter, not two bytes";
  EXPECT_EQ(pages.width_of("", Face::kPlain, 10), 0);
  EXPECT_EQ(pages.measure(Face::kPlain, 10)("n"), one);
}

TEST(PdfPages, AnyPageMayBeDrawnOnAgain) {
  PdfPages pages("t", "");
  pages.add();
  pages.text(100, 100, "first", Face::kPlain, 12, kInk);
  pages.add();
  pages.choose(0);
  pages.text(100, 140, "again", Face::kPlain, 12, kInk);
  EXPECT_EQ(pages.count(), 2);
  const std::string bytes = pages.bytes();
  EXPECT_EQ(box_of(bytes, "again").page, 0);
  EXPECT_THROW(pages.choose(2), std::out_of_range);
}

TEST(PdfPages, APictureKeepsItsShapeAndABrokenOneTakesNoRoom) {
  PdfPages pages("t", "");
  pages.add();
  EXPECT_NEAR(pages.height_of_picture(kPng, 300), 150, 1e-3);
  EXPECT_NEAR(pages.picture(kPng, 50, 50, 300), 150, 1e-3);
  EXPECT_EQ(pages.picture("\x89PNG\r\n\x1a\n broken", 50, 50, 300), 0);
  EXPECT_EQ(pages.picture("", 50, 50, 300), 0);
  pages.text(100, 400, "after", Face::kPlain, 12, kInk);
  EXPECT_TRUE(read_pdf(pages.bytes()).holds("after")) << "the file is sound all the same";
}

TEST(PngCheck, OneWrongByteAnywhereIsFound) {
  EXPECT_TRUE(whole_png(kPng));
  for (std::size_t i = 0; i < kPng.size(); ++i) {
    std::string broken = kPng;
    broken[i] = static_cast<char>(broken[i] ^ 0x11);
    EXPECT_FALSE(whole_png(broken)) << "byte " << i;
    EXPECT_FALSE(whole_png(kPng.substr(0, i))) << "cut at " << i;
  }
  EXPECT_FALSE(whole_png(kPng + "x"));
  EXPECT_FALSE(whole_png(""));
}

TEST(PdfPages, AChartIsScaledToItsWidthWithWordsThatCanBeRead) {
  PdfPages pages("t", "");
  pages.add();
  const std::string svg =
      "<svg viewBox=\"0 0 1000 500\"><text x=\"500\" y=\"250\" text-anchor=\"middle\">centre</text>"
      "<text x=\"900\" y=\"400\" text-anchor=\"end\" font-weight=\"bold\">ends</text></svg>";
  EXPECT_NEAR(pages.chart(svg, 100, 100, 200), 100, 1e-6);
  const std::string bytes = pages.bytes();
  const WordBox centre = box_of(bytes, "centre"), ends = box_of(bytes, "ends");
  EXPECT_NEAR(0.5 * (centre.x0 + centre.x1), 200, 0.5);
  EXPECT_NEAR(ends.x1, 280, 0.5);
  EXPECT_GT(centre.y1 - centre.y0, 6) << "not shrunk to 2.8 points";
  EXPECT_THROW(pages.chart("<svg viewBox=\"0 0 9 9\"><image/></svg>", 0, 0, 10), std::invalid_argument);
}

TEST(PdfPages, TheStampLiesAcrossThePage) {
  PdfPages pages("t", "");
  pages.add();
  pages.stamp("WITHDRAWN", kRed);
  double x0 = 1e9, x1 = 0, y0 = 1e9, y1 = 0;
  for (const WordBox& box : word_boxes(pages.bytes())) {
    x0 = std::min(x0, box.x0);
    x1 = std::max(x1, box.x1);
    y0 = std::min(y0, box.y0);
    y1 = std::max(y1, box.y1);
  }
  EXPECT_GT(x1 - x0, 300);
  EXPECT_GT(y1 - y0, 300);
  EXPECT_GE(x0, 0);
  EXPECT_LE(x1, PdfPages::kWidth);
  EXPECT_GE(y0, 0);
  EXPECT_LE(y1, PdfPages::kHeight);
}

TEST(PdfPages, PropertiesAreReadable) {
  PdfPages pages("M\xC3\xBCller \xC5\x81ukasz\n", "2026-03-01T10:00:00Z");
  pages.add();
  const std::string info = squeezed(read_pdf(pages.bytes()).info);
  EXPECT_NE(info.find("Title: M\xC3\xBCller ?ukasz"), std::string::npos) << info;
  EXPECT_NE(info.find("Creator: Trocar"), std::string::npos);
  for (const char* date : {"", "yesterday", "2026-13-01T00:00:00Z", "2026-02-40", "0001-01-01"}) {
    PdfPages undated("t", date);
    undated.add();
    EXPECT_EQ(read_pdf(undated.bytes()).info.find("CreationDate"), std::string::npos) << date;
  }
}

TEST(PdfPages, NumbersThatAreNoneDrawNothingWild) {
  PdfPages pages("t", "");
  pages.add();
  pages.chart(
      "<svg viewBox=\"0 0 10 10\"><circle cx=\"nan\" cy=\"inf\" r=\"1\" fill=\"#000\"/><polyline points=\"\" "
      "fill=\"none\" "
      "stroke=\"#000\"/>"
      "<polyline points=\"1,1\" fill=\"none\" stroke=\"#000\"/><line x1=\"1\" y1=\"1\" x2=\"nan\" y2=\"2\" "
      "stroke=\"#000\"/></svg>",
      50, 50, 100);
  EXPECT_EQ(read_pdf(pages.bytes()).pages.size(), 1U);
}

}  // namespace
}  // namespace trocar::printed::pdf_pages_test
