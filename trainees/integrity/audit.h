// The audit trail: what was done to the database, in a hash chain of its own. Internal to trainees/.
//
// row_hash_n = SHA-256("trocar-audit-1\n" + row_hash_(n-1) + "\n" + n + "\n" + utc + "\n" + actor + "\n" + action +
// "\n" + subject + "\n" + detail); n counts from 1, row_hash_0 is empty. Every finished attempt has an entry with its
// row_hash, so that the trail knows of attempts that the table no longer holds. What the trail itself has lost at its
// end only the anchor file knows (anchor_file.h). Each entry carries the signature of head_text(row_hash) by the
// station's key (station_key.h), "" where there is none.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trainees/integrity/station_key.h"
#include "trainees/store/sqlite_handle.h"

struct sqlite3;

namespace trocar {

inline constexpr const char* kActionBegun =
    "attempt begun";  ///< subject: uuid, detail: digest of identity_of(), another of what else stays while it runs
inline constexpr const char* kActionFinished = "attempt finished";  ///< subject: uuid, detail: row_hash
inline constexpr const char* kActionReplicated =
    "attempt replicated";                                      ///< of another station; subject: uuid, detail: row_hash
inline constexpr const char* kActionStation = "station made";  ///< subject: its uuid, detail: its name
inline constexpr const char* kActionMessage =
    "message sent";  ///< shown at once at a station; subject: uuid of its note
inline constexpr const char* kActionRenewed = "anchor renewed";    ///< a new anchor file begins with this entry
inline constexpr const char* kActionMade = "database made";        ///< subject: schema
inline constexpr const char* kActionMigrated = "schema migrated";  ///< subject: schema, detail: chain before
/// Ends that detail where a record of before signatures was migrated beside a key.
inline constexpr const char* kKeyLayThere = ", its key lay there already";

struct AuditHead {
  std::int64_t position = 0;  ///< 0: no entry yet
  std::string row_hash;
};

/// Adds an entry. Call inside a transaction. @param actor account's UUID of whoever did it, "trocar" for the program
/// itself. @throws InputError: a field with a control character, by which an entry could be read as another one, or a
/// last entry whose hash is none.
void append_audit(sqlite3* connection, const std::string& action, const std::string& subject, const std::string& detail,
                  const std::string& actor = "trocar");

/// @throws InputError: what is said to be the hash of `whose` is none, so nothing can be built on it.
void require_hash(const std::string& hash, const std::string& whose);

AuditHead audit_head(sqlite3* connection);
/// Whether the trail still holds the last entry that this process has seen of it: nothing was cut off or exchanged
/// meanwhile. Outside of a transaction, or at its beginning.
bool trail_goes_on(sqlite3* connection);
/// Whether the entries from there on follow one another as they were hashed, and the last is signed, where there is a
/// key to sign with.
/// @param after entry up to which it was looked at before, 0: all.
bool trail_whole(sqlite3* connection, std::int64_t after);

/// The entry of an attempt that begins: a row put in or changed without the key is told from one that began.
void audit_begun(sqlite3* connection, const std::string& uuid);

/// Why the attempt's row is not the one that began, "" when it is. Nothing is known while the trail has no attempt that
/// began: an earlier program made no such entries.
std::string begun_problem(sqlite3* connection, const std::string& uuid);

/// Whether its row is what it began with, as far as this station can know: while its key is lost it signs nothing.
bool as_begun(sqlite3* connection, const std::string& uuid);

/// Whether the trail has an entry of its beginning.
bool began_here(sqlite3* connection, const std::string& uuid);

/// Whether a signed entry says that it came from another station, and none that it began here.
bool came_from_elsewhere(sqlite3* connection, const std::string& uuid);

/// The station's key at that entry, "" before the first. One announced after that which lies beside the database is not
/// the station's.
std::string key_at(sqlite3* connection, std::int64_t position);

/// The same at the beginning of the attempt; "" where no entry tells of it.
std::string key_of_attempt(sqlite3* connection, const std::string& uuid);

/// Whether the station's key at that entry has signed what it says, or it is older than the first.
bool entry_signed(sqlite3* connection, std::int64_t position);

/// What a query of entries selects for SignedEntries.
inline constexpr const char* kEntryColumns =
    "position, utc, actor, action, subject, detail, prev_hash, row_hash, signature";

/// entry_signed() of many entries that are read anyway: the keys that count are looked up once, so nothing is to be
/// written while it lives.
class SignedEntries {
 public:
  explicit SignedEntries(sqlite3* connection) : connection_(connection) {}
  /// @param entry row of kEntryColumns.
  bool contains(const sql::Statement& entry);

 private:
  sqlite3* connection_;
  std::optional<std::vector<AnnouncedKey>> keys_ = {};
};

/// What the station's key signs of an entry.
std::string head_text(const std::string& row_hash);

/// row_hash of the entry, "" when there is none; its action.
std::string audit_hash(sqlite3* connection, std::int64_t position);
std::string audit_action(sqlite3* connection, std::int64_t position);

/// An entry of an earlier time than the one before it: the clock was set back in between.
struct ClockSetBack {
  std::int64_t position = 0;  ///< of the later entry
  std::string before_utc, utc;
};

/// Steps of more than kClockStep_s (s): smaller ones are what keeps clocks right.
inline constexpr double kClockStep_s = 2;
std::vector<ClockSetBack> clock_set_back(sqlite3* connection);

/// What is worth knowing and no problem, one line each: where the clock was set back, where the station's key is older
/// than the record.
std::vector<std::string> audit_remarks(sqlite3* connection);

/// Problems of the trail and between trail and attempts, one line each.
std::vector<std::string> check_audit(sqlite3* connection);

}  // namespace trocar
