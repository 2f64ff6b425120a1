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
  /// An empty database of that name.
  CentralAddress make_database(const std::string& name);
  /// A database that is what the other is now: a backup, to be put back later. Nobody may be connected to the other.
  CentralAddress copy_database(const CentralAddress& of, const std::string& name);
  const std::filesystem::path& folder() const { return folder_; }
  /// Rows of a query as "a|b|c" lines, asked by a connection of its own.
  std::vector<std::string> ask(const CentralAddress& address, const std::string& sql) const;
  /// Keeps every writer of that centre waiting while `meanwhile` runs.
  void while_locked(const CentralAddress& address, const std::function<void()>& meanwhile) const;
  const std::filesystem::path& password_file() const { return password_file_; }

 private:
  PostgresServer();
  bool as_server(const std::string& command) const;
  std::string connection_to(const std::string& name) const;
  std::string connection_to(const CentralAddress& address) const;
  CentralAddress address_of(const std::string& name) const;

  std::filesystem::path folder_, programs_, password_file_;
  std::string reason_, user_;
};

}  // namespace trocar::test
