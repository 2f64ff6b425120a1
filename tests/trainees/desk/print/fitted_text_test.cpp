// Wrapping with a font that is one wide for every character, so that what fits can be counted.
#include "trainees/desk/print/fitted_text.h"

#include <gtest/gtest.h>

namespace trocar::printed::fitted_text_test {
namespace {

double characters(const std::string& text) {
  double out = 0;
  for (const char c : text) out += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
  return out;
}

using Lines = std::vector<std::string>;

TEST(FittedText, WrapsAtSpacesAndKeepsEveryWord) {
  EXPECT_EQ(wrapped("one two three four", 9, characters), (Lines{"one two", "three", "four"}));
  EXPECT_EQ(wrapped("one", 9, characters), Lines{"one"});
  EXPECT_EQ(wrapped("", 9, characters), Lines{""});
  EXPECT_EQ(wrapped("  a   b ", 9, characters), Lines{"a b"});
}

TEST(FittedText, ALineEndStays) { EXPECT_EQ(wrapped("one\ntwo three", 20, characters), (Lines{"one", "two three"})); }

TEST(FittedText, AWordLongerThanALineIsBrokenBetweenCharacters) {
  EXPECT_EQ(wrapped("ab abcdefghij", 4, characters), (Lines{"ab", "abcd", "efgh", "ij"}));
  const Lines lines = wrapped("\xC3\xBC\xC3\xBC\xC3\xBC\xC3\xBC\xC3\xBC", 2, characters);
  EXPECT_EQ(lines, (Lines{"\xC3\xBC\xC3\xBC", "\xC3\xBC\xC3\xBC", "\xC3\xBC"}));
}

TEST(FittedText, TooManyLinesEndWithAnEllipsisThatFits) {
  const Lines lines = wrapped("aaaa bbbb cccc dddd", 4, characters, 2);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[1], "bbb\xE2\x80\xA6");
  EXPECT_EQ(wrapped("aaaa bb cccc", 4, characters, 2)[1], "bb\xE2\x80\xA6");
  EXPECT_EQ(wrapped("aaaa bbbb", 4, characters, 2)[1], "bbbb") << "nothing was left out";
}

TEST(FittedText, NoLineIsWiderThanItsColumn) {
  const std::string text =
      "Trainee of the \xC5\x81\xC3\xB3"
      "d\xC5\xBA department, honourably-and-unbreakably-hyphenated, n = 16";
  for (double width = 3; width < 40; width += 1)
    for (const std::string& line : wrapped(text, width, characters)) EXPECT_LE(characters(line), width) << line;
}

TEST(FittedText, ShortenedFitsAndCutsNoCharacterInTwo) {
  EXPECT_EQ(shortened("short", 9, characters), "short");
  EXPECT_EQ(shortened("abcdefgh", 4, characters), "abc\xE2\x80\xA6");
  EXPECT_EQ(shortened("a \xC3\xBC\xC3\xBC\xC3\xBC", 3, characters), "a\xE2\x80\xA6") << "no space before the ellipsis";
  EXPECT_EQ(shortened("abc", 0, characters), "\xE2\x80\xA6");
}

TEST(FittedText, WhatAFontCannotBeAskedForBecomesABox) {
  constexpr const char* kBox = "\xE2\x96\xA1";
  EXPECT_EQ(printable("M\xC3\xBCller, \xC5\x81ukasz, Ng\xC3\xB4"), "M\xC3\xBCller, \xC5\x81ukasz, Ng\xC3\xB4");
  EXPECT_EQ(printable("a\tb\x01"
                      "c\x7F"
                      "d"),
            "a b c d");
  EXPECT_EQ(printable("line\nline"), "line\nline");
  EXPECT_EQ(printable("\xF0\x9F\x98\x80"), kBox) << "beyond the first plane: one box";
  EXPECT_EQ(printable("\xC3\x28"), std::string(kBox) + "(");
  EXPECT_EQ(printable("\xC0\xAF"), std::string(kBox) + kBox) << "overlong";
  EXPECT_EQ(printable("\xED\xA0\x80").find("\xED"), std::string::npos) << "half of a surrogate pair";
  EXPECT_EQ(printable("cut\xE2\x82"), std::string("cut") + kBox + kBox);
}

}  // namespace
}  // namespace trocar::printed::fitted_text_test
