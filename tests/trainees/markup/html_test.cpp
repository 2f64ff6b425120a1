#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "trainees/markup/html.h"

namespace trocar::html_test {
namespace {

TEST(EscapeHtml, ReplacesEveryActiveCharacter) {
  EXPECT_EQ(escape_html("<a href=\"x\">'&'</a>"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
}

TEST(EscapeHtml, KeepsWellFormedUtf8AndReplacesTheRest) {
  EXPECT_EQ(escape_html("J\u00f6rg \u20ac \U0001F600"), "J\u00f6rg \u20ac \U0001F600");
  for (const char* bad : {"\xFF", "\xC0\x80", "\xED\xA0\x80", "\xE2\x82", "\x01", "\x7F", "\xF5\x80\x80\x80"}) {
    const std::string out = escape_html(bad);
    EXPECT_EQ(out.find(bad), std::string::npos);
    EXPECT_NE(out.find("\xEF\xBF\xBD"), std::string::npos);
  }
  EXPECT_EQ(escape_html("a\tb\nc"), "a\tb\nc");
}

TEST(NumberText, GivesFourDigitsWithoutIdleZeros) {
  EXPECT_EQ(number_text(5), "5");
  EXPECT_EQ(number_text(1.5), "1.5");
  EXPECT_EQ(number_text(0.12345), "0.1235");
  EXPECT_EQ(number_text(1234.6), "1235");
  EXPECT_EQ(number_text(100), "100");
  EXPECT_EQ(number_text(-0.00001), "-1e-05");
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(std::nan("")), "n/a");
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity()), "n/a");
  EXPECT_EQ(fixed_text(-0.001, 1), "0.0");
  EXPECT_EQ(fixed_text(-0.26, 1), "-0.3");
}

TEST(QuantityText, ShowsLengthsInMillimetresAndUndefinedAsSuch) {
  EXPECT_EQ(quantity_text(0.612, "m"), "612 mm");
  EXPECT_EQ(quantity_text(0.031, "m/s"), "31 mm/s");
  EXPECT_EQ(quantity_text(3, "count"), "3");
  EXPECT_EQ(quantity_text(2.5, "N"), "2.5 N");
  EXPECT_EQ(quantity_text(std::nullopt, "N"), "undefined");
}

TEST(Base64, AgreesWithTheVectorsOfRfc4648) {
  const std::vector<std::pair<std::string, std::string>> vectors = {{"", ""},
                                                                    {"f", "Zg=="},
                                                                    {"fo", "Zm8="},
                                                                    {"foo", "Zm9v"},
                                                                    {"foob", "Zm9vYg=="},
                                                                    {"fooba", "Zm9vYmE="},
                                                                    {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, coded] : vectors)
    EXPECT_EQ(base64({reinterpret_cast<const unsigned char*>(plain.data()), plain.size()}), coded);
}

TEST(WordsOf, TurnsIdentifiersIntoWords) {
  EXPECT_EQ(words_of("TARGET_HELD"), "Target held");
  EXPECT_EQ(words_of("time_in_band"), "Time in band");
  EXPECT_EQ(words_of(""), "");
}

}  // namespace
}  // namespace trocar::html_test
