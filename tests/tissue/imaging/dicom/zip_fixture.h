// Zip archives for tests, written by libzip.
//
// Thread: any.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace trocar::test {

/// @param password "" for none
std::filesystem::path write_zip(const std::filesystem::path& path,
                                const std::vector<std::pair<std::string, std::string>>& files,
                                const std::string& password = "");

}  // namespace trocar::test
