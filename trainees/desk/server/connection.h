// One accepted connection, plain or TLS, on which nothing takes longer than it may: every read and write has a
// deadline, and a request that dribbles in is cut off when its time is over, however busily it dribbles.
//
// Thread: the one that serves it; stop() of the flag it was given may come from any.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "trainees/desk/server/request_head.h"

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
  /// @param socket accepted; closed with this object. @param tls empty: plain. @param stop set: everything ends at
  /// once.
  Connection(int socket, const TlsIdentity* tls, const std::atomic<bool>& stop);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  bool handshake(Deadline until);
  /// Bytes read; 0: the other side has ended; -1: too late, or broken.
  long read(char* into, std::size_t most, Deadline until);
  bool write(const char* from, std::size_t count, Deadline until);
  /// Ends it so that the other side still gets what was written, even while it sends.
  void finish();

  std::string remote_address() const;
  std::string local_address() const;
  /// The other end is a socket of this machine that belongs to the user who runs this program, or to root.
  bool same_user() const;
  int socket() const { return socket_; }

 private:
  struct Tls;
  bool wait(bool for_writing, Deadline until) const;
  long some(bool writing, char* data, std::size_t count);

  int socket_;
  const std::atomic<bool>& stop_;
  std::unique_ptr<Tls> tls_;
};

struct ReceivedRequest {
  RequestHead head;
  std::string body;
};

/// Reads a whole request. @returns why not, with status 0 when nothing came.
std::variant<ReceivedRequest, Refusal> receive_request(Connection& connection, const RequestLimits& limits);

}  // namespace trocar::review
