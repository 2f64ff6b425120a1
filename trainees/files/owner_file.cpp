#include "trainees/files/owner_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace trocar {
namespace {

constexpr mode_t kFile = 0600, kFolder = 0700, kOthers = 0077;

/// A pipe or terminal keeps its rights; a file system without any (FAT) has none to keep.
bool made(const std::filesystem::path& file) {
  const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOCTTY, kFile);
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
  if (made(file))
    stream.open(file, std::ios::binary | std::ios::trunc);
  else
    stream.setstate(std::ios::failbit);
  return stream;
}

bool make_owner_file(const std::filesystem::path& file) {
  // Not opened: closing a database's file drops the locks (POSIX) of every connection that this program has to it.
  return ::mknod(file.c_str(), S_IFREG | kFile, 0) == 0 && ::chmod(file.c_str(), kFile) == 0;
}

bool make_owner_folders(const std::filesystem::path& folder) {
  std::error_code error;
  if (folder.empty() || std::filesystem::is_directory(folder, error)) return true;
  if (folder.has_parent_path() && folder.parent_path() != folder && !make_owner_folders(folder.parent_path()))
    return false;
  if (::mkdir(folder.c_str(), kFolder) != 0) return errno == EEXIST && std::filesystem::is_directory(folder, error);
  return ::chmod(folder.c_str(), kFolder) == 0;
}

bool open_to_others(const std::filesystem::path& file) {
  struct stat about {};
  return ::stat(file.c_str(), &about) == 0 && about.st_uid == ::geteuid() && (about.st_mode & kOthers) != 0 &&
         (S_ISREG(about.st_mode) || S_ISDIR(about.st_mode));
}

void close_to_others(const std::filesystem::path& file) {
  struct stat about {};
  if (open_to_others(file) && ::stat(file.c_str(), &about) == 0) [[maybe_unused]]
    const int narrowed = ::chmod(file.c_str(), about.st_mode & 07777 & ~kOthers);
}

}  // namespace trocar
