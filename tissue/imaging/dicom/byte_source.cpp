#include "tissue/imaging/dicom/byte_source.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr std::size_t kWindow = 16384;

}  // namespace

ByteSource::ByteSource(const std::filesystem::path& path, std::string name) : name_(std::move(name)) {
  file_ = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  struct stat facts {};
  const bool usable = file_ >= 0 && fstat(file_, &facts) == 0 && S_ISREG(facts.st_mode);
  if (!usable) {
    if (file_ >= 0) close(file_);
    throw InputError(name_ + ": cannot be opened as a file");
  }
  size_ = static_cast<std::uint64_t>(facts.st_size);
}

ByteSource::ByteSource(std::string bytes, std::string name)
    : name_(std::move(name)), memory_(std::move(bytes)), size_(memory_.size()) {}

ByteSource::~ByteSource() {
  if (file_ >= 0) close(file_);
}

void ByteSource::read_file(std::uint64_t at, void* into, std::size_t count) const {
  auto* to = static_cast<char*>(into);
  while (count > 0) {
    const ssize_t got = pread(file_, to, count, static_cast<off_t>(at));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw InputError(name_ + ": cannot be read to its end");
    to += got, at += static_cast<std::uint64_t>(got), count -= static_cast<std::size_t>(got);
  }
}

void ByteSource::fill(std::uint64_t at) {
  window_at_ = at;
  window_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kWindow, size_ - at)));
  read_file(at, window_.data(), window_.size());
}

bool ByteSource::read(std::uint64_t at, void* into, std::size_t count) {
  if (at > size_ || count > size_ - at) return false;
  if (count == 0) return true;
  if (file_ < 0) {
    std::memcpy(into, memory_.data() + at, count);
  } else if (count > kWindow) {
    read_file(at, into, count);
  } else {
    if (at < window_at_ || at + count > window_at_ + window_.size()) fill(at);
    std::memcpy(into, window_.data() + (at - window_at_), count);
  }
  return true;
}

std::string ByteSource::bytes(std::uint64_t at, std::size_t count) {
  if (at > size_ || count > size_ - at) throw InputError(name_ + ": ends before its data do");
  std::string result(count, '\0');
  read(at, result.data(), count);
  return result;
}

}  // namespace trocar
