// Exercises from TOML files, strictly: unknown, missing, mistyped or out-of-range keys are refused with their place.
//
// The file's bytes are kept in Exercise::text and hashed into Rubric::sha256: that hash is the rubric's version.
// Thread: loading only.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/exercise.h"
#include "scenarios/files/strict_toml.h"

namespace trocar {

/// @throws InputError "FILE:LINE:COLUMN: message", naming the key and the nearest known key.
Exercise load_exercise(const std::filesystem::path& file);
/// Same from bytes already in memory (an exercise embedded in a recording). @param file name for messages.
Exercise parse_exercise(const std::string& text, const std::filesystem::path& file);

/// A stage of an operation: the kind, [targets], [force] where it differs, [[ducts]] and what its kind asks for; the
/// rest is the operation's. @throws InputError with line and column
Exercise read_stage(StrictTable& table, const Exercise& operation, const std::vector<std::string>& kinds);

/// Every *.toml of a folder, ordered by number ("E02"). @throws InputError from the first bad file, or when the folder
/// cannot be read.
std::vector<Exercise> list_exercises(const std::filesystem::path& exercises_dir);

/// Whether a person means it by this word: its id or its number ("E02", "2"), in whatever case.
bool is_named(const Exercise& exercise, const std::string& word);

/// An exercise by its id or number, as is_named() has it, or a path to a .toml file. @throws InputError listing the
/// known ones.
Exercise find_exercise(const std::string& id_or_path, const std::filesystem::path& exercises_dir);

/// @throws InputError listing the known levels.
const ExerciseLevel& find_level(const Exercise& exercise, const std::string& name);

}  // namespace trocar
