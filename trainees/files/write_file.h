// A whole file written at once, or a clear word why not. Thread: any.
#pragma once

#include <filesystem>
#include <string_view>

namespace trocar {

/// Replaces what is there. @throws EnvironmentError "FILE: cannot be written: why"
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// The same for somebody's data: readable by its owner alone (owner_file.h).
void write_owner_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace trocar
