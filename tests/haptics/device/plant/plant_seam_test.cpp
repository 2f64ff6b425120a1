// The simulated device must not borrow the controller's mathematics: its sources include the seam and each other only.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace trocar::plant_seam_test {
namespace {

/// @param path below haptics/device.
bool is_plant_file(const std::string& path) { return path.starts_with("plant/") || path.starts_with("simulated_daq."); }

// What stands between the quotes of an #include "...", else nothing.
std::string quoted_include(const std::string& line) {
  const std::string directive = "#include \"";
  if (line.rfind(directive, 0) != 0) return "";
  const std::size_t end = line.find('"', directive.size());
  return end == std::string::npos ? "" : line.substr(directive.size(), end - directive.size());
}

TEST(PlantSeam, IncludesTheSeamAndItselfOnly) {
  const std::filesystem::path folder = std::filesystem::path(TROCAR_SOURCE_DIR) / "haptics" / "device";
  const std::set<std::string> shared = {"haptics/quantities.h", "haptics/device/data_acquisition.h",
                                        "haptics/device/index_mark.h", "haptics/device/simulated_world.h"};
  int files = 0, includes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!is_plant_file(entry.path().lexically_relative(folder).generic_string())) continue;
    ++files;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      const std::string header = quoted_include(line);
      if (header.empty()) continue;
      ++includes;
      const std::string own = "haptics/device/";
      const bool is_own = header.rfind(own, 0) == 0 && is_plant_file(header.substr(own.size()));
      EXPECT_TRUE(is_own || shared.count(header)) << entry.path().filename() << " includes " << header;
    }
  }
  EXPECT_GE(files, 13);
  EXPECT_GE(includes, 20);
}

}  // namespace
}  // namespace trocar::plant_seam_test
