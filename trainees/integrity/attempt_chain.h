// The hash chain over finished attempts: a change to any of them, or a gap, shows. Internal to trainees/.
//
// row_hash_n = SHA-256("trocar-attempt-V\n" + row_hash_(n-1) + "\n" + n + "\n" + status + "\n" + content_n), where
// content is every value of the attempt and of its events, metrics, sub-scores, caps, device warnings and changes of
// the device's state with its type, in fixed order; row_hash_0 is empty. n counts finished attempts from 1. V is the
// attempt's hash_version: what is covered later besides needs a new one. The chain shows changes; a cut-off end shows
// in the audit trail (audit.h); nothing stops who recomputes all. Of a trainee whose training data were erased
// (erasure.h) the content is gone and only the links are checked. Attempts that were fetched from other stations (table
// replica) keep the place in the chain of the station that made them: each is computed again, and what it followed must
// be here; the chain of this database leaves them out.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenarios/scoring/trace.h"

struct sqlite3;

namespace trocar {

/// Content that row_hash covers in attempts begun by this program.
inline constexpr int kHashVersion = 2;
inline constexpr int kFirstBoundVersion = 2;  ///< from here on an attempt's recording says whose it is

/// Ends a running attempt whose rows are all written: sets its status and its place in the chain, which freezes it,
/// and in the audit trail. Call inside a transaction.
void seal_attempt(sqlite3* connection, std::int64_t attempt, AttemptStatus status);

/// Whether the finished attempt still has the content that its row_hash was made of.
bool attempt_holds(sqlite3* connection, std::int64_t attempt);
/// The same, and a signed entry of the trail says so: what people put their name to.
bool attempt_vouched(sqlite3* connection, std::int64_t attempt);
/// @param what cannot be done with it otherwise: "signed". @throws InputError: it is not so.
void require_vouched(sqlite3* connection, std::int64_t attempt, const std::string& what);

/// Problems found when the whole chain is computed again, one line each.
std::vector<std::string> check_chain(sqlite3* connection);

}  // namespace trocar
