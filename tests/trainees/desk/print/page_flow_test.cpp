// Blocks on pages: columns stand under their heads, numbers to the right, blocks go on where there is room.
#include "trainees/desk/print/page_flow.h"

#include <gtest/gtest.h>

#include "tests/trainees/desk/print/pdf_reader.h"

namespace trocar::printed::page_flow_test {
namespace {

WordBox box_of(const std::vector<WordBox>& all, const std::string& words) {
  for (const WordBox& box : all)
    if (box.words == words) return box;
  ADD_FAILURE() << words << " is not there";
  return {};
}

class PageFlowTest : public testing::Test {
 protected:
  PdfPages pages_{"t", ""};
  PageFlow flow_{pages_};
};

TEST_F(PageFlowTest, ColumnsStandUnderTheirHeadsAndNumbersToTheRight) {
  put(flow_,
      Table{
          "", {{"Name", 1}, {"Score", 1, true}, {"Words", 2}}, {{"anna", "9.5", "alpha"}, {"otto", "100.25", "beta"}}});
  const auto words = word_boxes(pages_.bytes());
  EXPECT_NEAR(box_of(words, "Name").x0, box_of(words, "anna").x0, 1);
  EXPECT_NEAR(box_of(words, "Words").x0, box_of(words, "beta").x0, 1);
  EXPECT_NEAR(box_of(words, "9.5").x1, box_of(words, "100.25").x1, 0.5);
  EXPECT_NEAR(box_of(words, "9.5").x1, box_of(words, "Score").x1, 0.5);
  EXPECT_GT(box_of(words, "otto").y0, box_of(words, "anna").y0 + 8);
  EXPECT_NEAR(box_of(words, "Words").x0 - box_of(words, "Name").x0, PageFlow::kContent / 2, 1) << "shares 1, 1, 2";
}

TEST_F(PageFlowTest, ACellThatIsFarTooLongEndsWithAnEllipsisAndTheRowFitsAPage) {
  put(flow_, Table{"", {{"Name", 1}, {"Words", 1}}, {{"anna", std::string(20000, 'x')}, {"otto", "beta"}}});
  const ReadPdf pdf = read_pdf(pages_.bytes());
  EXPECT_EQ(pdf.pages.size(), 1U);
  EXPECT_TRUE(pdf.holds("\xE2\x80\xA6"));
  EXPECT_TRUE(pdf.holds("otto"));
}

TEST_F(PageFlowTest, FactsStandSideBySideAndLongOnesWrap) {
  put(flow_, Facts{{{"One", "first"},
                    {"Two", "second"},
                    {"Three", "19 Sep 2026 to 20 Nov 2026 and a good deal longer"},
                    {"Four", "fourth"},
                    {"Five", "fifth"}},
                   4,
                   false});
  const auto words = word_boxes(pages_.bytes());
  EXPECT_NEAR(box_of(words, "first").y0, box_of(words, "fourth").y0, 0.5);
  EXPECT_NEAR(box_of(words, "Four").x0 - box_of(words, "One").x0, 0.75 * PageFlow::kContent, 1);
  EXPECT_GT(box_of(words, "Five").y0, box_of(words, "longer").y1) << "the next row begins under the longest";
}

TEST_F(PageFlowTest, AFigureThatDoesNotFitGoesToTheNextPageWhole) {
  flow_.down(500);
  put(flow_,
      Figures{
          {{"<svg viewBox=\"0 0 100 60\"><text x=\"5\" y=\"5\">top</text><text x=\"5\" y=\"59\">bottom</text></svg>",
            "caption", 1}}});
  const auto words = word_boxes(pages_.bytes());
  EXPECT_EQ(box_of(words, "top").page, 1);
  EXPECT_EQ(box_of(words, "bottom").page, 1);
  EXPECT_GT(box_of(words, "caption").y0, box_of(words, "bottom").y0);
}

TEST_F(PageFlowTest, FiguresSideBySideShareTheWidth) {
  const std::string svg = "<svg viewBox=\"0 0 100 100\"><text x=\"0\" y=\"50\">mark</text></svg>";
  put(flow_, Figures{{{svg, "left", 0.5}, {svg, "right", 0.5}}});
  const auto words = word_boxes(pages_.bytes());
  EXPECT_NEAR(box_of(words, "left").x0, PageFlow::kLeft, 1);
  EXPECT_GT(box_of(words, "right").x0, 0.5 * PdfPages::kWidth - 10);
  EXPECT_NEAR(box_of(words, "left").y0, box_of(words, "right").y0, 0.5);
}

TEST_F(PageFlowTest, AParagraphLongerThanAPageGoesOn) {
  std::string text;
  for (int i = 0; i < 1500; ++i) text += "word" + std::to_string(i) + " ";
  put(flow_, Paragraph{text});
  const ReadPdf pdf = read_pdf(pages_.bytes());
  EXPECT_GT(pdf.pages.size(), 1U);
  for (int i = 0; i < 1500; i += 50) EXPECT_TRUE(pdf.holds("word" + std::to_string(i) + " ")) << i;
}

TEST_F(PageFlowTest, ANewPageIsNotBegunTwice) {
  put(flow_, Heading{"First", 1, true}, 0);
  EXPECT_EQ(pages_.count(), 1) << "it is at the top already";
  put(flow_, Heading{"Second", 1, true}, 0);
  EXPECT_EQ(pages_.count(), 2);
}

TEST_F(PageFlowTest, AVerdictHoldsWordReasonAndNumber) {
  put(flow_, Verdict{"Not yet", "Safety gate not met. In band: 0.58 (full at 1, none at 0.3).", "58.0",
                     "of 100, pass 75", Tone::kBad});
  const auto words = word_boxes(pages_.bytes());
  EXPECT_LT(box_of(words, "Not").x1, box_of(words, "Safety").x0);
  EXPECT_LT(box_of(words, "Safety").x1, box_of(words, "58.0").x0);
  EXPECT_NEAR(box_of(words, "58.0").x1, box_of(words, "75").x1, 1);
}

TEST(Tones, DifferInColour) {
  EXPECT_NE(colour_of(Tone::kGood), colour_of(Tone::kBad));
  EXPECT_NE(colour_of(Tone::kPlain), colour_of(Tone::kQuiet));
}

}  // namespace
}  // namespace trocar::printed::page_flow_test
