// Stations with something to push, and what a central database holds.
#pragma once

#include <string>
#include <vector>

#include "tests/trainees/exchange/sync/postgres_server.h"
#include "tests/trainees/records/store_samples.h"
#include "trainees/records/assessments.h"

namespace trocar::test {

inline const Author kTeacher{"0192-teacher", "Ida Adler"};

class Stations : public TemporaryFolder {
 protected:
  void SetUp() override;

  Database station(const std::string& name) { return Database(folder_ / (name + ".db")); }
  /// Attempts of "CODE", notes, signatures, an override, a certificate.
  void practise(Database& database, const std::string& code, int attempts);
  PushReport push(Database& database, const std::string& name = "");
  std::vector<std::string> ask(const std::string& sql) const { return server_.ask(central_, sql); }
  std::string one(const std::string& sql) const;
  /// Set up by its owner, for a login of a desk: it may what every other may, and rewrite nothing.
  CentralAddress another_central();
  /// That centre for a new login of that kind.
  CentralAddress admitted(const CentralAddress& central, const std::string& login, const std::string& kind);
  CentralAddress backup_of_central();
  /// Pushes with codes and names.
  PushReport push_named(Database& database, const std::string& name);
  /// A copy for a desk under that name, as the centre is now; checked.
  Database desk(const std::string& name = "desk");
  std::string trainee_uuid(Database& database, const std::string& code) const;
  /// Every row of every table of the centre but for times of arrival, in order.
  std::vector<std::string> everything(const CentralAddress& central) const;
  std::vector<std::string> everything() const { return everything(central_); }

  PostgresServer& server_ = PostgresServer::instance();
  CentralAddress central_;
};

}  // namespace trocar::test
