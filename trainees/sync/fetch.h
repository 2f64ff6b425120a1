// What pulling and replicating share: what is at the centre and not here, rows taken one by one, erasures. Internal to trainees/sync.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "trainees/sync/carried_rows.h"
#include "trainees/sync/synchronise.h"

namespace trocar::sync {

/// Values of column 0 that are at the centre and not here, in order. Only tables whose column 0 is no reference.
std::vector<std::string> missing_here(CentralLink& link, sqlite3* connection, const CarriedTable& table);

/// Calls with the missing rows, some at a time.
void fetch_missing(CentralLink& link, sqlite3* connection, const CarriedTable& table,
                   const std::function<void(const std::vector<Values>& rows)>& take);

/// Runs the action; undone and told under that name when it throws InputError. Inside a transaction. @returns whether it stands.
bool take_one(sqlite3* connection, const std::string& name, std::vector<std::string>& problems, const std::function<void()>& action);

/// Rows of a sealed table that are missing here, each with its hash computed again and an entry in the audit trail.
void take_sealed(CentralLink& link, Database& database, const CarriedTable& table, PullReport& report);

/// Erasures of people known here that have not been done here. @param apply else they are told.
void take_erasures(CentralLink& link, Database& database, bool apply, PullReport& report);

}  // namespace trocar::sync
