// Rows that may change, and yet are evidence: trainees, people, exercises, groups, what was met, this station. Every
// lawful change leaves an entry in the audit trail, against which the rows are compared. Internal to trainees/.
//
// Entry: subject, detail.
//
//   "trainee added": its UUID, digest of UUID and time
//   "person added", "person changed": the trainee's UUID, digest of salt, code, name, e-mail; the newest counts
//   "exercise kept": its id, digest of id, number, title; the newest counts
//   "note seen": the note's UUID, when
//   "group joined", "group left": the trainee's UUID, the group; "... elsewhere" where a central database told it
//
// Codes are few and short: a plain digest would tell, by trying them all, who an erased trainee was. So a person's
// digest has a random salt that stands in the person's row and goes with it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trainees/integrity/audit.h"
#include "trainees/store/sqlite_handle.h"

struct sqlite3;

namespace trocar {

// Each is called in the transaction that has made the change. @param author account's UUID, "" for the program and the
// command line.
/// A new trainee, and the person when there is one.
void keep_trainee(sqlite3* connection, const std::string& uuid, const std::string& author = "");
/// A new or changed code, name or e-mail address.
void keep_person(sqlite3* connection, const std::string& trainee_uuid, const std::string& author = "");
/// Whether the person is as the newest entry has it, so that a change may follow.
bool person_holds(sqlite3* connection, const std::string& trainee_uuid);
/// For who writes under somebody's code. @throws InputError: the person's row is not as a signed entry says, so that
/// what is written could be another's.
void require_person(sqlite3* connection, std::int64_t trainee, const std::string& code);
void keep_exercise(sqlite3* connection, const std::string& id);
/// Only where no entry is yet.
void keep_exercise_once(sqlite3* connection, const std::string& id);
/// Makes the row, too. @returns whether that is news: no signed entry says so yet.
bool keep_note_seen(sqlite3* connection, const std::string& note_uuid, const std::string& utc,
                    const std::string& author = "");

/// When trainees met notes, by signed entries: a row that somebody put in keeps no note from anybody. Nothing is to be
/// written while it lives.
class SeenEntries {
 public:
  explicit SeenEntries(sqlite3* connection);
  /// UTC, "" when it was not met.
  std::string when(const std::string& note_uuid);

 private:
  sql::Statement entries_;
  SignedEntries signed_;
};

/// Problems between rows and trail, one line each.
std::vector<std::string> check_kept_rows(sqlite3* connection);

}  // namespace trocar
