// Names and times of attempts: time-ordered UUIDs (RFC 9562 version 7) and UTC in ISO 8601. Wall clock: informative
// only, never used for scoring. Thread: any.
#pragma once

#include <string>

namespace trocar {

/// 36 characters; sorts by time to about a quarter of a microsecond (method 3 of RFC 9562), the rest is random.
std::string make_uuid();

/// "2026-03-01T09:30:00.123Z"
std::string utc_now();

}  // namespace trocar
