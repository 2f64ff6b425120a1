// A password that a file holds, so that it stands in no argument. Thread: any.
#pragma once

#include <filesystem>
#include <string>

namespace trocar {

/// The file's first line. @throws InputError: not there, readable by others, empty.
std::string read_password_file(const std::filesystem::path& file);

}  // namespace trocar
