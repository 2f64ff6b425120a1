// The type of an event is asked for by its constant: a literal could be misspelled.
#include <gtest/gtest.h>

#include <regex>

#include "tests/structure/source_text.h"
#include "tests/structure/source_tree.h"

namespace trocar::event_types_test {
namespace {

TEST(EventTypes, AreNotComparedWithLiterals) {
  static const std::regex kLiteral(R"re((event|events\[\w+\]|\be)(\.|->)type [=!]= ")re");
  EXPECT_TRUE(std::regex_search(std::string(R"(if (event.type == "LSOT"))"), kLiteral));
  for (const SourceFile& file : source_tree()) {
    if (!file.cpp() || file.path.starts_with("tests/")) continue;
    std::smatch found;
    if (std::regex_search(file.text, found, kLiteral))
      ADD_FAILURE() << file.path << ':' << line_of(file.text, static_cast<std::size_t>(found.position()))
                    << ": take a constant of scenarios/scoring/event_types.h";
  }
}

}  // namespace
}  // namespace trocar::event_types_test
