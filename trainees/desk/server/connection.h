// One accepted connection, plain or TLS, that never waits: every call does what can be done now and says what it would
// have to wait for. Who waits, and how long at most, is the waiting room's affair (waiting_room.h).
//
// Thread: one at a time; addresses and same_user() may be asked by the one that serves it.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace trocar::review {

using Deadline = std::chrono::steady_clock::time_point;

/// Certificate and key that a server shows.
class TlsIdentity {
 public:
  /// @throws InputError: a file that cannot be read, or key and certificate that do not belong together.
  TlsIdentity(const std::filesystem::path& certificate, const std::filesystem::path& key);
  ~TlsIdentity();
  TlsIdentity(const TlsIdentity&) = delete;
  TlsIdentity& operator=(const TlsIdentity&) = delete;

  void* context() const { return context_; }
  /// Names the certificate is made out to (subject alternative names), in lower case.
  std::vector<std::string> names() const;

 private:
  void* context_;
};

class Connection {
 public:
  /// Instead of a count: it would have to wait, until it can be read from or written to.
  static constexpr long kAgainToRead = -2, kAgainToWrite = -3;

  /// @param socket accepted; closed with this object. @param tls empty: plain.
  Connection(int socket, const TlsIdentity* tls);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// TLS is agreed on. 1: done, or plain; 0 or -1: it failed; or as above.
  long greet();
  /// Bytes read; 0: the other side has ended; -1: broken; or as above.
  long take(char* into, std::size_t most);
  /// Bytes written; -1: broken; or as above.
  long put(const char* from, std::size_t count);
  /// Nothing more is written.
  void end();
  /// Throws away what still arrives, as it is on the wire. Bytes; 0, -1: the other side has ended; or kAgainToRead.
  long drop();

  std::string remote_address() const;
  std::string local_address() const;
  /// The other end is a socket of this machine that belongs to the user who runs this program, or to root.
  bool same_user() const;
  int socket() const { return socket_; }

 private:
  struct Tls;

  int socket_;
  std::unique_ptr<Tls> tls_;
};

}  // namespace trocar::review
