#include "haptics/device/mc4000/pci_bus.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr std::size_t kLeastBytes = 4 * 0x60;  // table 3.1 of the thesis
constexpr std::size_t kUioBytes = 4096;
constexpr int kLongest_ms = 20;  // for an interrupt

std::int64_t periods_now(double period_s) {
  timespec now = {};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>((static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec)) /
                                   period_s);
}

}  // namespace

PciBus::PciBus(const std::string& device, double rate_hz) : period_s_(1 / rate_hz) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path file = fs::is_directory(device, error) ? fs::path(device) / "resource0" : fs::path(device);
  counts_interrupts_ = file.string().starts_with("/dev/uio");
  file_ = ::open(file.c_str(), O_RDWR | O_SYNC | O_CLOEXEC);
  if (file_ < 0) {
    const int why = errno;
    throw EnvironmentError(
        "board " + file.string() + ": " + std::strerror(why) +
        (why == EACCES || why == EPERM
             ? "; its memory belongs to root: run as root, or let a udev rule give the device to your group"
         : why == ENOENT ? "; lspci -D lists the boards of this computer"
                         : ""));
  }
  struct stat facts = {};
  bytes_ = counts_interrupts_ ? kUioBytes : ::fstat(file_, &facts) == 0 ? static_cast<std::size_t>(facts.st_size) : 0;
  memory_ = bytes_ < kLeastBytes ? MAP_FAILED : ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
  if (memory_ == MAP_FAILED) {
    const std::string why =
        bytes_ < kLeastBytes ? "only " + std::to_string(bytes_) + " bytes of registers" : std::strerror(errno);
    ::close(file_);
    throw EnvironmentError("board " + file.string() + ": " + why);
  }
  periods_ = periods_now(period_s_);
}

PciBus::~PciBus() {
  ::munmap(memory_, bytes_);
  ::close(file_);
}

std::uint32_t PciBus::read(std::uint32_t word) noexcept {
  if (4 * std::size_t{word} + 4 > bytes_) return ~0U;  // as a bus without a board answers
  return static_cast<const volatile std::uint32_t*>(memory_)[word];
}

void PciBus::write(std::uint32_t word, std::uint32_t value) noexcept {
  if (4 * std::size_t{word} + 4 > bytes_) return;
  static_cast<volatile std::uint32_t*>(memory_)[word] = value;
  static_cast<void>(static_cast<const volatile std::uint32_t*>(memory_)[word]);
}

std::uint32_t PciBus::await_sync() noexcept {
  if (!counts_interrupts_) {
    const std::int64_t now = periods_now(period_s_), passed = now - periods_;
    periods_ = now;
    return static_cast<std::uint32_t>(passed);
  }
  const std::uint32_t enable = 1;
  if (::write(file_, &enable, sizeof enable) != sizeof enable) return 0;
  pollfd ready = {file_, POLLIN, 0};
  std::uint32_t count = interrupts_;
  if (::poll(&ready, 1, kLongest_ms) <= 0 || ::read(file_, &count, sizeof count) != sizeof count) return 0;
  const std::uint32_t passed = interrupts_ == 0 ? 1 : count - interrupts_;
  interrupts_ = count;
  return passed;
}

}  // namespace trocar
