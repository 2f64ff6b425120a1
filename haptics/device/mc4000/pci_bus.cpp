#include "haptics/device/mc4000/pci_bus.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <filesystem>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr const char* kNodes = "/dev/uio";
constexpr off_t kCommandHigh = 5;  // in a device's configuration
constexpr std::uint8_t kInterruptDisable = 1u << 2;

int open_node(const std::filesystem::path& file) {
  const int opened = ::open(file.c_str(), O_RDWR | O_SYNC | O_CLOEXEC);
  if (opened >= 0) return opened;
  const int why = errno;
  throw EnvironmentError(
      "board " + file.string() + ": " + std::strerror(why) +
      (why == EACCES || why == EPERM
           ? "; its memory belongs to root: run as root, or let a udev rule give the device to your group"
       : why == ENOENT ? "; lspci -D lists the boards of this computer"
                       : ""));
}

timespec time_of(double seconds) {
  const double whole = std::floor(seconds);
  return {static_cast<std::time_t>(whole), static_cast<long>(1e9 * (seconds - whole))};
}

}  // namespace

PciBus::Opened::~Opened() {
  if (file >= 0) ::close(file);
}

std::filesystem::path board_registers(const std::string& device) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (device.starts_with(kNodes)) return fs::path("/sys/class/uio") / fs::path(device).filename() / "device/resource0";
  return fs::is_directory(device, error) ? fs::path(device) / "resource0" : fs::path(device);
}

PciBus::PciBus(const std::string& device, double rate_hz, const std::string& interrupt) : PolledBus(rate_hz) {
  const std::filesystem::path file = board_registers(device);
  const std::string& node = device.starts_with(kNodes) ? device : interrupt;
  if (!node.empty()) {
    node_.file = open_node(node);
    config_.file = ::open((file.parent_path() / "config").c_str(), O_RDWR | O_CLOEXEC);
    if (::pread(config_.file, &command_high_, 1, kCommandHigh) == 1)
      command_high_ = static_cast<std::uint8_t>(command_high_ & ~kInterruptDisable);
  }
  registers_.file = open_node(file);
  if (::flock(registers_.file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw EnvironmentError("board " + file.string() + ": another program has it; end that one first");
  struct stat facts = {};
  bytes_ = ::fstat(registers_.file, &facts) == 0 ? static_cast<std::size_t>(facts.st_size) : 0;
  if (bytes_ < kLeastBoardBytes)
    throw EnvironmentError("board " + file.string() + ": only " + std::to_string(bytes_) + " bytes of registers");
  memory_ = ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED, registers_.file, 0);
  if (memory_ == MAP_FAILED) throw EnvironmentError("board " + file.string() + ": " + std::strerror(errno));
}

PciBus::~PciBus() { ::munmap(memory_, bytes_); }

std::uint32_t PciBus::read(std::uint32_t word) noexcept {
  if (4 * std::size_t{word} + 4 > bytes_) return ~0U;  // as a bus without a board answers
  return static_cast<const volatile std::uint32_t*>(memory_)[word];
}

void PciBus::write(std::uint32_t word, std::uint32_t value) noexcept {
  if (4 * std::size_t{word} + 4 > bytes_) return;
  static_cast<volatile std::uint32_t*>(memory_)[word] = value;
  static_cast<void>(static_cast<const volatile std::uint32_t*>(memory_)[word]);
}

double PciBus::now_s() noexcept {
  timespec now = {};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Interrupts on again. @return false: by neither way.
bool PciBus::unmask() noexcept {
  const std::uint32_t enable = 1;
  return ::pwrite(config_.file, &command_high_, 1, kCommandHigh) == 1 ||
         ::write(node_.file, &enable, sizeof enable) == sizeof enable;
}

void PciBus::rest(double look_s, double limit_s) noexcept {
  const double now = now_s();
  if (hears_interrupt() && unmask()) {
    const timespec most = time_of(std::max(0.0, limit_s - now));
    pollfd ready = {node_.file, POLLIN, 0};
    std::uint32_t count = 0;
    if (::ppoll(&ready, 1, &most, nullptr) > 0) static_cast<void>(::read(node_.file, &count, sizeof count) > 0);
  } else if (look_s > now) {
    const timespec until = time_of(look_s);
    ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
  }
}

}  // namespace trocar
