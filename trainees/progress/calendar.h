// Days and weeks of the UTC texts that attempts carry ("2026-03-01T09:30:00.123Z"); proleptic Gregorian, no leap
// seconds. Pure: no clock is read. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trocar {

inline constexpr std::int64_t kSecondsADay = 86400;

/// Seconds since 1970; fractions are cut. Empty for what is no such text, or no day of the calendar.
std::optional<std::int64_t> seconds_of_utc(std::string_view utc);
/// "2026-03-01T09:30:00Z"
std::string utc_of_seconds(std::int64_t seconds);
/// Monday of the week, as "2026-02-23".
std::string monday_of(std::int64_t seconds);

}  // namespace trocar
