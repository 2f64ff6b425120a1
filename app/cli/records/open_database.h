// Opens the database of a command and says on `err` what opening did: migration, attempts found dead.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "trainees/store/database.h"

namespace trocar {

/// @param file empty: the default path. @throws InputError, EnvironmentError as Database does.
Database open_database(const std::filesystem::path& file, OpenMode mode, std::ostream& err);

}  // namespace trocar
