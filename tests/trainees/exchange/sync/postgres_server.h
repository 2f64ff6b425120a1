// A PostgreSQL server of the test's own: in a temporary folder, on a socket there, with a password, gone with the
// program.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "trainees/exchange/sync/synchronise.h"

namespace trocar::test {

class PostgresServer {
 public:
  /// Starts at the first call. Not there: reason() says why.
  static PostgresServer& instance();
  ~PostgresServer();
  PostgresServer(const PostgresServer&) = delete;
  PostgresServer& operator=(const PostgresServer&) = delete;

  const std::string& reason() const { return reason_; }
  /// PostgreSQL is on this machine: then a server that does not start is a failure.
  bool installed() const { return !programs_.empty(); }
  /// An empty database of that name.
  CentralAddress make_database(const std::string& name);
  /// A database that is what the other is now: a backup, to be put back later. Nobody may be connected to the other.
  CentralAddress copy_database(const CentralAddress& of, const std::string& name);
  /// The same database for its owner, for another login.
  CentralAddress owner_of(const CentralAddress& address) const;
  CentralAddress as(const CentralAddress& address, const std::string& login,
                    const std::filesystem::path& password_file) const;
  const std::filesystem::path& folder() const { return folder_; }
  /// Rows of a query as "a|b|c" lines, asked by a connection of its own.
  std::vector<std::string> ask(const CentralAddress& address, const std::string& sql) const;
  /// Keeps every writer of that centre waiting while `meanwhile` runs.
  void while_locked(const CentralAddress& address, const std::function<void()>& meanwhile) const;
  /// Speaks TLS from now on, with a certificate for "central.test" by the authority whose own is returned; or none.
  std::filesystem::path speak_tls();
  void speak_no_tls();
  /// The same database over TCP, by a name that leads to an address of this machine.
  CentralAddress over_network(const CentralAddress& address, const std::string& host, const std::string& more) const;
  const std::filesystem::path& password_file() const { return password_file_; }

 private:
  PostgresServer();
  bool as_server(const std::string& command) const;
  bool as_its_user(const std::string& command) const;
  void set(const std::string& settings, const std::string& tls) const;
  std::string connection_to(const std::string& name) const;
  std::string connection_to(const CentralAddress& address) const;
  CentralAddress address_of(const std::string& name) const;

  std::filesystem::path folder_, programs_, password_file_;
  std::string reason_, user_, listens_;  ///< listens_: an address of this machine that no other test has
};

}  // namespace trocar::test
