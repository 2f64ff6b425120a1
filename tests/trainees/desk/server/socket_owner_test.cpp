// Whose socket it is: a table as Linux writes it, and a real connection of this test.
#include "trainees/desk/server/socket_owner.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <sstream>

namespace trocar::review::socket_owner_test {
namespace {

constexpr const char kTable[] =
    "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode\n"
    "   0: 0100007F:21C2 00000000:0000 0A 00000000:00000000 00:00000000 00000000  1000        0 12345 1 0 100 0 0 10 "
    "0\n"
    "   1: 0100007F:C350 0100007F:21C2 01 00000000:00000000 00:00000000 00000000  1001        0 12346 1 0 20 4 30 10 "
    "-1\n"
    "   2: 0100007F:C351 0100007F:21C2 06 00000000:00000000 03:00000f00 00000000     0        0 0 3 0\n"
    "   3: broken\n";

std::optional<unsigned> owner(std::uint16_t local, std::uint16_t remote) {
  std::istringstream table(kTable);
  const std::uint32_t loopback = htonl(INADDR_LOOPBACK);
  return socket_owner(table, {loopback, local}, {loopback, remote});
}

TEST(SocketOwner, ReadsTheTable) {
  EXPECT_EQ(owner(0xC350, 0x21C2), 1001U);
  EXPECT_FALSE(owner(0x21C2, 0xC350)) << "the other end is another row";
  EXPECT_FALSE(owner(0xC352, 0x21C2));
  EXPECT_FALSE(owner(0xC351, 0x21C2)) << "a connection that is over belongs to nobody";
  std::istringstream nothing("");
  EXPECT_FALSE(socket_owner(nothing, {}, {}));
}

TEST(SocketOwner, KnowsARealConnection) {
  const int listener = ::socket(AF_INET, SOCK_STREAM, 0), client = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in server{}, mine{};
  server.sin_family = AF_INET;
  server.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof server;
  ASSERT_EQ(::bind(listener, reinterpret_cast<sockaddr*>(&server), size), 0);
  ASSERT_EQ(::listen(listener, 1), 0);
  ASSERT_EQ(::getsockname(listener, reinterpret_cast<sockaddr*>(&server), &size), 0);
  ASSERT_EQ(::connect(client, reinterpret_cast<sockaddr*>(&server), size), 0);
  ASSERT_EQ(::getsockname(client, reinterpret_cast<sockaddr*>(&mine), &size), 0);
  const auto found =
      socket_owner({mine.sin_addr.s_addr, ntohs(mine.sin_port)}, {server.sin_addr.s_addr, ntohs(server.sin_port)});
  if (::access("/proc/net/tcp", R_OK) == 0) {
    EXPECT_EQ(found, static_cast<unsigned>(::geteuid()));
  } else {
    EXPECT_FALSE(found);
  }
  ::close(client);
  ::close(listener);
}

}  // namespace
}  // namespace trocar::review::socket_owner_test
