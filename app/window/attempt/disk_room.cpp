#include "app/window/attempt/disk_room.h"

#include <string>

#include "haptics/input_error.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr double kMiB = 1024 * 1024;
constexpr double kMinute = 0.6 * kMiB;  // of a recording at 1 kHz
constexpr double kReserve = 8 * kMiB;   // database, journal, what else writes meanwhile

std::string mebibytes(std::uintmax_t bytes) {
  return std::to_string(static_cast<std::uintmax_t>(static_cast<double>(bytes) / kMiB)) + " MiB";
}

}  // namespace

std::uintmax_t room_needed(double longest_s, double rate_hz) {
  return static_cast<std::uintmax_t>(kReserve + kMinute * (longest_s / 60) * (rate_hz / 1000));
}

void require_room(const fs::path& folder, std::uintmax_t needed, std::uintmax_t free_bytes) {
  if (free_bytes >= needed) return;
  throw EnvironmentError(folder.string() + ": the disk is nearly full: " + mebibytes(free_bytes) +
                         " are free and an attempt needs " + mebibytes(needed) + "; make room and start again");
}

}  // namespace trocar
