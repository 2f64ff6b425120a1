// Pushing and fetching over a connection that is there already: what a desk that is kept fresh does over and over.
// Internal to trainees/exchange/sync.
#pragma once

#include "trainees/exchange/sync/central_link.h"
#include "trainees/exchange/sync/synchronise.h"

namespace trocar::sync {

/// What could be better about this connection, a line each.
std::vector<std::string> remarks_on(const CentralLink& link, const CentralAddress& central);

PushReport push_over(CentralLink& link, Database& database, const PushOptions& options);

/// @param whole compares everything; else only what arrived since the last time is asked for.
PullReport replicate_over(CentralLink& link, Database& database, const ReplicaOptions& options, bool whole);

/// @throws InputError: the file is a copy of another centre, or a station's own.
void require_place_of_copy(const Database& database, const std::string& central_uuid);

/// Name of the row in sync_cursor that says up to which arrival this copy has that centre, and when it last looked.
std::string arrivals_of(const std::string& central_uuid);

/// Recordings of this station's attempts whose row is at the centre, of nobody who was erased; whole ones are left.
/// @param problems files that are not what the attempt recorded. @returns how many were completed.
int push_recordings(CentralLink& link, Database& database, const std::string& station,
                    std::vector<std::string>& problems);

/// Whole recordings of attempts of other stations that are not here yet; and takes away those of people who were
/// erased.
/// @returns how many.
int fetch_recordings(CentralLink& link, Database& database, std::vector<std::string>& problems);
void drop_erased_recordings(Database& database);

}  // namespace trocar::sync
