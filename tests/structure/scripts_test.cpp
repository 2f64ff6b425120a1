// The scripts of a fresh machine and the one list of packages that they read.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace trocar::scripts_test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = TROCAR_SOURCE_DIR;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

std::set<std::string> packages() {
  std::set<std::string> names;
  std::istringstream lines(text_of(kRoot / "cmake/debian-packages.txt"));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    EXPECT_TRUE(std::regex_match(line, std::regex("[a-z0-9][a-z0-9+.-]+"))) << line;
    EXPECT_TRUE(names.insert(line).second) << line << " is named twice";
  }
  return names;
}

TEST(Scripts, AreExecutableAndStopAtTheFirstFailure) {
  for (const char* name : {"start", "check", ".ci/run"}) {
    EXPECT_NE(fs::status(kRoot / name).permissions() & fs::perms::owner_exec, fs::perms::none) << name;
    const std::string text = text_of(kRoot / name);
    EXPECT_TRUE(text.starts_with("#!/usr/bin/env bash\n")) << name;
    EXPECT_NE(text.find("\nset -euo pipefail\n"), std::string::npos) << name;
    EXPECT_NE(text.find("BASH_SOURCE"), std::string::npos) << name << ": works from its own folder, not the caller's";
  }
}

TEST(Scripts, NameNoHostAndNoPackageOfTheirOwn) {
  for (const char* name : {"start", "check", ".ci/run", "cmake/prepare.sh"}) {
    const std::string text = text_of(kRoot / name);
    EXPECT_EQ(text.find("://"), std::string::npos) << name;
    EXPECT_FALSE(std::regex_search(text, std::regex("\\blib[a-z0-9]+-dev\\b"))) << name;
  }
  EXPECT_NE(text_of(kRoot / "cmake/prepare.sh").find("cmake/debian-packages.txt"), std::string::npos);
}

TEST(Scripts, EveryLibraryThatCMakeLooksForIsOnTheList) {
  const std::set<std::string> list = packages();
  const std::vector<std::pair<std::string, std::string>> providers{{"Eigen3", "libeigen3-dev"},
                                                                   {"CGAL", "libcgal-dev"},
                                                                   {"fcl", "libfcl-dev"},
                                                                   {"assimp", "libassimp-dev"},
                                                                   {"ITK", "libinsighttoolkit5-dev"},
                                                                   {"EXPAT", "libexpat1-dev"},
                                                                   {"SQLite3", "libsqlite3-dev"},
                                                                   {"OpenSSL", "libssl-dev"},
                                                                   {"Threads", "g++"},
                                                                   {"zstd", "libzstd-dev"},
                                                                   {"ZLIB", "zlib1g-dev"},
                                                                   {"PNG", "libpng-dev"},
                                                                   {"Freetype", "libfreetype-dev"},
                                                                   {"PkgConfig", "pkg-config"},
                                                                   {"nlohmann_json", "nlohmann-json3-dev"},
                                                                   {"CLI11", "libcli11-dev"},
                                                                   {"tomlplusplus", "libtomlplusplus-dev"},
                                                                   {"GTest", "libgtest-dev"},
                                                                   {"benchmark", "libbenchmark-dev"},
                                                                   {"embree", "libembree-dev"}};
  static const std::regex kFind(R"(find_package\((\w+))");
  std::size_t seen = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot)) {
    const std::string relative = entry.path().lexically_relative(kRoot).generic_string();
    if (relative.starts_with("build/") || relative.starts_with(".git")) continue;
    if (entry.path().filename() != "CMakeLists.txt" && entry.path().extension() != ".cmake") continue;
    const std::string text = text_of(entry.path());
    for (std::sregex_iterator it(text.begin(), text.end(), kFind), end; it != end; ++it, ++seen) {
      const std::string wanted = (*it)[1];
      const auto provider =
          std::find_if(providers.begin(), providers.end(), [&](const auto& one) { return one.first == wanted; });
      if (provider == providers.end())
        ADD_FAILURE() << relative << ": which package provides " << wanted << "?";
      else
        EXPECT_TRUE(list.contains(provider->second)) << relative << " looks for " << wanted;
    }
  }
  EXPECT_GT(seen, 15u);
}

}  // namespace
}  // namespace trocar::scripts_test
