// Many stations, one record: what is finished and sealed at a station goes to a central PostgreSQL database, and comes back from it.
//
// Rows go by the station's audit trail, a transaction a batch, and are inserted only where their UUID is not there yet: the same push again
// changes nothing, one that was cut off goes on. A UUID that is there with another hash is a conflict: told, nothing overwritten.
// Nothing is ordered by clocks. docs/many_stations.md. Thread: that of the Database; blocks on the network, holds no lock on SQLite then.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "trainees/database.h"

namespace trocar {

/// url: "postgresql://[USER@]HOST[:PORT]/DATABASE[?OPTION=VALUE...]" without a password.
struct CentralAddress {
  std::string url;
  std::filesystem::path password_file = {};  ///< first line; empty: PGPASSWORD, ~/.pgpass or none. Not readable by others.
};

struct PushOptions {
  CentralAddress central;
  std::string station_name = {};     ///< empty: as it was, at first the host's name
  bool new_station = false;          ///< go on under a new UUID: after an older copy was put back, or on a copied database
  bool with_identity = false;        ///< also codes, names and e-mail addresses
  int batch = 200;                   ///< entries of the trail in a transaction
  std::function<void(std::int64_t position, std::int64_t head)> after_batch = {};
};

struct PushReport {
  std::string station, name;         ///< UUID
  std::int64_t from = 0, to = 0;     ///< positions of the audit trail
  std::map<std::string, int> added = {};   ///< rows that were not there yet, by table
  std::vector<std::string> conflicts = {}; ///< all that stand at the centre for this station, from earlier pushes too
  std::vector<std::string> problems = {};  ///< rows that do not hold here and were not pushed
};

/// @throws InputError: bad address, rows that the centre refuses. EnvironmentError: not reached, not let in, connection lost (what was
/// committed stays), a newer central schema.
PushReport push_to_central(Database& database, const PushOptions& options);

struct PullReport {
  std::map<std::string, int> added = {};     ///< rows by table
  std::vector<std::string> erasures = {};    ///< of people known here, not applied: one line each
  int erased = 0;                            ///< people erased here by this call
  std::vector<std::string> problems = {};    ///< rows whose content is not that of their hash: left out
};

/// Curricula, benchmarks and erasures of all stations. @param apply_erasures else they are only told.
PullReport pull_from_central(Database& database, const CentralAddress& central, bool apply_erasures);

/// Everything of all stations into `database`, for a desk of its own. Erasures are always applied. Each row's hash is computed again.
PullReport replicate_central(Database& database, const CentralAddress& central);

}  // namespace trocar
