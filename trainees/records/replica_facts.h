// What a database holds of other stations: whether it is a copy of a central record, which station an attempt is of,
// whose a row was when it was written. Internal to trainees/, but for what names no connection.
//
// A copy says so in its audit trail (kActionReplica), so that every program that opens it knows: no attempt is recorded
// into it. Two trainees who were linked as one person (docs/many_stations.md) stand under one of them; a row that was
// moved keeps the UUID that its hash was made with in an entry kActionLinked, of which the newest counts. Thread: that
// of the Database.
#pragma once

#include <filesystem>
#include <string>

#include "trainees/store/database.h"

namespace trocar {

inline constexpr const char* kActionReplica =
    "replica made";  ///< subject: "replica", detail: UUID of the central database
inline constexpr const char* kActionLinked =
    "linked";  ///< subject: the row's UUID, detail: UUID of the trainee it was written of

/// A copy of a central record, or a file that holds attempts of other stations.
bool is_replica(sqlite3* connection);

/// Call inside a transaction. Nothing when it is marked already.
void mark_replica(sqlite3* connection, const std::string& central_uuid);

/// UUID of the central database that it is a copy of; "" when it is none, or was made before copies said so.
std::string replica_of(sqlite3* connection);

/// @throws InputError: attempts are recorded and trainees added at stations, not in a copy.
void require_no_replica(sqlite3* connection);
void require_no_replica(const Database& database);

/// SQL for the UUID of the trainee a row was written of. @param row SQL for the row's UUID. @param trainee for that of
/// the one it stands under.
std::string origin_sql(const std::string& row, const std::string& trainee);

/// Name of the station that made the attempt; "" when this database did.
std::string station_of_attempt(const Database& database, const std::string& attempt_uuid);

/// Where recordings of attempts lie that came with the record of other stations: beside the database.
std::filesystem::path fetched_recording(const std::filesystem::path& database, const std::string& attempt_uuid);

/// Where a recording is: at its own place, or, when nothing is there, at that of a fetched one if something is there.
std::filesystem::path recording_here(const std::filesystem::path& database, const std::string& stored,
                                     const std::string& attempt_uuid);

}  // namespace trocar
