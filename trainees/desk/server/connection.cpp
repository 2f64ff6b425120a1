#include "trainees/desk/server/connection.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>

#include "trainees/desk/server/socket_owner.h"

namespace trocar::review {
namespace {

std::string address_text(const sockaddr_in& address) {
  char text[INET_ADDRSTRLEN] = "";
  return ::inet_ntop(AF_INET, &address.sin_addr, text, sizeof text) ? text : "";
}

std::optional<sockaddr_in> end_of(int socket, bool remote) {
  sockaddr_in out{};
  socklen_t size = sizeof out;
  auto* address = reinterpret_cast<sockaddr*>(&out);
  const int failed = remote ? ::getpeername(socket, address, &size) : ::getsockname(socket, address, &size);
  if (failed != 0 || out.sin_family != AF_INET) return {};
  return out;
}

long plain_some(int socket, bool writing, char* data, std::size_t count) {
  const ssize_t done = writing ? ::send(socket, data, count, MSG_NOSIGNAL) : ::recv(socket, data, count, 0);
  if (done >= 0) return static_cast<long>(done);
  if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)
    return writing ? Connection::kAgainToWrite : Connection::kAgainToRead;
  return -1;
}

}  // namespace

struct Connection::Tls {
  explicit Tls(SSL_CTX* context, int socket) : ssl(SSL_new(context)) {
    if (ssl) SSL_set_fd(ssl, socket);
  }
  ~Tls() { SSL_free(ssl); }
  Tls(const Tls&) = delete;
  Tls& operator=(const Tls&) = delete;

  /// What a call that gave `result` asks for.
  long outcome(int result) const {
    if (result > 0) return result;
    switch (SSL_get_error(ssl, result)) {
      case SSL_ERROR_WANT_READ:
        return kAgainToRead;
      case SSL_ERROR_WANT_WRITE:
        return kAgainToWrite;
      case SSL_ERROR_ZERO_RETURN:
        return 0;
      default:
        return -1;
    }
  }

  SSL* ssl;
  bool ready = false;
};

Connection::Connection(int socket, const TlsIdentity* tls) : socket_(socket) {
  ::fcntl(socket_, F_SETFL, ::fcntl(socket_, F_GETFL, 0) | O_NONBLOCK);
  const int yes = 1;
  ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  if (tls) tls_ = std::make_unique<Tls>(static_cast<SSL_CTX*>(tls->context()), socket_);
}

Connection::~Connection() {
  tls_.reset();
  ::close(socket_);
}

long Connection::greet() {
  if (!tls_) return 1;
  if (!tls_->ssl) return -1;
  ERR_clear_error();
  const long result = tls_->outcome(SSL_accept(tls_->ssl));
  tls_->ready = result > 0;
  return result;
}

long Connection::take(char* into, std::size_t most) {
  if (!tls_) return plain_some(socket_, false, into, most);
  ERR_clear_error();
  return tls_->outcome(SSL_read(tls_->ssl, into, static_cast<int>(most)));
}

long Connection::put(const char* from, std::size_t count) {
  if (!tls_) return plain_some(socket_, true, const_cast<char*>(from), count);  // never written to
  if (!tls_->ready) return -1;
  ERR_clear_error();
  return tls_->outcome(SSL_write(tls_->ssl, from, static_cast<int>(std::min<std::size_t>(count, 1U << 20U))));
}

void Connection::end() {
  if (tls_ && tls_->ready) SSL_shutdown(tls_->ssl);
  ::shutdown(socket_, SHUT_WR);
}

long Connection::drop() {
  char rest[4096];
  return plain_some(socket_, false, rest, sizeof rest);
}

std::string Connection::remote_address() const {
  const auto address = end_of(socket_, true);
  return address ? address_text(*address) : "";
}

std::string Connection::local_address() const {
  const auto address = end_of(socket_, false);
  return address ? address_text(*address) : "";
}

bool Connection::same_user() const {
  const auto here = end_of(socket_, false), there = end_of(socket_, true);
  if (!here || !there) return false;
  const auto owner =
      socket_owner({there->sin_addr.s_addr, ntohs(there->sin_port)}, {here->sin_addr.s_addr, ntohs(here->sin_port)});
  return owner && (*owner == ::geteuid() || *owner == 0);
}

}  // namespace trocar::review
