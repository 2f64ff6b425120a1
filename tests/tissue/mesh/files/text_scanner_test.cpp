#include "tissue/mesh/files/text_scanner.h"

#include <gtest/gtest.h>

#include <clocale>
#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::text_scanner_test {
namespace {

TEST(TextScanner, WordsAndLines) {
  TextScanner text("one  two\r\n\tthree\nrest of it\r\nlast", "f");
  EXPECT_EQ(text.peek(), "one");
  EXPECT_EQ(text.word(), "one");
  EXPECT_EQ(text.word(), "two");
  EXPECT_EQ(text.word(), "three");
  EXPECT_EQ(text.line(), "");
  EXPECT_EQ(text.line(), "rest of it");
  EXPECT_FALSE(text.at_end());
  EXPECT_EQ(text.word(), "last");
  EXPECT_TRUE(text.at_end());
  EXPECT_EQ(text.word(), "");
}

TEST(TextScanner, NumbersAsTheyAreWritten) {
  const std::string words = "1 -2.5 +3 1e3 -1.5E-3 .5 5. 0x10 nan inf 1e400 1e-400 1,5 2abc";
  TextScanner text(words, "f");
  for (const double wanted : {1.0, -2.5, 3.0, 1000.0, -0.0015, 0.5, 5.0}) EXPECT_EQ(text.number("value"), wanted);
  double value = 7;
  for (const char* bad : {"0x10", "nan", "inf", "-inf", "1e400", "1,5", "2abc", "", "-", "e5", "--1", "1e"})
    EXPECT_FALSE(to_number(bad, value)) << bad;
  EXPECT_TRUE(to_number("1e-400", value));
  EXPECT_EQ(value, 0);
}

TEST(TextScanner, WholeNumbersWithinBounds) {
  TextScanner text("7 -1 9 9223372036854775808 1.5", "f.msh");
  EXPECT_EQ(text.whole("count", 0, 10), 7);
  const auto refusal = [&] { return test::message_of<InputError>([&] { text.whole("count", 0, 8); }); };
  EXPECT_CONTAINS(refusal(), "f.msh:1:1: count: \"-1\" is no whole number from 0 to 8");
  EXPECT_CONTAINS(refusal(), "\"9\"");
  EXPECT_CONTAINS(refusal(), "\"9223372036854775808\"");
  EXPECT_CONTAINS(refusal(), "\"1.5\"");
  EXPECT_CONTAINS(refusal(), "the file ends before count");
}

TEST(TextScanner, MessagesCarryTheLine) {
  TextScanner text("a\nb\n\n\nx", "f.off");
  text.word();
  text.word();
  EXPECT_CONTAINS(test::message_of<InputError>([&] { text.number("coordinate"); }), "f.off:5:1: coordinate: \"x\"");
}

TEST(TextScanner, UnprintableWordsAreNotPrinted) {
  const std::string bytes = "\x01\x02\xff" + std::string(500, 'a');
  TextScanner text(bytes, "f");
  const std::string message = test::message_of<InputError>([&] { text.number("value"); });
  EXPECT_LT(message.size(), 160U);
  for (const char letter : message) EXPECT_TRUE(letter >= 32 && letter < 127);
}

TEST(TextScanner, RoundTripOfRandomNumbers) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> drawn(-1e6, 1e6);
  for (int round = 0; round < 1000; ++round) {
    const double wanted = drawn(random);
    char word[64];
    std::snprintf(word, sizeof word, "%.17g", wanted);
    double value = 0;
    ASSERT_TRUE(to_number(word, value));
    EXPECT_EQ(value, wanted);
  }
}

TEST(TextScanner, SkippedBytesAreGone) {
  TextScanner text("HEAD\nbinary!tail", "f");
  text.line();
  EXPECT_EQ(text.rest().substr(0, 7), "binary!");
  text.skip(7);
  EXPECT_EQ(text.word(), "tail");
}

}  // namespace
}  // namespace trocar::text_scanner_test
