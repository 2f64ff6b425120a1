// Names and times of attempts: time-ordered UUIDs (RFC 9562 version 7) and UTC in ISO 8601; and whose one is. Wall
// clock: informative only, never used for scoring. Thread: any.
#pragma once

#include <string>

struct sqlite3;

namespace trocar {

/// 36 characters; sorts by time to about a quarter of a microsecond (method 3 of RFC 9562), the rest is random.
std::string make_uuid();

/// The same, and greater than `before` whatever the clock says: one step beyond it where the clock was set back (RFC
/// 9562, section 6.2). A `before` that is no such UUID does not count. @throws InputError: it is the last there is.
std::string make_uuid_after(const std::string& before);

/// "2026-03-01T09:30:00.123Z"
std::string utc_now();

/// A UUID as make_uuid() makes them: its digits 1 to 8 and 10 to 13 are milliseconds since the epoch.
bool is_time_ordered(const std::string& uuid);

/// A UUID as this program makes them, which can be the name of a file: nothing that leads out of a folder.
bool is_name_of_attempt(const std::string& uuid);
/// @throws InputError: none.
void require_name_of_attempt(const std::string& uuid);

/// What an attempt began with and what its recording says of it, as JSON: attempt, trainee (where it began), exercise,
/// ruleset, level, seed, board, hand, and the key given. @throws InputError: no such attempt.
std::string identity_of(sqlite3* connection, const std::string& uuid, const std::string& public_key);

}  // namespace trocar
