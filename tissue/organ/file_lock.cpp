#include "tissue/organ/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "haptics/input_error.h"

namespace trocar {
namespace {

[[noreturn]] void refuse_lock(const std::filesystem::path& target, int code) {
  if (code == EWOULDBLOCK) throw EnvironmentError(target.string() + ": another program is just writing it");
  throw EnvironmentError(target.string() + ": cannot be written: " + std::strerror(code));
}

void make_folders(const std::filesystem::path& folder, std::vector<std::filesystem::path>* made) {
  if (folder.empty()) return;
  std::error_code error;
  std::vector<std::filesystem::path> missing;
  for (std::filesystem::path at = folder; !at.empty() && !std::filesystem::exists(at, error); at = at.parent_path())
    missing.push_back(at);
  std::filesystem::create_directories(folder, error);
  if (error) refuse_lock(folder, error.value());
  if (made != nullptr) made->insert(made->end(), missing.begin(), missing.end());
}

/// Whether the path still names the open file.
bool names(const std::filesystem::path& file, int descriptor) {
  struct stat open = {}, named = {};
  return ::fstat(descriptor, &open) == 0 && ::stat(file.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
         open.st_ino == named.st_ino;
}

}  // namespace

int open_locked(const std::filesystem::path& file, const std::filesystem::path& target,
                std::vector<std::filesystem::path>* made) {
  constexpr int kTries = 100;  // each but the first after another program removed or renamed what was opened
  bool folder_went = false;
  for (int n = 0; n < kTries; ++n) {
    make_folders(file.parent_path(), made);
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
    folder_went = descriptor < 0 && errno == ENOENT;
    if (folder_went) continue;
    if (descriptor < 0) refuse_lock(target, errno);
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      const int code = errno;
      ::close(descriptor);
      refuse_lock(target, code);
    }
    if (names(file, descriptor)) return descriptor;
    ::close(descriptor);
  }
  refuse_lock(target, folder_went ? ENOENT : EWOULDBLOCK);
}

NameLock::NameLock(const std::filesystem::path& stem)
    : file_(stem.parent_path() / ("." + stem.filename().string() + ".lock")) {
  descriptor_ = open_locked(file_, stem, &made_);
}

NameLock::~NameLock() {
  ::unlink(file_.c_str());
  ::close(descriptor_);
  for (const std::filesystem::path& folder : made_) ::rmdir(folder.c_str());  // only empty ones go
}

}  // namespace trocar
