// A desk on a loopback port for tests that need the network.
#pragma once

#include <memory>

#include "tests/trainees/desk/server/desk_samples.h"
#include "trainees/desk/server/desk_server.h"

namespace trocar::review {

class LiveDesk : public DeskTest {
 protected:
  DeskServerOptions options();
  /// Starts one; it stops with the test.
  void serve(DeskServerOptions given);
  int port() const { return server_->port(); }
  int get(const std::string& target, const std::string& cookie = "") {
    return status_of(raw_answer(port(), raw_get(port(), target, cookie)));
  }
  /// Cookie and token of a login, through the network.
  Visitor signed_in_there(const std::string& login);

  std::unique_ptr<DeskServer> server_;
};

/// Value of a header of a raw answer; "" without it.
std::string raw_header(const std::string& raw, const std::string& name);

/// A connection from a chosen loopback address that sends what it is told, when it is told.
class SlowVisitor {
 public:
  explicit SlowVisitor(int port, const char* from = "127.0.0.1");
  ~SlowVisitor();
  SlowVisitor(const SlowVisitor&) = delete;
  SlowVisitor& operator=(const SlowVisitor&) = delete;
  bool send(const std::string& bytes);
  /// All until the other side ends it.
  std::string rest();

 private:
  int socket_;
};

}  // namespace trocar::review
