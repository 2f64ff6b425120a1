// Numbers of what events, metrics and sub-scores are called, from the lookup tables; what is new is added.
// Internal to trainees/.
//
// A table is read whole, once for each object: they are short, and an attempt needs most of it. Make one inside
// the transaction that writes, and drop it with that: another program may add words meanwhile. Thread: the
// connection's.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "scenarios/scoring/attempt_result.h"

struct sqlite3;

namespace trocar {

class EventKinds {
 public:
  explicit EventKinds(sqlite3* connection);
  std::int64_t number(const std::string& type, std::string_view severity, const std::string& unit);

 private:
  sqlite3* connection_;
  std::unordered_map<std::string, std::int64_t> known_;
};

/// Of the metrics of one grading: each name once.
class MetricKinds {
 public:
  explicit MetricKinds(sqlite3* connection);
  /// @throws InputError: the name a second time; no room for more names (1023).
  std::int64_t number(const std::string& name, const std::string& unit);

 private:
  sqlite3* connection_;
  std::unordered_map<std::string, std::int64_t> known_;
  std::unordered_set<std::string> taken_;  ///< names so far
};

/// Of name, unit, weight, marks and gate of a sub-score.
std::int64_t subscore_kind(sqlite3* connection, const Subscore& subscore);

/// Of a device loop's change of state.
std::int64_t device_change(sqlite3* connection, const std::string& from, const std::string& to);

}  // namespace trocar
