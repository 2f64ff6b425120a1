// A stretch of a station's audit trail with the rows that it speaks of: read in one go, so that SQLite is free while
// the network is slow. Internal to trainees/exchange/sync.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "trainees/exchange/sync/carried_rows.h"

namespace trocar::sync {

struct Batch {
  std::int64_t to = 0;        ///< position of its last entry; equal to `from` when there is none
  std::vector<Values> audit;  ///< position, utc, actor, action, subject, detail, prev_hash, row_hash
  std::map<std::string, std::vector<Values>> rows;  ///< by table
  std::vector<std::string> problems;                ///< rows that do not hold: left out
};

/// The audit trail as the centre has it; station is a column of its own there.
const CarriedTable& carried_audit();

/// Entries after `from`, `most` of them at most. The first batch (from 0) also takes attempts older than the trail.
/// What tells who a trainee is stays out.
Batch read_batch(sqlite3* connection, std::int64_t from, int most);

/// What tells who trainees are: persons, consents, what trainees signed and rated under their own names.
Batch read_identities(sqlite3* connection);

}  // namespace trocar::sync
