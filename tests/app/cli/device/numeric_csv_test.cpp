// Numeric tables: strict in, exact out.
#include "app/cli/device/numeric_csv.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::numeric_csv_test {
namespace {

using test::message_of;

class NumericTable : public ::testing::Test {
 protected:
  NumericCsv read(const std::string& text) const { return read_numeric_csv(folder_.write("t.csv", text)); }
  std::string refusal(const std::string& text) const {
    const auto file = folder_.write("t.csv", text);
    const std::string message = message_of<InputError>([&] { read_numeric_csv(file); });
    EXPECT_EQ(message.find(file.string()), 0u) << "begins with the file: " << message;
    return message.substr(std::min(message.size(), file.string().size()));
  }

  test::TemporaryFolder folder_;
};

TEST_F(NumericTable, ReadsColumnsAndRows) {
  const NumericCsv table = read("a, b ,c\n1,-2.5,3e-3\n\n4,5,6\n");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"a", "b", "c"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0], (std::vector<double>{1, -2.5, 0.003}));
  EXPECT_EQ(table.rows[1], (std::vector<double>{4, 5, 6}));
}

TEST_F(NumericTable, TakesLinesThatEndAsOnOtherSystemsOrNotAtAll) {
  EXPECT_EQ(read("a,b\r\n1,2\r\n").columns[1], "b");
  EXPECT_EQ(read("a,b\r\n1,2\r\n").rows, (std::vector<std::vector<double>>{{1, 2}}));
  EXPECT_EQ(read("a,b\n1,2").rows, (std::vector<std::vector<double>>{{1, 2}}));
  EXPECT_TRUE(read("a,b\n").rows.empty());
}

TEST_F(NumericTable, FindsColumnsByName) {
  const NumericCsv table = read("a,b\n1,2\n");
  EXPECT_EQ(table.find("b"), std::optional<std::size_t>(1));
  EXPECT_FALSE(table.find("B"));
  EXPECT_EQ(table.require("a", "t.csv"), 0u);
  EXPECT_EQ(message_of<InputError>([&] { table.require("z", "t.csv"); }),
            "t.csv:1:1: no column 'z' in the header line");
}

TEST_F(NumericTable, RefusesWhatIsRaggedAtItsLine) {
  EXPECT_EQ(refusal("a,b\n1,2\n3\n"), ":3:1: 1 fields where the header has 2");
  EXPECT_EQ(refusal("a,b\n1,2,3\n"), ":2:1: 3 fields where the header has 2");
  EXPECT_EQ(refusal("a,b\n1,2\n\n\n3,4,\n"), ":5:1: 3 fields where the header has 2");
}

TEST_F(NumericTable, RefusesWhatIsNoFiniteNumberAtItsField) {
  for (const char* bad : {"nan", "NaN", "inf", "-inf", "", "x", "1.5x", "0x1p3", "1e999", "1 2", "--1"}) {
    EXPECT_EQ(refusal(std::string("a,b\n1,2\n3,") + bad + "\n").find(":3:2: "), 0u) << bad;
  }
}

TEST_F(NumericTable, RefusesAnEmptyOrMissingFile) {
  EXPECT_EQ(refusal(""), ":1:1: empty file: a header line was expected");
  EXPECT_EQ(message_of<InputError>([&] { read_numeric_csv("no/such.csv"); }),
            "no/such.csv: cannot be read (missing file or no permission)");
}

TEST_F(NumericTable, WhatIsWrittenReadsBackToTheLastBit) {
  std::mt19937_64 random(7);
  NumericCsv table{{"x", "y"}, {}};
  for (int i = 0; i < 500; ++i) {
    // Any finite pattern of bits, so that every exponent is met.
    const double x = std::bit_cast<double>(random());
    table.rows.push_back({std::isfinite(x) ? x : 0.1, std::bit_cast<double>(random() >> 12)});
  }
  table.rows.push_back({std::numeric_limits<double>::denorm_min(), -0.0});
  write_numeric_csv(folder_ / "o.csv", table);
  const NumericCsv back = read_numeric_csv(folder_ / "o.csv");
  ASSERT_EQ(back.rows.size(), table.rows.size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(back.rows[i][j]), std::bit_cast<std::uint64_t>(table.rows[i][j])) << i;
    }
  }
}

TEST_F(NumericTable, AFileThatCannotBeWrittenLeavesTheOldOneAlone) {
  EXPECT_THROW(write_numeric_csv(folder_ / "none" / "o.csv", {{"a"}, {{1}}}), EnvironmentError);
  write_numeric_csv(folder_ / "o.csv", {{"a"}, {{1}}});
  std::filesystem::create_symlink("/dev/full", folder_ / "o.csv.part");
  EXPECT_THROW(write_numeric_csv(folder_ / "o.csv", {{"a"}, {{2}}}), EnvironmentError);
  EXPECT_EQ(read_numeric_csv(folder_ / "o.csv").rows[0][0], 1);
}

}  // namespace
}  // namespace trocar::numeric_csv_test
