// What pulling and replicating share: what is at the centre and not here, rows taken one by one, erasures. Internal to
// trainees/exchange/sync.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "trainees/exchange/sync/carried_rows.h"
#include "trainees/exchange/sync/links.h"
#include "trainees/exchange/sync/synchronise.h"

namespace trocar::sync {

/// Of a table at the centre only these rows. @param condition SQL with c for the row, $2 and on for the parameters.
struct Wanted {
  std::int64_t since = -1;  ///< that arrived after this number; -1: all
  std::string condition = {};
  std::vector<std::string> parameters = {};
};

/// Values of column 0 that are wanted and not here, in order. Only tables whose column 0 is no reference.
std::vector<std::string> missing_here(CentralLink& link, sqlite3* connection, const CarriedTable& table,
                                      const Wanted& wanted);

/// Calls with the missing rows, some at a time.
void fetch_missing(CentralLink& link, sqlite3* connection, const CarriedTable& table, const Wanted& wanted,
                   const std::function<void(const std::vector<Values>& rows)>& take);

/// Runs the action; undone and told under that name when it throws InputError: whoever may write at the centre can
/// bring a row that no program writes, and it stops nobody. Inside a transaction. @returns whether it stands.
bool take_one(sqlite3* connection, const std::string& name, std::vector<std::string>& problems,
              const std::function<void()>& action);

/// Rows of a sealed table that are missing here, each with its hash computed again and an entry in the audit trail.
/// One whose UUID is none, or of a time far ahead, stays out and is told: it would order everybody's.
/// What hangs on an attempt, certificate or trainee that is not here stays out, and so does a second revocation of one
/// certificate.
void take_sealed(CentralLink& link, Database& database, const CarriedTable& table, const Wanted& wanted,
                 const Links& links, PullReport& report);

/// Erasures of people known here, or linked to one, that have not been done here. @param apply else they are told.
void take_erasures(CentralLink& link, Database& database, bool apply, PullReport& report);

/// Groups as the newest change that reached the centre has them; what was changed here and not pushed yet stays.
void take_memberships(CentralLink& link, Database& database, const Links& links, PullReport& report);

/// That notes were met, at whichever station.
void take_seen(CentralLink& link, Database& database, std::int64_t since, PullReport& report);

}  // namespace trocar::sync
