#include "tests/structure/source_tree.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

namespace trocar {
namespace {

namespace fs = std::filesystem;

bool wanted(const fs::path& path) {
  static const std::set<std::string> kEndings{".h", ".cpp", ".cmake", ".frag", ".vert", ".glsl"};
  return kEndings.contains(path.extension().string()) || path.filename() == "CMakeLists.txt";
}

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<SourceFile> walk() {
  const fs::path root = TROCAR_SOURCE_DIR;
  std::vector<SourceFile> files{{"CMakeLists.txt", read(root / "CMakeLists.txt")}};
  for (const char* folder : {"app", "assets", "cmake", "haptics", "scenarios", "tests", "tissue", "trainees"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (!entry.is_regular_file() || !wanted(entry.path())) continue;
      files.push_back({entry.path().lexically_relative(root).generic_string(), read(entry.path())});
    }
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return files;
}

}  // namespace

const std::vector<SourceFile>& source_tree() {
  static const std::vector<SourceFile> tree = walk();
  return tree;
}

}  // namespace trocar
