// What the desk and its reports need of the rest of the program, for any command that makes pages. Thread: any.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>

#include "app/desk/desk_films.h"
#include "app/desk/desk_pictures.h"
#include "trainees/desk/routes/route.h"

namespace trocar {

/// Opens quietly what has been opened, migrated and repaired before.
std::function<Database()> desk_opener(const std::filesystem::path& file);

/// None without the assets that pictures are made of, which is said on `err`.
std::unique_ptr<DeskPictures> desk_pictures(const std::filesystem::path& file, std::ostream& err);

/// Films that were made before can be watched where none can be made. @param why set to a sentence where none can.
std::unique_ptr<DeskFilms> desk_films(const std::filesystem::path& file, std::string& why);

/// Traces, words for metrics, facts of levels; no pictures and no station yet.
review::DeskSources desk_sources();

}  // namespace trocar
