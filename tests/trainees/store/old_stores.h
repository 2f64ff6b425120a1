// Databases as older programs left them.
#pragma once

#include <filesystem>

namespace trocar {

/// Schema 3 or 4 with so many attempts, their chain, trail and anchor. One of three was cut off and still stands as
/// running, its process long gone.
void make_old_store(const std::filesystem::path& file, int version, int attempts);

/// Schema 1 with three attempts (schema_v1_sample.sql).
void make_schema1(const std::filesystem::path& file);

}  // namespace trocar
