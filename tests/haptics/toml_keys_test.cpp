// Keys of very many parts are refused with their place before the TOML parser sees them.
#include "haptics/toml_keys.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"

namespace trocar::toml_keys_test {
namespace {

std::string problem(const std::string& toml) {
  try {
    require_short_keys(toml, "t.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string many(int parts, const std::string& one = "a") {
  std::string out = one;
  for (int i = 1; i < parts; ++i) out += "." + one;
  return out;
}

TEST(TomlKeys, ManyPartsAreRefusedWhereverTheyStand) {
  EXPECT_EQ(problem("x = 1\n" + many(kMostKeyParts + 1) + " = 1"), "t.toml:2:64: a key of more than 32 parts");
  for (const std::string& toml :
       {"[" + many(40000) + "]", "[[" + many(40) + "]]", "x = { " + many(40) + " = 1 }", many(40, "\"a, = \"") + " = 1",
        many(40, "'a'") + " = 1", "x = \"\"\"\n\"\"\"\"\n" + many(40) + " = 1", "# \"\n" + many(40) + " = 1"})
    EXPECT_NE(problem(toml), "") << toml.substr(0, 60);
}

TEST(TomlKeys, WhatIsNoKeyMayHoldDots) {
  const std::string dots(200, '.');
  for (const std::string& toml :
       {many(kMostKeyParts) + " = 1", "x = \"" + dots + "\\\"" + dots + "\"", "x = '" + dots + "'", "# " + dots,
        "x = \"\"\"\n" + dots + "\n\\\"\"\"\"", std::string("x = [0.1, 0.2, 0.3]\n[t.u]\ny = 1.5")})
    EXPECT_EQ(problem(toml), "") << toml.substr(0, 60);
}

}  // namespace
}  // namespace trocar::toml_keys_test
