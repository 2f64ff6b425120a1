#include "trainees/desk/server/connection.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "trainees/desk/server/socket_owner.h"

namespace trocar::review {
namespace {

using std::chrono::milliseconds;

constexpr long kAgainToRead = -2, kAgainToWrite = -3;

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
  if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return writing ? kAgainToWrite : kAgainToRead;
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

Connection::Connection(int socket, const TlsIdentity* tls, const std::atomic<bool>& stop)
    : socket_(socket), stop_(stop) {
  ::fcntl(socket_, F_SETFL, ::fcntl(socket_, F_GETFL, 0) | O_NONBLOCK);
  const int yes = 1;
  ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  if (tls) tls_ = std::make_unique<Tls>(static_cast<SSL_CTX*>(tls->context()), socket_);
}

Connection::~Connection() {
  tls_.reset();
  ::close(socket_);
}

bool Connection::wait(bool for_writing, Deadline until) const {
  constexpr milliseconds kSlice{100};
  while (!stop_) {
    const auto left = std::chrono::ceil<milliseconds>(until - std::chrono::steady_clock::now());
    if (left.count() <= 0) return false;
    pollfd watched{socket_, static_cast<short>(for_writing ? POLLOUT : POLLIN), 0};
    const int ready = ::poll(&watched, 1, static_cast<int>(std::min(left, kSlice).count()));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
  return false;
}

long Connection::some(bool writing, char* data, std::size_t count) {
  if (!tls_) return plain_some(socket_, writing, data, count);
  if (!tls_->ssl || !tls_->ready) return -1;
  ERR_clear_error();
  const int amount = static_cast<int>(std::min<std::size_t>(count, 1U << 20U));
  return tls_->outcome(writing ? SSL_write(tls_->ssl, data, amount) : SSL_read(tls_->ssl, data, amount));
}

bool Connection::handshake(Deadline until) {
  if (!tls_) return true;
  if (!tls_->ssl) return false;
  while (true) {
    ERR_clear_error();
    const long result = tls_->outcome(SSL_accept(tls_->ssl));
    if (result > 0) return tls_->ready = true;
    if (result != kAgainToRead && result != kAgainToWrite) return false;
    if (!wait(result == kAgainToWrite, until)) return false;
  }
}

long Connection::read(char* into, std::size_t most, Deadline until) {
  while (std::chrono::steady_clock::now() < until) {
    const long count = some(false, into, most);
    if (count != kAgainToRead && count != kAgainToWrite) return count;
    if (!wait(count == kAgainToWrite, until)) return -1;
  }
  return -1;
}

bool Connection::write(const char* from, std::size_t count, Deadline until) {
  while (count > 0) {
    if (std::chrono::steady_clock::now() >= until) return false;
    const long done = some(true, const_cast<char*>(from), count);  // never written to
    if (done > 0) {
      from += done;
      count -= static_cast<std::size_t>(done);
    } else if ((done != kAgainToRead && done != kAgainToWrite) || !wait(done == kAgainToWrite, until)) {
      return false;
    }
  }
  return true;
}

void Connection::finish() {
  if (tls_ && tls_->ready) SSL_shutdown(tls_->ssl);
  ::shutdown(socket_, SHUT_WR);
  // What is still on its way is taken for a moment: closing over it would throw the answer away at the other side.
  constexpr milliseconds kPatience{500};
  constexpr std::size_t kMost = 4U << 20U;
  const Deadline until = std::chrono::steady_clock::now() + kPatience;
  char rest[4096];
  for (std::size_t taken = 0; taken < kMost && wait(false, until);) {
    const ssize_t count = ::recv(socket_, rest, sizeof rest, 0);
    if (count <= 0) return;
    taken += static_cast<std::size_t>(count);
  }
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

std::variant<ReceivedRequest, Refusal> receive_request(Connection& connection, const RequestLimits& limits) {
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const Deadline head_until = now() + milliseconds(limits.head_ms);
  std::string bytes;
  std::size_t end = std::string::npos;
  char piece[4096];
  while (end == std::string::npos) {
    if (bytes.size() > limits.head_bytes) return Refusal{431, "The head of the request is too large."};
    const long count = connection.read(piece, sizeof piece, head_until);
    if (count <= 0)
      return bytes.empty() || count == 0 ? Refusal{0, ""} : Refusal{408, "The request took too long to arrive."};
    const std::size_t from = bytes.size() < 3 ? 0 : bytes.size() - 3;
    bytes.append(piece, static_cast<std::size_t>(count));
    end = bytes.find("\r\n\r\n", from);
  }
  auto head = parse_head(std::string_view(bytes).substr(0, end + 4), limits);
  if (auto* refusal = std::get_if<Refusal>(&head)) return *refusal;
  ReceivedRequest out{std::get<RequestHead>(std::move(head)), bytes.substr(end + 4)};
  const Deadline body_until = now() + milliseconds(limits.body_ms);
  while (out.body.size() < out.head.content_length) {
    const long count =
        connection.read(piece, std::min(sizeof piece, out.head.content_length - out.body.size()), body_until);
    if (count <= 0) return count == 0 ? Refusal{0, ""} : Refusal{408, "The request took too long to arrive."};
    out.body.append(piece, static_cast<std::size_t>(count));
  }
  out.body.resize(out.head.content_length);  // one request a connection: what comes behind it is not read
  return out;
}

}  // namespace trocar::review
