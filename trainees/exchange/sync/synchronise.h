// Many stations, one record: what is finished and sealed at a station goes to a central PostgreSQL database, and comes
// back from it.
//
// Rows go by the station's audit trail, a transaction a batch, and are inserted only where their UUID is not there yet:
// the same push again changes nothing, one that was cut off goes on. A UUID that is there with another hash is a
// conflict: told, nothing overwritten. Nothing is ordered by clocks. docs/many_stations.md. Thread: that of the
// Database; blocks on the network, holds no lock on SQLite then.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "trainees/store/database.h"

namespace trocar {

/// url: "postgresql://[USER@]HOST[:PORT]/DATABASE[?OPTION=VALUE...]" without a password.
struct CentralAddress {
  std::string url;
  std::filesystem::path password_file =
      {};                 ///< first line; empty: PGPASSWORD, ~/.pgpass or none. Not readable by others.
  bool weak_tls = false;  ///< an sslmode that does not check who answers may stand in the address
};

struct PushOptions {
  CentralAddress central;
  std::string station_name = {};  ///< empty: as it was, at first the host's name
  bool new_station = false;       ///< go on under a new UUID: after an older copy was put back, or on a copied database
  bool with_identity = false;     ///< also codes, names and e-mail addresses
  bool recordings = false;        ///< also the recordings of attempts
  int batch = 200;                ///< entries of the trail in a transaction
  std::function<void(std::int64_t position, std::int64_t head)> after_batch = {};
};

struct PushReport {
  std::string station, name;                ///< UUID
  std::int64_t from = 0, to = 0;            ///< positions of the audit trail
  std::map<std::string, int> added = {};    ///< rows that were not there yet, by table
  std::vector<std::string> conflicts = {};  ///< all that stand at the centre for this station, from earlier pushes too
  std::vector<std::string> problems = {};   ///< rows and recordings that do not hold here and were not pushed
  /// That the centre was put back to an older state, that this login was another station before.
  std::vector<std::string> told = {};
  std::vector<std::string> remarks = {};  ///< what the connection could do better: TLS that checks little, the owner
};

/// Also leaves the signed head of the audit trail there, which nobody but the centre's owner can take away again.
/// @throws InputError: bad address, rows that the centre refuses, identities from a copy for a desk. EnvironmentError:
/// not reached, not let in, connection lost (what was committed stays), a newer central schema.
PushReport push_to_central(Database& database, const PushOptions& options);

struct PullReport {
  std::map<std::string, int> added = {};   ///< rows by table
  std::vector<std::string> erasures = {};  ///< of people known here, not applied: one line each
  int erased = 0;                          ///< people erased here by this call
  std::vector<std::string> problems = {};  ///< rows and recordings whose content is not that of their hash: left out
  std::vector<std::string> told = {};      ///< that the centre was put back to an older state
};

/// Curricula and benchmarks of all stations; notes, ratings, signatures, overrides, certificates, consents and groups
/// of the people known here, whoever wrote them; erasures. @param apply_erasures else they are only told.
PullReport pull_from_central(Database& database, const CentralAddress& central, bool apply_erasures);

struct ReplicaOptions {
  CentralAddress central;
  bool recordings = false;  ///< also those that stations pushed
  std::function<void(std::size_t attempts, std::size_t of)> going = {};
};

/// Everything of all stations into `database`, for a desk of its own. Erasures are always applied. Each row's hash is
/// computed again. From then on the file takes no attempts (replica_facts.h).
PullReport replicate_central(Database& database, const ReplicaOptions& options);
inline PullReport replicate_central(Database& database, const CentralAddress& central) {
  return replicate_central(database, ReplicaOptions{central});
}

/// Where the trail is not the one that heads at the centre were taken of, a line each: heads of whatever station this
/// record says that it was, and of those that this login pushed as, where it is a station's. No head there is a problem
/// too.
/// @throws as push_to_central.
std::vector<std::string> check_central_witness(const Database& database, const CentralAddress& central);

struct LinkedPeople {
  std::string one, other;  ///< UUIDs of trainees
};

/// Says at the centre that two trainees are one person, or no longer are. Stations and copies follow at their next
/// sync.
/// @param one "CODE@STATION", by name or UUID of the station, or a trainee's UUID. @param author who says so, kept with
/// it.
/// @throws InputError: nobody of that name, several, erased, said already.
LinkedPeople link_people(const CentralAddress& central, const std::string& one, const std::string& other, bool linked,
                         const std::string& author);

}  // namespace trocar
