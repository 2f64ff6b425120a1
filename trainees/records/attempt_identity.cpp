#include "trainees/records/attempt_identity.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <random>
#include <string_view>

#include <nlohmann/json.hpp>

#include "haptics/input_error.h"
#include "trainees/records/replica_facts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

std::int64_t nanoseconds_since_epoch() {
  using namespace std::chrono;
  return duration_cast<nanoseconds>(system_clock::now().time_since_epoch()).count();
}

/// Milliseconds since the epoch times 4096, and their fraction: the 60 bits that a UUID begins with.
std::uint64_t steps_now() {
  const auto now = static_cast<std::uint64_t>(nanoseconds_since_epoch());
  return now / 1'000'000 * 4096 + now % 1'000'000 * 4096 / 1'000'000;
}

/// Of a UUID; 0 of another text.
std::uint64_t steps_of(const std::string& uuid) {
  unsigned long long high = 0;
  unsigned low = 0, fraction = 0;
  if (!is_time_ordered(uuid) || std::sscanf(uuid.c_str(), "%8llx-%4x-7%3x-", &high, &low, &fraction) != 3) return 0;
  return ((std::uint64_t{high} << 16) + low) * 4096 + fraction;
}

std::string uuid_at(std::uint64_t steps) {
  const std::uint64_t milliseconds = steps / 4096;
  const auto fraction = static_cast<unsigned>(steps % 4096);
  std::random_device random;
  const unsigned high = random(), low = random();
  char text[40];
  std::snprintf(text, sizeof text, "%08llx-%04llx-7%03x-%04x-%04x%08x",
                static_cast<unsigned long long>(milliseconds >> 16),
                static_cast<unsigned long long>(milliseconds & 0xFFFF), fraction, 0x8000u | ((high >> 16) & 0x3FFFu),
                high & 0xFFFFu, low);
  return text;
}

/// Greater than one of the last step that there is, by the 62 bits after it.
std::string uuid_in_last_step(const std::string& before) {
  constexpr std::uint64_t kLast = (std::uint64_t{1} << 62) - 1, kAtOnce = std::uint64_t{1} << 32;
  unsigned high = 0, middle = 0, low = 0;
  std::sscanf(before.c_str() + 19, "%4x-%4x%8x", &high, &middle, &low);
  const std::uint64_t bits = (std::uint64_t{high & 0x3FFFu} << 48) + (std::uint64_t{middle} << 32) + low;
  if (bits == kLast)
    throw InputError("after " + before + " there is no UUID: whoever wrote that row left none; see trocar db check");
  std::random_device random;
  const std::uint64_t next = bits + 1 + random() % std::min(kLast - bits, kAtOnce);
  char text[40];
  std::snprintf(text, sizeof text, "%.19s%04x-%04x%08x", before.c_str(), 0x8000u | static_cast<unsigned>(next >> 48),
                static_cast<unsigned>(next >> 32 & 0xFFFFu), static_cast<unsigned>(next & 0xFFFFFFFFu));
  return text;
}

}  // namespace

std::string make_uuid() { return uuid_at(steps_now()); }

std::string make_uuid_after(const std::string& before) {
  constexpr std::uint64_t kLast = (std::uint64_t{1} << 60) - 1;
  const std::uint64_t steps = steps_of(before);
  return steps < kLast ? uuid_at(std::max(steps_now(), steps + 1)) : uuid_in_last_step(before);
}

std::string utc_now() {
  const std::int64_t now = nanoseconds_since_epoch();
  const std::time_t seconds = now / 1'000'000'000;
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char text[32];
  const std::size_t size = std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &parts);
  std::snprintf(text + size, sizeof text - size, ".%03dZ", static_cast<int>(now / 1'000'000 % 1000));
  return text;
}

bool is_time_ordered(const std::string& uuid) {
  static constexpr std::string_view kForm = "xxxxxxxx-xxxx-7xxx-vxxx-xxxxxxxxxxxx";
  return std::equal(uuid.begin(), uuid.end(), kForm.begin(), kForm.end(), [](char is, char form) {
    const std::string_view digits = form == 'v' ? "89ab" : "0123456789abcdef";
    return form == 'x' || form == 'v' ? digits.find(is) != std::string_view::npos : is == form;
  });
}

bool is_name_of_attempt(const std::string& uuid) {
  return uuid.size() == 36 && uuid.find_first_not_of("0123456789abcdef-") == std::string::npos;
}

void require_name_of_attempt(const std::string& uuid) {
  if (!is_name_of_attempt(uuid)) throw InputError("attempt " + uuid + ": has no name of trocar's; see trocar db check");
}

std::string identity_of(sqlite3* connection, const std::string& uuid, const std::string& public_key) {
  static const std::string kQuery = "SELECT a.uuid, " + origin_sql("a.uuid", "t.uuid") +
                                    ", exercise_id, ruleset_sha256, level, seed, board, hand FROM attempt a"
                                    " JOIN trainee t ON t.id = a.trainee_id WHERE a.uuid = ?";
  sql::Statement row(connection, kQuery);
  if (!row.bind(uuid).step()) throw InputError("attempt " + uuid + ": not in this database");
  const nlohmann::ordered_json said{{"attempt", row.text(0)},  {"trainee", row.text(1)}, {"exercise", row.text(2)},
                                    {"ruleset", row.text(3)},  {"level", row.text(4)},   {"seed", row.integer(5)},
                                    {"board", row.integer(6)}, {"hand", row.text(7)},    {"key", public_key}};
  return said.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);  // what no text has changes it
}

}  // namespace trocar
