// Files and folders that hold somebody's data: for the eyes of their owner alone (0600, 0700), whatever the umask, as
// far as the file system knows rights. What is there already is narrowed, never widened. Thread: any.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>

namespace trocar {

/// Bytes; a minute has 4 MiB at most. What is larger is no recording, and nobody reads it to its end.
inline constexpr std::uintmax_t kLargestRecording = std::uintmax_t{1} << 30;

/// A fresh or emptied file, open for writing; the stream tells whether it could be opened, errno why not.
std::ofstream open_owner_file(const std::filesystem::path& file);

/// A file that must not be there yet. @returns false when it is, or cannot be made; errno says why.
bool make_owner_file(const std::filesystem::path& file);

/// Folders that are missing on the way, each for its owner alone; those that exist stay as they are. @returns false:
/// errno says why not.
bool make_owner_folders(const std::filesystem::path& folder);

/// A file or folder of this program's user that others may open in any way; links are followed.
bool open_to_others(const std::filesystem::path& file);

/// Takes the rights of others away from such a one.
void close_to_others(const std::filesystem::path& file);

}  // namespace trocar
