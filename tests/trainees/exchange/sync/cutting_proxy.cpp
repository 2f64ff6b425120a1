#include "tests/trainees/exchange/sync/cutting_proxy.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace trocar::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSocket = ".s.PGSQL.5432";

sockaddr_un address_of(const fs::path& folder) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, (folder / kSocket).c_str(), sizeof address.sun_path - 1);
  return address;
}

}  // namespace

CuttingProxy::CuttingProxy(const PostgresServer& server)
    : server_(server.folder()), folder_(fs::temp_directory_path() / ("trocar_cut_" + std::to_string(getpid()))) {
  fs::create_directories(folder_);
  fs::remove(folder_ / kSocket);
  listener_ = ::socket(AF_UNIX, SOCK_STREAM, 0);
  const sockaddr_un address = address_of(folder_);
  if (::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) std::abort();
  ::listen(listener_, 16);
  thread_ = std::thread([this] { listen(); });
}

CuttingProxy::~CuttingProxy() {
  ends_ = true;
  thread_.join();
  for (std::thread& relay : relays_) relay.join();
  ::close(listener_);
  fs::remove_all(folder_);
}

CentralAddress CuttingProxy::through(const CentralAddress& address) const {
  CentralAddress other = address;
  other.url.replace(other.url.find(server_.string()), server_.string().size(), folder_.string());
  return other;
}

void CuttingProxy::listen() {
  while (!ends_) {
    pollfd wanted{listener_, POLLIN, 0};
    if (::poll(&wanted, 1, 20) <= 0) continue;
    const int client = ::accept(listener_, nullptr, nullptr);
    if (client >= 0) relays_.emplace_back([this, client] { relay(client); });
  }
}

bool CuttingProxy::pass(int from, int to) {
  std::array<char, 4096> buffer;
  const ssize_t got = ::read(from, buffer.data(), buffer.size());
  if (got <= 0) return false;
  long may = left_;
  while (may != kEndless && !left_.compare_exchange_weak(may, std::max(0L, may - got))) {
  }
  const ssize_t sent = std::min<ssize_t>(got, may);
  passed_ += sent;
  for (ssize_t done = 0; done < sent;) {
    const ssize_t written = ::send(to, buffer.data() + done, static_cast<std::size_t>(sent - done), MSG_NOSIGNAL);
    if (written <= 0) return false;
    done += written;
  }
  return sent == got;
}

void CuttingProxy::relay(int client) {
  const int server = ::socket(AF_UNIX, SOCK_STREAM, 0);
  const sockaddr_un address = address_of(server_);
  bool open = ::connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  while (open && !ends_) {
    std::array<pollfd, 2> wanted{{{client, POLLIN, 0}, {server, POLLIN, 0}}};
    if (left_ == 0) break;
    if (::poll(wanted.data(), 2, 20) <= 0) continue;
    if (wanted[0].revents != 0) open = pass(client, server);
    if (open && wanted[1].revents != 0) open = pass(server, client);
  }
  ::close(server);
  ::close(client);
}

}  // namespace trocar::test
