// What a page thread keeps between pages: the cohort's lines, judged, as long as nothing has been written.
//
// They are made anew once any connection has committed anything (PRAGMA data_version tells of others, SQLite's count of
// changes of this one; the rules in force are rows too), or a minute has passed (judgements know what is due). So no
// page shows what is no longer there. Some 1 kB a line: 2 MB with 500 trainees at four exercises each. Thread: that of
// its Database, which it must not outlive.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trainees/desk/queries/desk_queries.h"

namespace trocar::review {

class DeskMemory {
 public:
  /// As cohort_lines() gives them by the rules in force, without a filter. Good until the next call.
  const std::vector<CohortLine>& lines(Database& database, const std::string& now_utc);
  /// Whether the next call of lines() has nothing to read.
  bool fresh(Database& database, const std::string& now_utc) const { return key_ == key_now(database, now_utc); }
  int made() const { return made_; }

 private:
  struct Key {
    std::int64_t others = 0, own = 0;  ///< commits of other connections, changes of this one
    std::string minute;
    bool operator==(const Key&) const = default;
  };
  static Key key_now(Database& database, const std::string& now_utc);

  std::optional<Key> key_ = {};
  std::vector<CohortLine> lines_ = {};
  int made_ = 0;
};

/// Those of `lines` that the filter lets through, as cohort_lines() would give them.
std::vector<CohortLine> filtered(const std::vector<CohortLine>& lines, const CohortFilter& filter);

}  // namespace trocar::review
