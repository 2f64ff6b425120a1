#include "trainees/exchange/sync/links.h"

#include <algorithm>
#include <set>

#include "trainees/exchange/sync/fetch.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/records/replica_facts.h"

namespace trocar::sync {
namespace {

/// Rows that stand under a trainee, and the guards that keep them there.
struct Movable {
  const char *name, *from;
  std::vector<std::string> guards;
};

const std::vector<Movable>& movables() {
  static const std::vector<Movable> kTables{
      {"note", "note r", {"note_no_update"}},
      {"consent", "consent r", {"consent_no_update"}},
      {"certificate", "certificate r", {"certificate_no_update"}},
      {"standing", "standing r", {"standing_no_update"}},
      {"assignment", "assignment r", {"assignment_no_update"}},
      {"attempt", "attempt r JOIN replica x ON x.attempt_id = r.id", {"attempt_no_update", "attempt_keeps_identity"}},
  };
  return kTables;
}

struct Move {
  std::string row, origin, home;
};

/// Takes guards away and puts them back as they were, inside the caller's transaction: nobody sees the database
/// without.
class Unguarded {
 public:
  Unguarded(sqlite3* connection, const std::vector<std::string>& names) : connection_(connection) {
    for (const std::string& name : names) {
      sql::Statement text(connection, "SELECT sql FROM sqlite_master WHERE type = 'trigger' AND name = ?");
      if (!text.bind(name).step()) continue;
      triggers_.push_back(text.text(0));
      text.run();
      sql::execute(connection, ("DROP TRIGGER " + name).c_str());
    }
  }
  void guard() {
    for (const std::string& trigger : triggers_) sql::execute(connection_, trigger.c_str());
  }

 private:
  sqlite3* connection_;
  std::vector<std::string> triggers_;
};

bool known(sqlite3* connection, const char* query, const std::string& uuid) {
  sql::Statement row(connection, query);
  return row.bind(uuid).step();
}

std::vector<std::string> texts(sqlite3* connection, const std::string& query) {
  std::vector<std::string> all;
  sql::Statement rows(connection, query);
  while (rows.step()) all.push_back(rows.text(0));
  return all;
}

void collect(sqlite3* connection, const Movable& table, const std::string& where, const std::string& key,
             const Links& links, std::map<std::string, Move>& moves) {
  sql::Statement rows(connection, "SELECT r.uuid, " + origin_sql("r.uuid", "t.uuid") + ", t.uuid FROM " + table.from +
                                      " JOIN trainee t ON t.id = r.trainee_id WHERE " + where + " = ?");
  rows.bind(key);
  while (rows.step()) {
    const std::string home = links.home(connection, rows.text(1));
    if (home != rows.text(2)) moves[rows.text(0)] = {rows.text(0), rows.text(1), home};
  }
}

std::map<std::string, Move> moves_of(sqlite3* connection, const Movable& table, const Links& links,
                                     const std::vector<std::string>& moved) {
  std::map<std::string, Move> moves;
  for (const auto& [trainee, unused] : links.groups()) collect(connection, table, "t.uuid", trainee, links, moves);
  for (const std::string& row : moved) collect(connection, table, "r.uuid", row, links, moves);
  return moves;
}

void move_rows(sqlite3* connection, const Movable& table, const std::map<std::string, Move>& moves) {
  Unguarded rows(connection, table.guards);
  for (const auto& [unused, move] : moves) {
    // Whoever was parted from the one who is known here stands for themselves, unnamed.
    sql::Statement bare(connection,
                        "INSERT INTO trainee (uuid, created_utc) SELECT ?1, created_utc FROM trainee WHERE NOT EXISTS"
                        " (SELECT 1 FROM trainee WHERE uuid = ?1) LIMIT 1 RETURNING 1");
    if (bare.bind(move.home).step()) {
      bare.run();
      keep_trainee(connection, move.home, kFromCentre);
    }
    sql::Statement update(connection, std::string("UPDATE ") + table.name +
                                          " SET trainee_id = (SELECT id FROM trainee WHERE uuid = ?) WHERE uuid = ?");
    update.bind(move.home).bind(move.row).run();
    note_origin(connection, move.row, move.origin);
  }
  rows.guard();
}

}  // namespace

Links::Links(CentralLink& link) {
  for (const Values& row :
       link.run("SELECT trainee_uuid, same_uuid FROM linked_trainee ORDER BY trainee_uuid, same_uuid")) {
    groups_[row[0].value_or("")].push_back(row[1].value_or(""));
  }
}

std::vector<std::string> Links::same_as(const std::string& trainee) const {
  const auto found = groups_.find(trainee);
  return found == groups_.end() ? std::vector<std::string>{trainee} : found->second;
}

std::string Links::home(sqlite3* connection, const std::string& origin) const {
  const auto found = groups_.find(origin);
  if (found == groups_.end()) return origin;
  for (const char* query : {"SELECT 1 FROM trainee t JOIN person p ON p.trainee_id = t.id WHERE t.uuid = ?",
                            "SELECT 1 FROM trainee WHERE uuid = ?"}) {
    for (const std::string& uuid : found->second) {
      if (known(connection, query, uuid)) return uuid;
    }
  }
  return origin;
}

void note_origin(sqlite3* connection, const std::string& row, const std::string& origin) {
  append_audit(connection, kActionLinked, row, origin);
}

int settle_links(Database& database, const Links& links) {
  sqlite3* connection = database.connection();
  const auto moved =
      texts(connection, std::string("SELECT DISTINCT subject FROM audit WHERE action = '") + kActionLinked + "'");
  if (links.empty() && moved.empty()) return 0;
  AnchoredTransaction transaction(database);
  int count = 0;
  for (const Movable& table : movables()) {
    const auto moves = moves_of(connection, table, links, moved);
    if (moves.empty()) continue;
    move_rows(connection, table, moves);
    count += static_cast<int>(moves.size());
  }
  if (count > 0) transaction.commit();
  return count;
}

}  // namespace trocar::sync
