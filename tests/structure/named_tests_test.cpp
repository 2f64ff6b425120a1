// A test that a page names is there: docs/hazards.md claims of each hazard that a test shows its measure to work.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "tests/structure/source_tree.h"

namespace trocar::named_tests_test {
namespace {

/// "Suite.Case" of every test in the tree.
std::set<std::string> tests_there_are() {
  static const std::regex kTest(R"(TEST(_F|_P)?\((\w+),\s*(\w+)\))"), kTyped(R"(TYPED_TEST\((\w+),\s*(\w+)\))");
  std::set<std::string> out;
  for (const SourceFile& file : source_tree()) {
    if (!file.path.starts_with("tests/") || !file.cpp()) continue;
    for (std::sregex_iterator it(file.text.begin(), file.text.end(), kTest), end; it != end; ++it)
      out.insert((*it)[2].str() + "." + (*it)[3].str());
    for (std::sregex_iterator it(file.text.begin(), file.text.end(), kTyped), end; it != end; ++it)
      out.insert((*it)[1].str() + "." + (*it)[2].str());
  }
  return out;
}

TEST(NamedTests, OfTheHazardTableAreThereAndNoRowIsWithoutOne) {
  const std::set<std::string> there = tests_there_are();
  ASSERT_GT(there.size(), 1000U);
  std::ifstream in(std::string(TROCAR_SOURCE_DIR) + "/docs/hazards.md");
  ASSERT_TRUE(in);
  static const std::regex kNamed(R"(`(\w+\.\w+)`)");
  int rows = 0, number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (!line.starts_with("| ") || line.starts_with("| Hazard")) continue;
    ++rows;
    int named = 0;
    for (std::sregex_iterator it(line.begin(), line.end(), kNamed), end; it != end; ++it, ++named)
      EXPECT_TRUE(there.contains((*it)[1])) << "docs/hazards.md:" << number << ": no test " << (*it)[1];
    EXPECT_GT(named, 0) << "docs/hazards.md:" << number << ": a hazard without a test";
  }
  EXPECT_GT(rows, 15);
}

}  // namespace
}  // namespace trocar::named_tests_test
