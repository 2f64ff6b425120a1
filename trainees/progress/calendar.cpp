#include "trainees/progress/calendar.h"

#include <charconv>
#include <chrono>
#include <cstdio>

namespace trocar {
namespace {

namespace chrono = std::chrono;

std::optional<int> digits(std::string_view text, std::size_t at, std::size_t count) {
  int value = 0;
  for (std::size_t i = at; i < at + count; ++i) {
    if (i >= text.size() || text[i] < '0' || text[i] > '9') return std::nullopt;
    value = 10 * value + (text[i] - '0');
  }
  return value;
}

chrono::sys_days day_of(std::int64_t seconds) {
  return chrono::floor<chrono::days>(chrono::sys_seconds(chrono::seconds(seconds)));
}

std::string date_text(chrono::sys_days day) {
  const chrono::year_month_day date(day);
  char text[32];
  std::snprintf(text, sizeof text, "%04d-%02u-%02u", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                static_cast<unsigned>(date.day()));
  return text;
}

}  // namespace

std::optional<std::int64_t> seconds_of_utc(std::string_view utc) {
  if (utc.size() < 20 || utc[4] != '-' || utc[7] != '-' || utc[10] != 'T' || utc[13] != ':' || utc[16] != ':' ||
      utc.back() != 'Z')
    return std::nullopt;
  const auto year = digits(utc, 0, 4), month = digits(utc, 5, 2), day = digits(utc, 8, 2);
  const auto hour = digits(utc, 11, 2), minute = digits(utc, 14, 2), second = digits(utc, 17, 2);
  if (!year || !month || !day || !hour || !minute || !second || *hour > 23 || *minute > 59 || *second > 60)
    return std::nullopt;
  const chrono::year_month_day date{chrono::year(*year), chrono::month(static_cast<unsigned>(*month)),
                                    chrono::day(static_cast<unsigned>(*day))};
  if (!date.ok()) return std::nullopt;
  return chrono::sys_days(date).time_since_epoch().count() * kSecondsADay + *hour * 3600 + *minute * 60 + *second;
}

std::string utc_of_seconds(std::int64_t seconds) {
  const chrono::sys_days day = day_of(seconds);
  const std::int64_t rest = seconds - day.time_since_epoch().count() * kSecondsADay;
  char clock[32];
  std::snprintf(clock, sizeof clock, "T%02d:%02d:%02dZ", static_cast<int>(rest / 3600),
                static_cast<int>(rest / 60 % 60), static_cast<int>(rest % 60));
  return date_text(day) + clock;
}

std::string monday_of(std::int64_t seconds) {
  const chrono::sys_days day = day_of(seconds);
  return date_text(day - (chrono::weekday(day) - chrono::Monday));
}

}  // namespace trocar
