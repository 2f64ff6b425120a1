// The connection to the central database: transactions, statements with parameters as text, errors of ours. Internal to
// trainees/exchange/sync.
//
// A writing transaction holds one advisory lock of the centre from beginning to end: stations take turns batch by
// batch. So two that push at once cannot lock each other out, and an erasure cannot slip past a row that is just coming
// in. Thread: one.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trainees/exchange/sync/synchronise.h"

namespace trocar::sync {

/// Values as text, in the order of the columns; empty: NULL.
using Values = std::vector<std::optional<std::string>>;

class CentralLink {
 public:
  enum class Purpose : std::uint8_t { kUse, kSetUp };
  /// Connects. @param purpose kUse: the schema is to be there, of this program's version. @throws as push_to_central.
  explicit CentralLink(const CentralAddress& address, Purpose purpose = Purpose::kUse);
  ~CentralLink();
  CentralLink(const CentralLink&) = delete;
  CentralLink& operator=(const CentralLink&) = delete;

  /// UUID of the central database.
  const std::string& uuid() const { return uuid_; }
  /// Whether this login owns the schema: then nothing there is beyond it.
  bool is_owner() const { return owner_; }

  /// Waits for its turn. @throws EnvironmentError: somebody holds the lock for more than 30 s; says who.
  void begin();
  /// Writes without waiting for anybody: for what brings no rows.
  void begin_out_of_turn();
  /// Sees one state from beginning to end and holds up nobody.
  void begin_reading();
  void commit();
  /// Inside a writing transaction: what it brought is news for those who fetch.
  void touch();
  /// Inside a transaction: highest number of arrival of what it sees.
  std::int64_t revision();
  /// Inside a transaction. Parameters are $1, $2, ...
  std::vector<Values> run(const std::string& sql, const std::vector<std::string>& parameters = {});
  /// Inside a transaction: makes the schema or brings it to this program's version. @returns the version before.
  int make_schema();

 private:
  struct Session;
  void open(const std::string& first);
  int version();
  void look();
  std::unique_ptr<Session> session_;
  std::string uuid_;
  bool owner_ = false;
};

}  // namespace trocar::sync
