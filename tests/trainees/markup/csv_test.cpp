// Fields of CSV: every text comes back through a strict reader, numbers keep their bits, nothing is a formula.
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "tests/trainees/exchange/export/export_samples.h"
#include "trainees/markup/csv.h"

namespace trocar::csv_test {
namespace {

/// What a reader of the file has in hand, with the apostrophes taken away that begin it or follow a semicolon.
std::string read_back(const std::string& text) {
  const std::string field = test::read_csv(csv_line({csv_text(text), "end"})).at(0).at(0);
  std::string out;
  for (std::size_t i = 0; i < field.size(); ++i)
    if (field[i] != '\'' || (i > 0 && field[i - 1] != ';')) out += field[i];
  return out;
}

TEST(CsvText, PlainTextStaysPlain) {
  EXPECT_EQ(csv_text("surface-touch"), "surface-touch");
  EXPECT_EQ(csv_text(""), "");
  EXPECT_EQ(csv_text("a b;c"), "a b;c");
  EXPECT_EQ(csv_text("Ada;=1+1;x"), "Ada;'=1+1;x") << "a cell where spreadsheets divide at semicolons";
  EXPECT_EQ(csv_text("Ü-Test, √2"), "\"Ü-Test, √2\"");
}

TEST(CsvText, QuotesWhatRfc4180AsksFor) {
  EXPECT_EQ(csv_text("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_text("say \"no\""), "\"say \"\"no\"\"\"");
  EXPECT_EQ(csv_text("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csv_text("two\r\nlines"), "\"two\r\nlines\"");
  EXPECT_EQ(csv_text("\""), "\"\"\"\"");
}

TEST(CsvText, DefusesFormulas) {
  EXPECT_EQ(csv_text("=1+1"), "'=1+1");
  EXPECT_EQ(csv_text("+1"), "'+1");
  EXPECT_EQ(csv_text("-1"), "'-1");
  EXPECT_EQ(csv_text("@SUM(A1)"), "'@SUM(A1)");
  EXPECT_EQ(csv_text("\t=1"), "'\t=1");
  EXPECT_EQ(csv_text("\r=1"), "\"'\r=1\"");
  EXPECT_EQ(csv_text("\n=1"), "\"'\n=1\"");
  EXPECT_EQ(csv_text("=HYPERLINK(\"http://x\",\"y\")"), "\"'=HYPERLINK(\"\"http://x\"\",\"\"y\"\")\"");
  EXPECT_EQ(csv_text("a=1"), "a=1") << "only where a spreadsheet would look";
}

TEST(CsvText, ComesBackWhateverItWas) {
  for (const char* text :
       {"", "plain", "'", "'=1", "''", "=1", "a\"b\"", "\"", ",", "\r", "\n", "\r\n", "-", "\t", "@\"\r\n,\"", "é漢"}) {
    EXPECT_EQ(read_back(text), text) << text;
  }
  std::mt19937 random(7);
  const std::string letters = "=+-@\t\r\n\",'ab ;";
  for (int trial = 0; trial < 5000; ++trial) {
    std::string text;
    for (unsigned n = random() % 8; n > 0; --n) text += letters[random() % letters.size()];
    ASSERT_EQ(read_back(text), text) << trial;
    ASSERT_TRUE(text.empty() || csv_text(text).find_first_of("=+-@\t") != 0u);
  }
}

TEST(CsvNumber, ReadsBackToTheSameBits) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 20000; ++trial) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    const double back = std::strtod(csv_number(value).c_str(), nullptr);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(value)) << csv_number(value);
  }
}

TEST(CsvNumber, IsShortAndSaysWhatIsNone) {
  EXPECT_EQ(csv_number(0.1), "0.1");
  EXPECT_EQ(csv_number(-7), "-7");
  EXPECT_EQ(csv_number(1.0 / 3), "0.3333333333333333");
  EXPECT_EQ(csv_number(-0.0), "-0");
  EXPECT_EQ(csv_number(std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(csv_number(HUGE_VAL), "inf");
  EXPECT_EQ(csv_number(-HUGE_VAL), "-inf");
  EXPECT_EQ(std::strtod(csv_number(5e-324).c_str(), nullptr), 5e-324);
}

TEST(CsvLine, JoinsAndEndsInCrLf) {
  EXPECT_EQ(csv_line({"a", "", "c"}), "a,,c\r\n");
  EXPECT_EQ(csv_line({"", "", ""}), ",,\r\n") << "empty fields at the beginning count";
  EXPECT_EQ(csv_line({"a"}), "a\r\n");
}

}  // namespace
}  // namespace trocar::csv_test
