#include "tissue/organ/staged_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "haptics/input_error.h"
#include "tissue/organ/file_lock.h"

namespace trocar {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int code) {
  throw EnvironmentError(path.string() + ": cannot be written: " + std::strerror(code));
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
  descriptor_ = open_locked(temporary_, target_);
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
