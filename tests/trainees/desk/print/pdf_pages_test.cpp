// The pages themselves: where things land, how wide words are, what a picture or a chart takes.
#include "trainees/desk/print/pdf_pages.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "haptics/input_error.h"
#include "tests/trainees/desk/print/pdf_reader.h"

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
  pages.text(100, 200, "left", plain(12), kInk);
  pages.text(400, 300, "right", bold(12), kInk, Side::kRight);
  pages.text(300, 400, "middle", mono(12), kInk, Side::kMiddle);
  const double middle = pages.lines("middle", mono(12)).width();
  const std::string bytes = pages.bytes();
  EXPECT_NEAR(box_of(bytes, "left").x0, 100, 0.5);
  EXPECT_LT(box_of(bytes, "left").y0, 200);
  EXPECT_GT(box_of(bytes, "left").y1, 200) << "the base line is there, from the top down";
  EXPECT_NEAR(box_of(bytes, "right").x1, 400, 0.5);
  EXPECT_NEAR(box_of(bytes, "middle").x0, 300 - 0.5 * middle, 0.5);
  EXPECT_NEAR(box_of(bytes, "middle").x1 - box_of(bytes, "middle").x0, middle, 0.5);
}

TEST(PdfPages, WidthsGrowWithSizeAndAddUp) {
  const PdfPages pages("t", "");
  const auto width_of = [&](const char* words, const Font& font) { return pages.lines(words, font).width(); };
  constexpr double kUnit = 1.0 / 1024;  // Pango's, to which each letter is rounded
  const double one = width_of("n", plain(10));
  EXPECT_GT(one, 4);
  EXPECT_LT(one, 10);
  EXPECT_NEAR(width_of("nnnn", plain(10)), 4 * one, 4 * kUnit);
  EXPECT_NEAR(width_of("n", plain(20)), 2 * one, 2 * kUnit);
  EXPECT_NEAR(width_of("i", mono(10)), width_of("W", mono(10)), kUnit);
  EXPECT_GT(width_of("n", bold(10)), one);
  EXPECT_NEAR(width_of("\xC3\xBC", plain(10)), width_of("u", plain(10)), kUnit) << "a letter, not two bytes";
  EXPECT_EQ(width_of("", plain(10)), 0);
  EXPECT_NEAR(pages.width_of_word("a nn nnnn", plain(10)), 4 * one, 4 * kUnit);
}

/// What stands in the file of those words alone.
std::string said(const std::string& words, double width, int most = 0) {
  PdfPages pages("t", "");
  pages.add();
  pages.text(50, 100, pages.lines(words, mono(10), width, most), kInk);
  return squeezed(read_pdf(pages.bytes()).pages.at(0));
}

TEST(PdfPages, WordsWrapAndALineEndStays) {
  const PdfPages pages("t", "");
  const double letter = pages.lines("n", mono(10)).width();
  const auto count = [&](const std::string& words, int letters) {
    const Lines lines = pages.lines(words, mono(10), letter * letters + 0.1);
    EXPECT_LE(lines.width(), letter * letters + 0.1) << words;
    return lines.count();
  };
  EXPECT_EQ(count("", 9), 1);
  EXPECT_EQ(count("one two three four", 9), 3);
  EXPECT_EQ(count("one\ntwo three", 20), 2);
  EXPECT_EQ(count("ab abcdefghij", 4), 4) << "a word longer than a line is broken";
  EXPECT_EQ(count("\xC3\xBC\xC3\xBC\xC3\xBC\xC3\xBC\xC3\xBC", 2), 3) << "between letters";
  EXPECT_EQ(said("abcdefghij", 4 * letter + 0.1), "abcd efgh ij ") << "no hyphen comes in";
  EXPECT_NEAR(pages.lines("one two three", mono(10), 9 * letter).height(), 2 * 13.6, 1e-9);
}

