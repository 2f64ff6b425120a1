#include "trainees/records/attempt_identity.h"

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <random>

namespace trocar {
namespace {

std::int64_t nanoseconds_since_epoch() {
  using namespace std::chrono;
  return duration_cast<nanoseconds>(system_clock::now().time_since_epoch()).count();
}

}  // namespace

std::string make_uuid() {
  const auto now = static_cast<std::uint64_t>(nanoseconds_since_epoch());
  const std::uint64_t milliseconds = now / 1'000'000;
  const auto fraction = static_cast<unsigned>((now % 1'000'000) * 4096 / 1'000'000);
  std::random_device random;
  const unsigned high = random(), low = random();
  char text[40];
  std::snprintf(text, sizeof text, "%08llx-%04llx-7%03x-%04x-%04x%08x",
                static_cast<unsigned long long>(milliseconds >> 16),
                static_cast<unsigned long long>(milliseconds & 0xFFFF), fraction, 0x8000u | ((high >> 16) & 0x3FFFu),
                high & 0xFFFFu, low);
  return text;
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

}  // namespace trocar
