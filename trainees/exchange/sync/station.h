// This database under its own name, and how far a central database has it. Internal to trainees/exchange/sync.
#pragma once

#include <cstdint>
#include <string>

#include "trainees/store/database.h"

namespace trocar::sync {

struct Station {
  std::string uuid, name;
};

/// Made at the first call. @param name empty: as it was, at first the host's. @param renew a new UUID. Every change is
/// in the audit trail.
Station own_station(Database& database, const std::string& name, bool renew);

/// Position of the audit trail up to which that centre is known to have everything; 0 when nothing is known.
std::int64_t cursor_of(const Database& database, const std::string& central);
void set_cursor(const Database& database, const std::string& central, std::int64_t position);

}  // namespace trocar::sync
