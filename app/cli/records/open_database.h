// Opens the database of a command and says on `err` what opening did: migration, attempts found dead.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "trainees/records/assessments.h"
#include "trainees/store/database.h"

namespace trocar {

/// @param file empty: the default path. @throws InputError, EnvironmentError as Database does.
Database open_database(const std::filesystem::path& file, OpenMode mode, std::ostream& err);

/// At the command line nobody signs in: the name is what is said, or else $USER.
Author author_said(const std::string& name);

}  // namespace trocar
