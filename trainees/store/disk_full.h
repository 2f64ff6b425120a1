// The disk has no room for what was to be written: nothing of it was, and all that is there can be read on.
#pragma once

#include <cerrno>
#include <filesystem>
#include <string>

#include "haptics/input_error.h"

namespace trocar {

class DiskFull : public EnvironmentError {
 public:
  using EnvironmentError::EnvironmentError;
};

/// What the system says, errno: no room is left, or the user's share of it is used up.
inline bool is_disk_full(int error) { return error == ENOSPC || error == EDQUOT; }

inline std::string no_room_for_backup(const std::filesystem::path& to) {
  return to.string() + ": the disk is full: no backup was made; make room on it";
}

}  // namespace trocar
