// Room on the disk. Thread: any.
#pragma once

#include <cstdint>
#include <filesystem>

namespace trocar {

/// Bytes free where the folder is, or will be; the largest number when the system does not tell.
std::uintmax_t room_free(const std::filesystem::path& folder);

}  // namespace trocar
