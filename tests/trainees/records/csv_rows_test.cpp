// Tables as spreadsheets write them.
#include "trainees/files/csv_rows.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"

namespace trocar::csv_rows_test {
namespace {

using Fields = std::vector<std::string>;

std::string refused(const std::string& bytes) {
  try {
    read_csv(bytes, "list.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CsvRows, ReadWhatSpreadsheetsWrite) {
  for (const std::string& text :
       {std::string("code,name\nA1,Ada\n"), std::string("code;name\r\nA1;Ada\r\n"), std::string("code\tname\rA1\tAda"),
        std::string("\xEF\xBB\xBF"
                    "code;name\r\nA1;Ada"),
        std::string("sep=;\r\ncode;name\r\nA1;Ada\r\n"), std::string("\"code\",\"name\"\n\n\"A1\",\"Ada\"\n,\n")}) {
    const CsvRows read = read_csv(text, "x");
    ASSERT_EQ(read.rows.size(), 2U) << text;
    EXPECT_EQ(read.rows[0].fields, (Fields{"code", "name"})) << text;
    EXPECT_EQ(read.rows[1].fields, (Fields{"A1", "Ada"})) << text;
    EXPECT_FALSE(read.recoded);
  }
}

TEST(CsvRows, KeepWhatIsQuotedAndCountLines) {
  const CsvRows read = read_csv("code;name\r\nA1;\"Ada; \"\"the\"\"\r\nCountess\"\r\n\r\nB2;\n", "x");
  ASSERT_EQ(read.rows.size(), 3U);
  EXPECT_EQ(read.rows[1].fields, (Fields{"A1", "Ada; \"the\"\r\nCountess"}));
  EXPECT_EQ(read.rows[2].line, 5);
  EXPECT_EQ(read.rows[2].fields, (Fields{"B2", ""}));
}

TEST(CsvRows, ReadWindowsLettersAndSayThatTheyDid) {
  const CsvRows read = read_csv("code;name\r\nA1;J\xFCrgen Gro\xDF \x80\r\n", "x");
  EXPECT_TRUE(read.recoded);
  EXPECT_EQ(read.rows[1].fields[1], "J\xC3\xBCrgen Gro\xC3\x9F \xE2\x82\xAC");
}

TEST(CsvRows, RefuseWithLineAndColumn) {
  EXPECT_EQ(refused("code,name\nA1,\"Ada\n"), "list.csv:2:4: a quote is opened and never closed");
  EXPECT_TRUE(refused("code,name\nA1,A\"da\n").starts_with("list.csv:2:5:")) << refused("code,name\nA1,A\"da\n");
  EXPECT_NE(refused("a,b\n\"x\"y,1\n").find("behind a closing quote"), std::string::npos);
  EXPECT_NE(refused("\xFF\xFE"
                    "c\0o\0")
                .find("UTF-16"),
            std::string::npos);
  EXPECT_NE(refused(std::string("a,b\nx\0y,1\n", 10)).find("zero byte"), std::string::npos);
  EXPECT_NE(refused("a,b\nx\x81,1\n").find("list.csv:2:1: is neither UTF-8"), std::string::npos);
  EXPECT_TRUE(read_csv("", "x").rows.empty());
}

}  // namespace
}  // namespace trocar::csv_rows_test
