// The trainee's guide lists the keys that the program has.
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "app/window/input/key_map.h"

namespace trocar::guide_test {
namespace {

TEST(TraineesGuide, ListsTheKeysAsTheyAre) {
  std::ifstream in(TROCAR_SOURCE_DIR "/docs/trainee_guide.md");
  const std::string guide{std::istreambuf_iterator<char>(in), {}};
  const KeyMap keys;
  std::string table = "| Action | Key | Name |\n|---|---|---|\n";
  for (const ActionName& one : action_names())
    table += std::string("| ") + one.words + " | " + key_name(keys.key_of(one.action)) + " | `" + one.name + "` |\n";
  EXPECT_NE(guide.find(table), std::string::npos) << "the table should be\n" << table;
}

}  // namespace
}  // namespace trocar::guide_test
