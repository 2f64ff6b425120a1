// The hash chain over finished attempts: a change to any of them, or a gap, shows. Internal to trainees/.
//
// row_hash_n = SHA-256("trocar-attempt-1\n" + row_hash_(n-1) + "\n" + n + "\n" + status + "\n" + content_n), where
// content is every value of the attempt and of its events, metrics, sub-scores and caps with its type, in fixed order;
// row_hash_0 is empty. n counts finished attempts from 1. Later columns need a new version of the content. The chain
// shows changes; it cannot show that the newest attempts were cut off, nor stop who recomputes it: it is not a
// signature.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenarios/scoring/trace.h"

struct sqlite3;

namespace trocar {

/// Ends a running attempt whose rows are all written: sets its status and its place in the chain, which freezes it.
/// Call inside a transaction.
void seal_attempt(sqlite3* connection, std::int64_t attempt, AttemptStatus status);

/// Problems found when the whole chain is computed again, one line each.
std::vector<std::string> check_chain(sqlite3* connection);

}  // namespace trocar
