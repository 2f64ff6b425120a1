// A folder of its own, a short exercise and a short hand: what most tests of the whole program begin with.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/system/program.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::test {

using Json = nlohmann::json;
using Translator = std::vector<std::string>;

inline std::string file_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// `text` with its first `from` replaced. A test failure when there is none: the shipped file has changed.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) {
    ADD_FAILURE() << "nowhere in the text: " << from;
    return text;
  }
  return text.replace(at, from.size(), to);
}

/// Three seconds near the start: dips towards the organ, closes the jaws a little, comes back.
inline constexpr const char* kDip =
    "name = \"dip\"\nkind = \"waypoints\"\n"
    "[[move]]\nto_mm = [0, 0, -6]\nfrom = \"ready\"\nseconds = 0.6\nhold_s = 0.2\njaw_mm = 8\n"
    "[[move]]\nto_mm = [5, 0, 2]\nfrom = \"ready\"\nseconds = 0.6\n";

class SystemTest : public ::testing::Test {
 protected:
  /// The program run in the test's folder; data of the user's home stay untouched.
  Launch launch(Translator arguments) const {
    return {
        std::move(arguments), folder_.path(), {{"XDG_DATA_HOME", (folder_ / "data").string()}, {"TROCAR_ASSETS", ""}}};
  }
  Outcome trocar(Translator arguments) const { return run_program(launch(std::move(arguments))); }

  /// Standard output read as JSON; a failure with both streams when the exit code is another.
  Json json_of(const Translator& arguments, int exit_code) const {
    const Outcome outcome = trocar(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err << outcome.out;
    const Json json = Json::parse(outcome.out, nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << outcome.out << outcome.err;
    return json;
  }

  /// Fails with one message on stderr that holds `part`, says nothing on stdout.
  void expect_refusal(const Translator& arguments, int exit_code, const std::string& part) const {
    const Outcome outcome = trocar(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << "no \"" << part << "\" in: " << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }

  std::string shipped_exercise() const {
    return file_bytes(TROCAR_SOURCE_DIR "/scenarios/exercises/surface-touch.toml");
  }
  /// Writes the shipped exercise with another limit. @return its name in the folder.
  std::string exercise_of(int seconds, int targets) const {
    std::string text = replaced(shipped_exercise(), "time_limit_s = 120", "time_limit_s = " + std::to_string(seconds));
    folder_.write("short.toml", replaced(text, "count = 12", "count = " + std::to_string(targets)));
    return "short.toml";
  }
  std::string dip() const {
    folder_.write("dip.toml", kDip);
    return "dip.toml";
  }
  /// A run of three seconds that touches nothing: status timeout, exit code 1.
  Translator short_run(const Translator& more = {}) const {
    Translator words{"run", exercise_of(3, 12), "--hand", dip(), "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  TemporaryFolder folder_;
};

}  // namespace trocar::test
