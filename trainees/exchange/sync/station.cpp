#include "trainees/exchange/sync/station.h"

#include <unistd.h>

#include <array>

#include "trainees/integrity/anchored_transaction.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/printed_text.h"

namespace trocar::sync {
namespace {

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0 || name[0] == '\0') return "station";
  return name.data();
}

Station known_station(sqlite3* connection) {
  sql::Statement row(connection, "SELECT uuid, name FROM station WHERE own = 1");
  return row.step() ? Station{row.text(0), row.text(1)} : Station{};
}

}  // namespace

Station own_station(Database& database, const std::string& name, bool renew) {
  sqlite3* connection = database.connection();
  if (!name.empty()) check_printed("name of the station", name, 64);
  const Station seen = known_station(connection);
  if (!seen.uuid.empty() && !renew && (name.empty() || name == seen.name)) return seen;
  AnchoredTransaction transaction(database);
  Station own = known_station(connection);
  if (!name.empty()) own.name = name;
  if (own.name.empty()) own.name = host_name();
  if (own.uuid.empty() || renew) own.uuid = make_uuid();
  sql::execute(connection, "UPDATE station SET own = 0");
  sql::Statement insert(connection,
                        "INSERT INTO station VALUES (?1, ?2, 1) ON CONFLICT (uuid) DO UPDATE SET name = ?2, own = 1");
  insert.bind(own.uuid).bind(own.name).run();
  append_audit(connection, kActionStation, own.uuid, own.name);
  transaction.commit();
  return own;
}

std::int64_t cursor_of(const Database& database, const std::string& central) {
  sql::Statement row(database.connection(), "SELECT position FROM sync_cursor WHERE remote = ?");
  return row.bind(central).step() ? row.integer(0) : 0;
}

void set_cursor(const Database& database, const std::string& central, std::int64_t position) {
  sql::Statement row(database.connection(),
                     "INSERT INTO sync_cursor VALUES (?1, ?2, ?3)"
                     " ON CONFLICT (remote) DO UPDATE SET position = ?2, utc = ?3");
  row.bind(central).bind(position).bind(utc_now()).run();
}

}  // namespace trocar::sync
