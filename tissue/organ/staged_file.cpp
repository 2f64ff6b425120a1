#include "tissue/organ/staged_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "haptics/input_error.h"

namespace trocar {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int code) {
  throw EnvironmentError(path.string() + ": cannot be written: " + std::strerror(code));
}

void make_folder(const std::filesystem::path& target) {
  if (!target.has_parent_path()) return;
  std::error_code error;
  std::filesystem::create_directories(target.parent_path(), error);
  if (error) fail(target.parent_path(), error.value());
}

/// @return 0, or the errno of the first step that failed
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::fsync(descriptor) == 0 ? 0 : errno;
}

}  // namespace

StagedFile::StagedFile(std::filesystem::path target, std::string_view bytes)
    : target_(std::move(target)), temporary_(target_.string() + ".part") {
  make_folder(target_);
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0) fail(target_, errno);
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor_);
    throw EnvironmentError(target_.string() + ": another program is just writing it");
  }
  int code = ::ftruncate(descriptor_, 0) == 0 ? 0 : errno;
  if (code == 0) code = write_all(descriptor_, bytes);
  if (code == 0) return;
  ::unlink(temporary_.c_str());
  ::close(descriptor_);
  fail(target_, code);
}

StagedFile::~StagedFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  if (descriptor_ >= 0) ::close(descriptor_);
}

void StagedFile::commit() {
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(target_, errno);
  temporary_.clear();
}

}  // namespace trocar
