// A path of the tree that a comment or a page names exists: what was moved is named by its new place.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>

#include "tests/structure/source_tree.h"

namespace trocar::named_paths_test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = TROCAR_SOURCE_DIR;

/// A file, a folder, or the beginning of a file's name (`haptics/haptic_loop`).
bool exists(const std::string& named) {
  if (fs::exists(kRoot / named)) return true;
  const fs::path folder = (kRoot / named).parent_path();
  if (!fs::is_directory(folder)) return false;
  const std::string begin = fs::path(named).filename().string();
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with(begin)) return true;
  return false;
}

std::size_t check(const std::string& file, const std::string& text) {
  static const std::regex kPath(R"((^|[^\w/.$}])((app|haptics|tissue|scenarios|trainees)/[\w/.]*\w))");
  std::istringstream lines(text);
  std::size_t seen = 0, number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.starts_with("#include")) continue;
    for (std::sregex_iterator it(line.begin(), line.end(), kPath), end; it != end; ++it, ++seen)
      EXPECT_TRUE(exists((*it)[2])) << file << ':' << number << ": " << (*it)[2];
  }
  return seen;
}

TEST(NamedPaths, OfSourcesExist) {
  std::size_t seen = 0;
  for (const SourceFile& file : source_tree())
    if (file.cpp() && !file.path.starts_with("tests/")) seen += check(file.path, file.text);
  EXPECT_GT(seen, 20u);
}

TEST(NamedPaths, OfThePagesExist) {
  std::size_t seen = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs")) {
    if (entry.path().extension() != ".md") continue;
    std::ifstream in(entry.path());
    seen += check(entry.path().lexically_relative(kRoot).generic_string(), {std::istreambuf_iterator<char>(in), {}});
  }
  EXPECT_GT(seen, 50u);
}

}  // namespace
}  // namespace trocar::named_paths_test
