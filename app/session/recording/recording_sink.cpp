#include "app/session/recording/recording_sink.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "haptics/input_error.h"
#include "trainees/files/owner_file.h"

namespace trocar {

FileSink::FileSink(std::filesystem::path file) : file_(std::move(file)) {
  if (!make_owner_folders(file_.parent_path())) fail("its folder cannot be created", errno);
  // Created here and nowhere else: two at once with one name may not write into each other. What is no file (a pipe, a
  // device) has nothing to lose.
  std::error_code error;
  const bool plain = !std::filesystem::exists(file_, error) || std::filesystem::is_regular_file(file_, error);
  descriptor_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (plain ? O_EXCL : O_TRUNC), 0600);
  if (descriptor_ < 0) fail("the recording cannot be created", errno);
}

FileSink::~FileSink() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void FileSink::append(std::string_view bytes) {
  std::string_view rest = bytes;
  while (!rest.empty()) {
    const ssize_t count = ::write(descriptor_, rest.data(), rest.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int reason = errno;
      // Best effort: without the half-written chunk the file ends cleanly; with it, it reads as torn.
      if (::ftruncate(descriptor_, written_) == 0) ::lseek(descriptor_, written_, SEEK_SET);
      fail("the recording cannot be written", reason);
    }
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
  written_ += static_cast<long long>(bytes.size());
}

void FileSink::sync() {
  // EINVAL, ENOTSUP: a pipe or a device that has nothing to synchronise.
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP) {
    fail("the recording cannot be brought to the disk", errno);
  }
}

void FileSink::fail(const char* what, int error_number) {
  throw EnvironmentError(file_.string() + ": " + what + ": " + std::generic_category().message(error_number));
}

}  // namespace trocar
