#include "haptics/force_sensor/ati/net_ft_counts.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <sstream>

#include "haptics/force_sensor/ati/wrench_stream.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr std::uint32_t kAnswerHeader = 0x1234;
constexpr std::uint8_t kReadCalibration = 1;
constexpr std::size_t kQuestionBytes = 20, kAnswerBytes = 24;

// By the box's codes, from 1.
constexpr double kPound = 4.4482216152605, kKilogram = 9.80665, kInch = 0.0254, kFoot = 0.3048;
constexpr std::array kForceUnits{kPound, 1.0, 1e3 * kPound, 1e3, kKilogram, 1e-3 * kKilogram};       // N
constexpr std::array kTorqueUnits{kPound * kInch, kPound* kFoot, 1.0, 1e-3, 1e-2 * kKilogram, 1e3};  // N m

std::uint16_t port_of(const std::string& text, const std::string& box) {
  std::uint16_t port = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), port);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size() || port == 0)
    throw InputError("force sensor net-ft:" + box + ": behind a colon a port from 1 to 65535 is expected");
  return port;
}

class TcpSocket {
 public:
  TcpSocket() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {}
  ~TcpSocket() {
    if (socket_ >= 0) ::close(socket_);
  }
  TcpSocket(const TcpSocket&) = delete;
  TcpSocket(TcpSocket&&) = delete;
  TcpSocket& operator=(const TcpSocket&) = delete;
  TcpSocket& operator=(TcpSocket&&) = delete;
  operator int() const { return socket_; }

 private:
  int socket_;
};

/// Until the socket is ready. @return false: it was not in time.
bool await(int socket, short what, std::int64_t until_ns) {
  for (;;) {
    const std::int64_t left_ns = until_ns - monotonic_ns();
    if (left_ns <= 0) return false;
    pollfd one = {socket, what, 0};
    const int got = ::poll(&one, 1, static_cast<int>(left_ns / 1'000'000 + 1));
    if (got > 0) return true;
    if (got < 0 && errno != EINTR) return false;
  }
}

using Answer = std::array<std::uint8_t, kAnswerBytes>;

/// @return what is wrong; empty: the answer is whole.
std::string ask(const NetFtAddress& box, double wait_s, Answer& answer) {
  std::ostringstream late;
  late << "says nothing within " << wait_s << " s: is it powered, and is this its address?";
  const std::int64_t until_ns = monotonic_ns() + static_cast<std::int64_t>(1e9 * wait_s);
  sockaddr_in peer = {};
  peer.sin_family = AF_INET;
  peer.sin_port = htons(box.tcp);
  ::inet_pton(AF_INET, box.host.c_str(), &peer.sin_addr);
  const TcpSocket socket;
  if (socket < 0) return std::strerror(errno);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&peer), sizeof peer) != 0) {
    if (errno != EINPROGRESS) return std::strerror(errno);
    if (!await(socket, POLLOUT, until_ns)) return late.str();
    int why = 0;
    socklen_t size = sizeof why;
    ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &why, &size);
    if (why != 0) return std::strerror(why);
  }
  const std::array<std::uint8_t, kQuestionBytes> question{kReadCalibration};
  if (::send(socket, question.data(), question.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(question.size()))
    return std::strerror(errno);
  for (std::size_t heard = 0; heard < answer.size();) {
    if (!await(socket, POLLIN, until_ns))
      return heard == 0 ? late.str() : "broke off after " + std::to_string(heard) + " of 24 bytes";
    const ssize_t got = ::recv(socket, answer.data() + heard, answer.size() - heard, 0);
    if (got == 0) return "closed the connection after " + std::to_string(heard) + " of 24 bytes";
    if (got > 0)
      heard += static_cast<std::size_t>(got);
    else if (errno != EAGAIN && errno != EINTR)
      return std::strerror(errno);
  }
  return "";
}

std::uint32_t big_endian(const Answer& answer, std::size_t at, std::size_t bytes) {
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < bytes; ++i) out = out << 8 | answer[at + i];
  return out;
}

/// @return what is wrong with them; empty: nothing.
std::string read_counts(const Answer& answer, NetFtCounts& into) {
  const std::uint32_t force_unit = answer[2], torque_unit = answer[3];
  const std::uint32_t force = big_endian(answer, 4, 4), torque = big_endian(answer, 8, 4);
  if (big_endian(answer, 0, 2) != kAnswerHeader) return "does not begin its answer with 0x1234: no Net F/T box";
  if (force_unit < 1 || force_unit > kForceUnits.size())
    return "names a unit of force that nobody knows: " + std::to_string(force_unit);
  if (torque_unit < 1 || torque_unit > kTorqueUnits.size())
    return "names a unit of torque that nobody knows: " + std::to_string(torque_unit);
  if (force == 0 || torque == 0) return "says 0 counts a unit";
  into = {force / kForceUnits[force_unit - 1], torque / kTorqueUnits[torque_unit - 1]};
  return "";
}

}  // namespace

NetFtAddress net_ft_address(const std::string& box) {
  const std::size_t first = box.find(':'), second = first == std::string::npos ? first : box.find(':', first + 1);
  NetFtAddress out{box.substr(0, first)};
  in_addr ignored = {};
  if (::inet_pton(AF_INET, out.host.c_str(), &ignored) != 1)
    throw InputError("force sensor net-ft:" + box + ": an address such as 192.168.1.1 is expected");
  if (first != std::string::npos) out.udp = port_of(box.substr(first + 1, second - first - 1), box);
  if (second != std::string::npos) out.tcp = port_of(box.substr(second + 1), box);
  return out;
}

NetFtCounts net_ft_counts(const std::string& box, double wait_s) {
  const NetFtAddress address = net_ft_address(box);
  Answer answer{};
  NetFtCounts out;
  std::string wrong = ask(address, wait_s, answer);
  if (wrong.empty()) wrong = read_counts(answer, out);
  if (!wrong.empty())
    throw EnvironmentError(
        "force sensor net-ft:" + box + ": asked for its counts on TCP port " + std::to_string(address.tcp) + ": " +
        wrong +
        "; set that right, or write counts_per_n and counts_per_nm, as its web page has them, into [sensor] of the "
        "device file (--device)");
  return out;
}

}  // namespace trocar
