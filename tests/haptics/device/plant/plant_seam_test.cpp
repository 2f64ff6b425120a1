// The simulated device must not borrow the controller's mathematics: its sources include the seam and each other only.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace trocar::plant_seam_test {
namespace {

bool is_plant_file(const std::string& name) {
  for (const char* stem : {"device_plant", "plant_", "simulated_daq", "hand_model"}) {
    if (name.rfind(stem, 0) == 0) return true;
  }
  return false;
}

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
                                        "haptics/device/hand.h"};
  int files = 0, includes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!is_plant_file(entry.path().filename().string())) continue;
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
