// The type of an event is asked for by its constant: a literal could be misspelled.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "scenarios/scoring/event_types.h"
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

TEST(EventTypes, AreAllInTheList) {
  static const std::regex kConstant(R"re(\bk\w+\{"([A-Z_]+)"\})re");
  std::set<std::string> listed, written;
  for (const EventType type : event_type::kAll) EXPECT_TRUE(listed.insert(std::string(type.name)).second) << type.name;
  for (const SourceFile& file : source_tree()) {
    if (file.path != "scenarios/scoring/event_types.h") continue;
    for (std::sregex_iterator at(file.text.begin(), file.text.end(), kConstant), end; at != end; ++at)
      written.insert((*at)[1]);
  }
  EXPECT_GT(written.size(), 40u);
  EXPECT_EQ(listed, written);
}

}  // namespace
}  // namespace trocar::event_types_test
