#include "trainees/exchange/export/export_choice.h"

#include <algorithm>

#include "haptics/input_error.h"
#include "trainees/records/attempt_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

void check_known(sqlite3* connection, const char* sql, const std::string& what, const std::string& name) {
  if (name.empty()) return;
  sql::Statement known(connection, sql);
  if (!known.bind(name).step()) throw InputError("no " + what + " \"" + name + "\" in this database");
}

}  // namespace

ExportChoice choose_attempts(Database& database, const ExportFilter& filter) {
  sqlite3* connection = database.connection();
  check_known(connection, "SELECT 1 FROM known_trainee WHERE code = ? COLLATE NOCASE", "trainee", filter.trainee);
  check_known(connection, "SELECT 1 FROM membership WHERE group_name = ? LIMIT 1", "group", filter.group);
  check_known(connection, "SELECT 1 FROM exercise WHERE id = ?", "exercise", filter.exercise);
  const std::int64_t only = filter.attempt.empty() ? 0 : AttemptStore(database).find(filter.attempt).row;
  sql::Statement rows(connection,
                      "SELECT a.id, a.trainee_id FROM attempt a JOIN known_trainee t ON t.id = a.trainee_id"
                      " WHERE a.status <> 'running' AND (?1 = '' OR t.code = ?1 COLLATE NOCASE) AND (?2 = '' OR EXISTS"
                      " (SELECT 1 FROM membership m WHERE m.trainee_id = a.trainee_id AND m.group_name = ?2))"
                      " AND a.trainee_id NOT IN (SELECT trainee_id FROM erasure WHERE kind = 'training' AND"
                      " row_holds('erasure', id))"
                      " AND (?3 = '' OR a.exercise_id = ?3) AND (?4 = 0 OR a.id = ?4) ORDER BY a.id");
  rows.bind(filter.trainee).bind(filter.group).bind(filter.exercise).bind(only);
  ExportChoice choice;
  choice.filter = filter;
  while (rows.step()) {
    choice.attempts.push_back(rows.integer(0));
    choice.trainees.push_back(rows.integer(1));
  }
  if (choice.attempts.empty()) throw InputError("no finished attempt fits: there is nothing to export");
  std::sort(choice.trainees.begin(), choice.trainees.end());
  choice.trainees.erase(std::unique(choice.trainees.begin(), choice.trainees.end()), choice.trainees.end());
  return choice;
}

}  // namespace trocar
