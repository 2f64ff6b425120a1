// Whether the disk has room for an attempt, asked before it begins.
//
// A recording takes 0.6 MiB a minute at 1 kHz (docs/data_store.md); database and journal get a reserve on top. Thread:
// any.
#pragma once

#include <cstdint>
#include <filesystem>

namespace trocar {

/// Bytes that an attempt may need. @param longest_s its loop time at most.
std::uintmax_t room_needed(double longest_s, double rate_hz);

/// @throws EnvironmentError that names folder, bytes and what to do, when `free_bytes` are fewer than `needed`.
void require_room(const std::filesystem::path& folder, std::uintmax_t needed, std::uintmax_t free_bytes);

}  // namespace trocar
