#include "haptics/force_sensor/ati/ati_serial.h"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr int kListen_ms = 50;
constexpr std::size_t kLongestLine = 120;  // a line has 45 bytes

/// A status of which the controller says that a strain gauge is beyond its range, or the line is sick: any but 0.
constexpr int kSound = 0;

}  // namespace

WrenchStreamOptions nano25_options() {
  WrenchStreamOptions out;
  out.counts_per_n = 192;
  out.counts_per_nm = 10560;
  return out;
}

bool read_ati_line(const std::string& line, AtiLine& into) {
  const char *at = line.data(), *end = line.data() + line.size();
  std::array<std::int64_t, 7> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    while (at != end && *at == ' ') ++at;
    if (at != end && *at == '+') ++at;
    const auto read = std::from_chars(at, end, values[i]);
    if (read.ec != std::errc{} || values[i] < -32768 || values[i] > 32767) return false;
    at = read.ptr;
    while (at != end && *at == ' ') ++at;
    if (i + 1 < values.size() && (at == end || *at++ != ',')) return false;
  }
  if (at != end) return false;
  into.status = static_cast<int>(values[0]);
  std::copy(values.begin() + 1, values.end(), into.counts.begin());
  return true;
}

AtiSerial::AtiSerial(const std::string& device, const WrenchStreamOptions& options) : WrenchStream(options) {
  port_ = ::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  termios line = {};
  if (port_ < 0 || ::tcgetattr(port_, &line) != 0) {
    const int why = errno;
    if (port_ >= 0) ::close(port_);
    throw EnvironmentError(
        "force sensor " + device + ": " + (why == ENOTTY ? "no serial line" : std::strerror(why)) +
        (why == EACCES ? "; put yourself into the group dialout: sudo usermod -aG dialout $USER" : ""));
  }
  ::cfmakeraw(&line);
  ::cfsetspeed(&line, B38400);
  line.c_cflag |= CLOCAL | CREAD;
  ::tcsetattr(port_, TCSANOW, &line);
  start();
}

AtiSerial::~AtiSerial() {
  stop();
  say("");
  ::close(port_);
}

void AtiSerial::say(const char* command) {
  const std::string text = std::string(command) + "\r";
  if (::write(port_, text.data(), text.size()) < 0) return;  // heard as silence
}

void AtiSerial::begin() {
  line_.clear();
  for (const char* command : {"", "CD A", "CD R", "QS"}) say(command);
  count(&WrenchLink::begun);
}

void AtiSerial::listen() {
  std::array<char, 256> bytes{};
  double silent_s = options().silent_s;
  while (!ends()) {
    if (silent_s >= options().silent_s) {
      begin();
      silent_s = 0;
    }
    pollfd ready = {port_, POLLIN, 0};
    const bool there = ::poll(&ready, 1, kListen_ms) > 0 && (ready.revents & POLLIN);
    const ssize_t got = there ? ::read(port_, bytes.data(), bytes.size()) : 0;
    if (got <= 0) {
      silent_s += 1e-3 * kListen_ms;
      if (ready.revents & (POLLHUP | POLLERR))
        std::this_thread::sleep_for(std::chrono::milliseconds(kListen_ms));  // nobody at the other end: not in a circle
      continue;
    }
    silent_s = take_in(bytes.data(), static_cast<std::size_t>(got)) ? 0 : silent_s + 1e-3;
  }
}

/// @return whether a whole line was among them.
bool AtiSerial::take_in(const char* bytes, std::size_t size) {
  bool whole = false;
  for (std::size_t i = 0; i < size; ++i) {
    const char c = bytes[i];
    if (c != '\r' && c != '\n') {
      if (line_.size() <= kLongestLine) line_ += c;
      continue;
    }
    AtiLine read;
    if (read_ati_line(line_, read)) {
      take(read.counts, read.status == kSound);
      whole = true;
    } else if (line_.find(',') != std::string::npos || line_.size() > kLongestLine) {
      count(&WrenchLink::malformed);  // what is no record at all (an echo, a prompt) is none that was broken
    }
    line_.clear();
  }
  return whole;
}

}  // namespace trocar
