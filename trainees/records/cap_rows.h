// Caps as rows of score_cap, and their sentence for what SQL prints. Internal to trainees/.
#pragma once

#include <cstdint>
#include <vector>

#include "scenarios/scoring/cap.h"

struct sqlite3;

namespace trocar {

/// @param score row of the grading.
void insert_caps(sqlite3* connection, std::int64_t score, const std::vector<Cap>& caps);
/// Of the first grading. @throws InputError: a kind that this program does not know.
std::vector<Cap> read_caps(sqlite3* connection, std::int64_t attempt);

/// Gives SQL on this connection the function cap_sentence(kind, subject, below, done, total, at_most).
void add_cap_sentence(sqlite3* connection);

}  // namespace trocar
