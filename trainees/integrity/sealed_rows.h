// Rows that people write (notes, signatures, overrides, certificates, curricula, benchmarks, ratings, consents,
// erasures): each has a time-ordered UUID and an entry "TABLE added" in the audit trail with the digest of its content.
// Internal to trainees/.
//
// digest = SHA-256("trocar-row-1\n" + table + "\n" + every value of the row with its type, in fixed order; other rows
// stand by their UUID). A changed, exchanged or removed row, and one that got in by another way, shows when all digests
// are computed again. A row that went with its person has an entry "TABLE erased" with the erasure's UUID. Accounts can
// change: every change has an entry "account ..." with the digest of what it left, and the newest must be that of the
// row. Row numbers mean nothing. What is newest the trail says, and UUIDs follow it: no clock that was set back makes a
// later word an earlier one (newest_first(), next_row_uuid()).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "trainees/integrity/audit.h"
#include "trainees/store/sqlite_handle.h"

struct sqlite3;

namespace trocar {

/// Tables whose rows are sealed and go to a centre, in the order in which they may refer to one another. standing,
/// assignment and withdrawal are sealed likewise and stay here.
const std::vector<std::string>& sealed_tables();

/// Actor of the entries of rows that came from a central database.
inline constexpr const char* kFromCentre = "centre";

/// A UUID for a new row, greater than that of every row of the table that is here and holds: one that does not counts
/// nowhere. Call inside the transaction that inserts the row.
std::string next_row_uuid(sqlite3* connection, const std::string& table);

/// SQL " ORDER BY ..." that has the newest row first: of those written here the one whose entry in the trail is the
/// last; of those that came from elsewhere, whose order nobody here saw, the greatest UUID, which is the same in every
/// database. @param row alias of the table. @param of column that says what rows are compared.
std::string newest_first(const std::string& table, const std::string& row, const std::string& of);

/// Puts the row with that UUID into the audit trail. Call inside the transaction that inserts it.
/// @param author account's UUID, "" from the command line.
void seal_row(sqlite3* connection, const std::string& table, const std::string& uuid, const std::string& author);

/// Notes in the trail that the row went with its person. Call inside the transaction that deletes it.
void note_erased_row(sqlite3* connection, const std::string& table, const std::string& uuid,
                     const std::string& erasure_uuid, const std::string& author);

/// Puts a new or changed account into the trail. @param action "account added", "account password", ...
void seal_account(sqlite3* connection, const std::string& action, const std::string& uuid, const std::string& author);

/// Digest of a row of a sealed table or of an account as it stands. @throws InputError: no such row.
std::string digest_of_row(sqlite3* connection, const std::string& table, const std::string& uuid);

/// Whether that very row of a sealed table is as a signed entry says (an account: as its newest entry says, and that is
/// signed): what somebody wrote into the file lets nobody in and rules nothing. @param row its id, for an index may
/// have been made to lead from a UUID to another row.
bool row_holds(sqlite3* connection, const std::string& table, std::int64_t row);

/// The signed entries that rows of one table are as: row_holds() of many. Statements are prepared and keys looked up
/// once, so nothing is to be written while it lives.
class RowEntries {
 public:
  RowEntries(sqlite3* connection, const std::string& table);
  /// Position of the entry, 0: none, the row does not hold.
  std::int64_t of(std::int64_t row);

 private:
  std::string table_;
  bool account_;
  sql::Statement content_, entries_;
  SignedEntries signed_;
};

/// For queries: row_holds(TABLE, id), 1 or 0, and row_entry(TABLE, id), the entry that says so, NULL without.
void add_row_holds(sqlite3* connection);

/// Problems between rows and trail, one line each. Rows that went by a recorded erasure are none.
std::vector<std::string> check_sealed_rows(sqlite3* connection);

}  // namespace trocar
