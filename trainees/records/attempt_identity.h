// Names and times of attempts: time-ordered UUIDs (RFC 9562 version 7) and UTC in ISO 8601. Wall clock: informative
// only, never used for scoring. Thread: any.
#pragma once

#include <string>

namespace trocar {

/// 36 characters; sorts by time to about a quarter of a microsecond (method 3 of RFC 9562), the rest is random.
std::string make_uuid();

/// The same, and greater than `before` whatever the clock says: one step beyond it where the clock was set back (RFC
/// 9562, section 6.2). A `before` that is no such UUID does not count.
std::string make_uuid_after(const std::string& before);

/// "2026-03-01T09:30:00.123Z"
std::string utc_now();

}  // namespace trocar
