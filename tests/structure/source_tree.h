// The files of the repository that are written by hand.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace trocar {

struct SourceFile {
  std::string path;  ///< from the repository's root, with slashes
  std::string text;
  bool header() const { return path.ends_with(".h"); }
  bool cpp() const { return header() || path.ends_with(".cpp"); }
};

/// C++, CMake and shader files of the project's own folders, sorted by path.
const std::vector<SourceFile>& source_tree();

}  // namespace trocar
