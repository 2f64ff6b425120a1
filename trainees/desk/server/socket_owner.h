// Which user of this machine a loopback connection comes from: the table of TCP sockets that Linux shows in
// /proc/net/tcp.
//
// Thread: any.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>

namespace trocar::review {

struct SocketEnd {
  std::uint32_t address = 0;  ///< IPv4 in network order, as in sockaddr_in
  std::uint16_t port = 0;     ///< in host order
};

/// Number of the user whose socket is at `local` and connected to `remote`; nothing when the table has no such socket.
std::optional<unsigned> socket_owner(const SocketEnd& local, const SocketEnd& remote);
/// The same from a table that has been opened.
std::optional<unsigned> socket_owner(std::istream& table, const SocketEnd& local, const SocketEnd& remote);

}  // namespace trocar::review
