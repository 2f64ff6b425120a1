#include "haptics/device/hostmot2/udp_link.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

#include "haptics/input_error.h"

namespace trocar {
namespace {

sockaddr_in address_of(const std::string& text, const std::string& name) {
  sockaddr_in out = {};
  out.sin_family = AF_INET;
  const std::size_t colon = text.find(':');
  std::uint16_t port = lbp16::kPort;
  if (colon != std::string::npos) {
    const char *begin = text.data() + colon + 1, *end = text.data() + text.size();
    const auto read = std::from_chars(begin, end, port);
    if (read.ec != std::errc{} || read.ptr != end || port == 0)
      throw InputError(name + ": behind the colon a port from 1 to 65535 is expected");
  }
  out.sin_port = htons(port);
  if (inet_pton(AF_INET, text.substr(0, colon).c_str(), &out.sin_addr) != 1)
    throw InputError(name + ": an address such as 192.168.1.121 is expected");
  return out;
}

}  // namespace

UdpLink::UdpLink(const std::string& address, const std::string& name) {
  const sockaddr_in peer = address_of(address, name);
  socket_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket_ < 0 || ::connect(socket_, reinterpret_cast<const sockaddr*>(&peer), sizeof peer) != 0) {
    const std::string why = std::strerror(errno);
    if (socket_ >= 0) ::close(std::exchange(socket_, -1));
    throw EnvironmentError(name + ": no way to it: " + why);
  }
}

UdpLink UdpLink::on_loopback() {
  UdpLink out;
  out.connected_ = false;
  out.socket_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in own = {};
  own.sin_family = AF_INET;
  own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (out.socket_ < 0 || ::bind(out.socket_, reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0)
    throw EnvironmentError(std::string("no UDP port on the loopback: ") + std::strerror(errno));
  return out;
}

UdpLink::~UdpLink() {
  if (socket_ >= 0) ::close(socket_);
}

UdpLink::UdpLink(UdpLink&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)),
      connected_(other.connected_),
      peer_address_(other.peer_address_),
      peer_port_(other.peer_port_) {}

std::uint16_t UdpLink::port() const noexcept {
  sockaddr_in own = {};
  socklen_t size = sizeof own;
  return ::getsockname(socket_, reinterpret_cast<sockaddr*>(&own), &size) == 0 ? ntohs(own.sin_port) : 0;
}

std::string UdpLink::peer() const {
  sockaddr_in to = {};
  socklen_t size = sizeof to;
  std::array<char, INET_ADDRSTRLEN> text{};
  if (::getpeername(socket_, reinterpret_cast<sockaddr*>(&to), &size) != 0) return "";
  ::inet_ntop(AF_INET, &to.sin_addr, text.data(), text.size());
  return std::string(text.data()) + ":" + std::to_string(ntohs(to.sin_port));
}

bool UdpLink::send(const lbp16::Datagram& datagram) noexcept {
  sockaddr_in peer = {};
  peer.sin_family = AF_INET;
  peer.sin_addr.s_addr = peer_address_;
  peer.sin_port = peer_port_;
  const auto* to = connected_ ? nullptr : reinterpret_cast<const sockaddr*>(&peer);
  // A reply that an earlier one provoked (port closed) stands in the way once: it says nothing about this one.
  for (int tries = 0; tries < 2; ++tries) {
    const ssize_t sent =
        ::sendto(socket_, datagram.data(), datagram.size(), MSG_DONTWAIT, to, to ? sizeof peer : socklen_t{0});
    if (sent == static_cast<ssize_t>(datagram.size())) return true;
    if (errno != ECONNREFUSED) return false;
  }
  return false;
}

bool UdpLink::receive(lbp16::Datagram& into, double wait_s) noexcept {
  pollfd ready = {socket_, POLLIN, 0};
  timespec wait = {};
  wait.tv_sec = static_cast<time_t>(wait_s);
  wait.tv_nsec = static_cast<long>(1e9 * (wait_s - std::floor(wait_s)));
  if (::ppoll(&ready, 1, &wait, nullptr) <= 0) return false;
  sockaddr_in peer = {};
  socklen_t size = sizeof peer;
  const ssize_t got = ::recvfrom(socket_, into.data(), lbp16::kMostBytes, MSG_DONTWAIT | MSG_TRUNC,
                                 reinterpret_cast<sockaddr*>(&peer), &size);
  if (got < 0 || static_cast<std::size_t>(got) > lbp16::kMostBytes) return false;
  into.resize(static_cast<std::size_t>(got));
  if (!connected_) {
    peer_address_ = peer.sin_addr.s_addr;
    peer_port_ = peer.sin_port;
  }
  return true;
}

PeerClaim::PeerClaim(const UdpLink& link, const std::string& name)
    : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  // A name that is no file (it begins with a zero byte): it goes with the program.
  sockaddr_un claimed = {.sun_family = AF_UNIX, .sun_path = {}};
  const std::string text = "trocar card " + link.peer();
  text.copy(&claimed.sun_path[1], sizeof claimed.sun_path - 1);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + text.size());
  if (socket_ >= 0 && ::bind(socket_, reinterpret_cast<const sockaddr*>(&claimed), size) == 0) return;
  const bool taken = errno == EADDRINUSE;
  const std::string why = std::strerror(errno);
  if (socket_ >= 0) ::close(socket_);
  throw EnvironmentError(name +
                         (taken ? ": another program has it; end that one first" : ": cannot be claimed: " + why));
}

PeerClaim::~PeerClaim() { ::close(socket_); }

}  // namespace trocar
