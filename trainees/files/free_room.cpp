#include "trainees/files/free_room.h"

#include <limits>
#include <system_error>

namespace trocar {

std::uintmax_t room_free(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path at = fs::absolute(folder.empty() ? fs::path(".") : folder, error);
  while (!at.empty() && !fs::exists(at, error) && at != at.parent_path()) at = at.parent_path();
  const fs::space_info space = fs::space(at, error);
  return error ? std::numeric_limits<std::uintmax_t>::max() : space.available;
}

}  // namespace trocar
