// Databases as older programs left them.
#pragma once

#include <filesystem>

namespace trocar {

/// Schema 3 with so many finished attempts, their chain, trail and anchor. One of three was cut off and still stands as running,
/// its process long gone.
void make_schema3(const std::filesystem::path& file, int attempts);

/// Schema 1 with three attempts (schema_v1_sample.sql).
void make_schema1(const std::filesystem::path& file);

}  // namespace trocar
