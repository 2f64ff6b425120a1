// What an error says, as a page may show it: without the folders of this machine, which are for whoever runs the
// program. Thread: any.
#pragma once

#include <filesystem>
#include <string>

namespace trocar::review {

/// Every absolute path is cut to its last name. @param database its folder may have blanks, so it is taken out first.
std::string without_folders(const std::string& message, const std::filesystem::path& database = {});

}  // namespace trocar::review
