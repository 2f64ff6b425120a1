// What `trocar replay` and `trocar score` are about: a recording, named by its file or by a stored attempt.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "app/session/recording/recording_reader.h"
#include "scenarios/scoring/attempt_result.h"

namespace trocar {

/// A recording and, when it was named by an attempt, what the database says of it.
struct Subject {
  std::filesystem::path file;
  Recording recording;
  std::optional<AttemptResult> stored;
};

/// @param name recording file, or attempt ("latest", part of a UUID). @throws InputError: there is none, or not the one
/// that was graded.
Subject find_subject(const std::string& name, const std::filesystem::path& database, std::ostream& err);

}  // namespace trocar
