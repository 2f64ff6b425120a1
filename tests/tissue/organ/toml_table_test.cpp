#include "tissue/organ/toml_table.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::toml_table_test {
namespace {

template <typename Read>
std::string refusal(const std::string& text, Read&& read) {
  return test::message_of<InputError>([&] {
    TomlTable table = TomlTable::parse(text, "f.toml");
    read(table);
    table.finish();
  });
}

TEST(TomlTable, ReadsWhatTheWriterWrote) {
  TomlWriter out;
  out.add("name", std::string("äö \"x\" \\ end"));
  out.add("flag", true);
  out.add("count", std::size_t{7});
  out.add("length", 1.23456, 3);
  out.add("words", std::vector<std::string>{"one", "it's two"});
  out.table("inner");
  out.add("key", "value");
  out.array_table("row");
  out.add("n", 1);
  out.array_table("row");
  out.add("n", 2);
  TomlTable table = TomlTable::parse(std::move(out).text(), "f.toml");
  EXPECT_EQ(table.text("name"), "äö \"x\" \\ end");
  EXPECT_TRUE(table.boolean("flag"));
  EXPECT_EQ(table.count("count"), 7U);
  EXPECT_EQ(table.number("length"), 1.235);
  EXPECT_EQ(table.texts("words"), (std::vector<std::string>{"one", "it's two"}));
  EXPECT_EQ(table.table("inner").text("key"), "value");
  std::vector<TomlTable> rows = table.tables("row");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].integer("n"), 2);
  EXPECT_NO_THROW(table.finish());
}

TEST(TomlTable, AnyTextComesBackWhateverItHolds) {
  for (const std::string text :
       {"\nx", "a\n'''b\"\"\"", "tab\there", "\x7f\x01 \\ \"q\"", "plain", "", "it's", "\r\n"}) {
    TomlWriter out;
    out.add("key", text);
    out.add("after", 1);
    TomlTable table = TomlTable::parse(std::move(out).text(), "f.toml");
    EXPECT_EQ(table.text("key"), text);
    EXPECT_EQ(table.integer("after"), 1);
  }
}

TEST(TomlTable, RefusesWithLineAndColumn) {
  EXPECT_CONTAINS(refusal("a = \n", [](TomlTable&) {}), "f.toml:1:");
  EXPECT_CONTAINS(refusal("a = 1\nb = 2\n", [](TomlTable& t) { t.integer("a"); }), "f.toml:2:1: unknown key \"b\"");
  EXPECT_CONTAINS(refusal("a = 1\n", [](TomlTable& t) { t.text("a"); }), "f.toml:1:5: a must be text");
  EXPECT_CONTAINS(refusal("a = 1.5\n", [](TomlTable& t) { t.count("a"); }), "a must be a whole number");
  EXPECT_CONTAINS(refusal("a = -1\n", [](TomlTable& t) { t.count("a"); }), "a is negative");
  EXPECT_CONTAINS(refusal("a = 99999999999\n", [](TomlTable& t) { t.integer("a"); }), "a is too large");
  EXPECT_CONTAINS(refusal("a = inf\n", [](TomlTable& t) { t.number("a"); }), "a is not finite");
  EXPECT_CONTAINS(refusal("a = 1\n", [](TomlTable& t) { t.table("a"); }), "a must be a table");
  EXPECT_CONTAINS(refusal("a = [1]\n", [](TomlTable& t) { t.texts("a"); }), "a holds texts");
  EXPECT_CONTAINS(refusal("a = [1]\n", [](TomlTable& t) { t.tables("a"); }), "a holds tables");
  EXPECT_CONTAINS(refusal("a = 'x'\n", [](TomlTable& t) { t.expect("a", "y"); }), "a must be \"y\"");
  EXPECT_CONTAINS(refusal("a = 1\n", [](TomlTable& t) { t.number("b"); }), "key \"b\" is missing");
}

TEST(TomlTable, ATableOutlivesTheOneItCameFrom) {
  TomlTable inner = TomlTable::parse("[t]\nk = 'v'\n", "f.toml").table("t");
  EXPECT_EQ(inner.text("k"), "v");
}

}  // namespace
}  // namespace trocar::toml_table_test
