#include "trainees/desk/server/socket_owner.h"

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

namespace trocar::review {
namespace {

/// As the table writes it: the address as a number of the machine's own byte order.
std::string end_text(const SocketEnd& end) {
  char out[16];
  std::snprintf(out, sizeof out, "%08X:%04X", static_cast<unsigned>(end.address), static_cast<unsigned>(end.port));
  return out;
}

}  // namespace

std::optional<unsigned> socket_owner(std::istream& table, const SocketEnd& local, const SocketEnd& remote) {
  const std::string here = end_text(local), there = end_text(remote);
  std::string line;
  std::getline(table, line);  // names of the columns
  while (std::getline(table, line)) {
    std::istringstream row(line);
    std::string number, from, to, state, queues, timer, retransmissions;
    unsigned user = 0;
    if (!(row >> number >> from >> to) || from != here || to != there) continue;
    // 01: established. A socket that has been closed is shown as root's.
    if (row >> state >> queues >> timer >> retransmissions >> user && state == "01") return user;
  }
  return {};
}

std::optional<unsigned> socket_owner(const SocketEnd& local, const SocketEnd& remote) {
  std::ifstream table("/proc/net/tcp");
  return socket_owner(table, local, remote);
}

}  // namespace trocar::review