TEST(PdfPages, TooManyLinesEndWithAnEllipsisThatFits) {
  const double four = 4 * PdfPages("t", "").lines("n", mono(10)).width() + 0.1;
  EXPECT_EQ(said("aaaa bbbb cccc dddd", four, 2), "aaaa bbb\xE2\x80\xA6 ");
  EXPECT_EQ(said("aaaa bb cccc", four, 2), "aaaa bb\xE2\x80\xA6 ");
  EXPECT_EQ(said("aaaa bbbb", four, 2), "aaaa bbbb ") << "nothing was left out";
  EXPECT_EQ(said("abcdefgh", four, 1), "abc\xE2\x80\xA6 ");
  EXPECT_EQ(said("a\nb\nc", four, 1), "a\xE2\x80\xA6 ");
  EXPECT_EQ(said("abc", 0.1, 1), "\xE2\x80\xA6 ");
}

TEST(PdfPages, BytesThatAreNoTextAreMadeSound) {
  EXPECT_EQ(said("a\tb\x01"
                 "c\x7F"
                 "d",
                 0),
            "a b c d ");
  for (const std::string& broken : {std::string("\xC3\x28"), std::string("\xC0\xAF"), std::string("\xED\xA0\x80"),
                                    std::string("cut\xE2\x82"), std::string("a\0b", 3)})
    EXPECT_NE(said(broken + " end", 0).find("\xEF\xBF\xBD"), std::string::npos) << broken;
}

TEST(PdfPagesDeathTest, AMissingFontIsNamed) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";  // in a process of its own, which has looked for no font yet
  EXPECT_EXIT(
      {
        const auto file = std::filesystem::temp_directory_path() / "trocar_no_fonts.conf";
        std::ofstream(file) << "<fontconfig/>";
        setenv("FONTCONFIG_FILE", file.c_str(), 1);
        try {
          PdfPages("t", "");
        } catch (const EnvironmentError& e) {
          std::fprintf(stderr, "%s\n", e.what());
          std::exit(3);
        }
      },
      testing::ExitedWithCode(3), "font DejaVu Sans not found by fontconfig; install fonts-dejavu-core");
}

TEST(PdfPages, AnyPageMayBeDrawnOnAgain) {
  PdfPages pages("t", "");
  pages.add();
  pages.text(100, 100, "first", plain(12), kInk);
  pages.add();
  pages.choose(0);
  pages.text(100, 140, "again", plain(12), kInk);
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
  pages.text(100, 400, "after", plain(12), kInk);
  EXPECT_TRUE(read_pdf(pages.bytes()).holds("after")) << "the file is sound all the same";
}

TEST(PdfPages, APictureCutShortTakesNoRoomAndNoByteOfItDoesHarm) {
  EXPECT_NEAR(shape_of_picture(kPng), 0.5, 1e-9);
  for (std::size_t i = 0; i < kPng.size(); ++i) {
    EXPECT_EQ(shape_of_picture(kPng.substr(0, i)), 0) << "cut at " << i;
    std::string broken = kPng;
    broken[i] = static_cast<char>(broken[i] ^ 0x11);
    EXPECT_TRUE(shape_of_picture(broken) == 0 || i >= kPng.size() - 12) << "byte " << i << ", not of the end's";
  }
  std::string huge = kPng;
  huge[17] = '\x7F';
  EXPECT_EQ(shape_of_picture(huge), 0) << "no room is made for it";
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
  EXPECT_NE(info.find("Title: M\xC3\xBCller \xC5\x81ukasz"), std::string::npos) << info;
  EXPECT_NE(info.find("Creator: Trocar"), std::string::npos);
  for (const char* date : {"", "yesterday", "2026-13-01T00:00:00Z", "2026-02-40", "0001-01-01"}) {
    PdfPages undated("t", date);
    undated.add();
    EXPECT_EQ(read_pdf(undated.bytes()).info.find("CreationDate"), std::string::npos) << date;
  }
}

}  // namespace
}  // namespace trocar::printed::pdf_pages_test
