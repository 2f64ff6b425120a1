#include "haptics/force_sensor/ati/ati_serial.h"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <utility>

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

AtiLine AtiFrames::at(std::size_t begin) const {
  AtiLine out;
  out.status = seen_[begin];
  for (std::size_t i = 0; i < out.counts.size(); ++i)
    out.counts[i] = static_cast<std::int16_t>(seen_[begin + 1 + 2 * i] << 8 | seen_[begin + 2 + 2 * i]);
  return out;
}

/// Whether a sound record begins there that goes on from the one before.
bool AtiFrames::goes_on(std::size_t begin) const {
  const AtiLine now = at(begin), before = at(begin - kBytes);
  bool goes = now.status == kSound;
  for (std::size_t i = 0; i < now.counts.size(); ++i)
    goes = goes && std::abs(now.counts[i] - before.counts[i]) <= kStep;
  return goes;
}

std::optional<AtiLine> AtiFrames::find() {
  if (filled_ < kSeen) return std::nullopt;
  std::optional<std::size_t> only;
  for (std::size_t begin = 0; begin < kBytes; ++begin) {
    if (seen_[begin + (kAgree - 2) * kBytes] != kSound || !goes_on(begin + (kAgree - 1) * kBytes)) continue;
    if (only) return std::nullopt;
    only = begin;
  }
  if (!only || seen_[*only] != kSound) return std::nullopt;
  for (std::size_t k = 1; k < kAgree; ++k)
    if (!goes_on(*only + k * kBytes)) return std::nullopt;
  since_ = kBytes - 1 - *only;
  return at(*only + (kAgree - 2) * kBytes);
}

std::optional<AtiLine> AtiFrames::push(std::uint8_t byte) {
  std::copy(seen_.begin() + 1, seen_.end(), seen_.begin());
  seen_.back() = byte;
  filled_ = std::min(filled_ + 1, kSeen);
  if (!since_) return find();
  if (++*since_ < kBytes) return std::nullopt;
  since_ = 0;
  if (goes_on(kSeen - kBytes)) return at(kSeen - 2 * kBytes);
  since_.reset();
  ++broken_;
  return std::nullopt;
}

/// @return 0, or what the system says of it.
int AtiSerial::open_port() {
  port_ = ::open(device_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  termios line = {};
  if (port_ < 0 || ::tcgetattr(port_, &line) != 0) {
    const int why = errno;
    close_port();
    return why;
  }
  ::cfmakeraw(&line);
  ::cfsetspeed(&line, B38400);
  line.c_cflag |= CLOCAL | CREAD;
  ::tcsetattr(port_, TCSANOW, &line);
  return 0;
}

void AtiSerial::close_port() {
  if (port_ >= 0) ::close(std::exchange(port_, -1));
}

AtiSerial::AtiSerial(const std::string& device, const WrenchStreamOptions& options, AtiRecords records)
    : WrenchStream(options), device_(device), records_(records) {
  if (const int why = open_port(); why != 0)
    throw EnvironmentError(
        "force sensor " + device + ": " + (why == ENOTTY ? "no serial line" : std::strerror(why)) +
        (why == EACCES ? "; put yourself into the group dialout: sudo usermod -aG dialout $USER" : ""));
  start();
}

AtiSerial::~AtiSerial() {
  stop();
  say("");
  close_port();
}

void AtiSerial::say(const char* command) {
  const std::string text = std::string(command) + "\r";
  if (::write(port_, text.data(), text.size()) < 0) return;  // heard as silence
}

void AtiSerial::begin() {
  line_.clear();
  frames_ = {};
  for (const char* command : {"", records_ == AtiRecords::kBinary ? "CD B" : "CD A", "CD R", "QS"}) say(command);
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
      if (port_ < 0 || (ready.revents & (POLLHUP | POLLERR | POLLNVAL))) {  // pulled out: not in a circle
        close_port();
        std::this_thread::sleep_for(std::chrono::milliseconds(kListen_ms));
        if (open_port() == 0) silent_s = options().silent_s;
      }
      continue;
    }
    silent_s = take_in(bytes.data(), static_cast<std::size_t>(got)) ? 0 : silent_s + 1e-3;
  }
}

/// @return whether a record was among them.
bool AtiSerial::take_binary(const char* bytes, std::size_t size) {
  bool whole = false;
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint64_t broken = frames_.broken();
    if (const std::optional<AtiLine> read = frames_.push(static_cast<std::uint8_t>(bytes[i]))) {
      take(read->counts, true);
      whole = true;
    } else if (frames_.broken() > broken) {
      count(&WrenchLink::malformed);
      take({}, false);  // saturated, or out of place: nothing holds until it is found again
    }
  }
  return whole;
}

/// @return whether a whole record was among them.
bool AtiSerial::take_in(const char* bytes, std::size_t size) {
  if (records_ == AtiRecords::kBinary) return take_binary(bytes, size);
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
