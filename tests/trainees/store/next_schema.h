// A store that a later program migrates: the shipped schema and one step more, which only tests have.
#pragma once

#include <filesystem>
#include <span>

#include "trainees/store/database.h"

namespace trocar {

/// The shipped migrations and a step that copies a part of every event.
std::span<const Migration> next_migrations();

/// The database as a later program opens it.
Database open_by_next_program(const std::filesystem::path& file, int busy_timeout_ms = 5000);

/// PRAGMA user_version as it stands in the file, whatever program wrote it.
int written_version(const std::filesystem::path& file);

/// So many attempts of T-old with chain, trail and anchor. One of three was cut off and still stands as running, its
/// process long gone.
void make_store(const std::filesystem::path& file, int attempts);

}  // namespace trocar
