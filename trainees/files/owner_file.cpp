#include "trainees/files/owner_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace trocar {
namespace {

constexpr mode_t kFile = 0600, kFolder = 0700;

/// A pipe or terminal keeps its rights; a file system without any (FAT) has none to keep.
bool made(const std::filesystem::path& file, int flags) {
  const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOCTTY | flags, kFile);
  if (opened < 0) return false;
  struct stat about {};
  if (::fstat(opened, &about) == 0 && S_ISREG(about.st_mode)) [[maybe_unused]]
    const int narrowed = ::fchmod(opened, kFile);
  ::close(opened);
  return true;
}

}  // namespace

std::ofstream open_owner_file(const std::filesystem::path& file) {
  std::ofstream stream;
  if (made(file, 0))
    stream.open(file, std::ios::binary | std::ios::trunc);
  else
    stream.setstate(std::ios::failbit);
  return stream;
}

bool make_owner_file(const std::filesystem::path& file) { return made(file, O_EXCL); }

bool make_owner_folders(const std::filesystem::path& folder) {
  std::error_code error;
  if (folder.empty() || std::filesystem::is_directory(folder, error)) return true;
  if (folder.has_parent_path() && folder.parent_path() != folder && !make_owner_folders(folder.parent_path()))
    return false;
  if (::mkdir(folder.c_str(), kFolder) != 0) return errno == EEXIST && std::filesystem::is_directory(folder, error);
  return ::chmod(folder.c_str(), kFolder) == 0;
}

}  // namespace trocar
