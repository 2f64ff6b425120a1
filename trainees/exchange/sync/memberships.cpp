// Groups, and that notes were met: what changes at stations and at desks without being sealed.
#include <map>
#include <set>

#include "trainees/exchange/sync/fetch.h"
#include "trainees/exchange/sync/station.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/integrity/sealed_rows.h"

namespace trocar::sync {
namespace {

using Membership = std::pair<std::string, std::string>;  // UUID of the trainee here, group

/// What was joined or left here and the centre has not heard of.
std::set<Membership> unpushed(sqlite3* connection, std::int64_t cursor, const Links& links) {
  std::set<Membership> all;
  sql::Statement rows(
      connection, "SELECT subject, detail FROM audit WHERE position > ? AND action IN ('group joined', 'group left')");
  rows.bind(cursor);
  while (rows.step()) all.emplace(links.home(connection, rows.text(0)), rows.text(1));
  return all;
}

/// A person is in a group when one of the trainees that they are is. What a station's login brought counts for that
/// login's own people and for those who were linked to them; a desk's for everybody.
std::map<Membership, bool> at_the_centre(CentralLink& link, sqlite3* connection, const Links& links) {
  std::map<Membership, bool> all;
  for (const Values& row : link.run(
           "WITH own AS (SELECT t.uuid, s.login FROM trainee t JOIN station s ON s.uuid = t.station),"
           " whose AS (SELECT uuid, login FROM own UNION SELECT l.same_uuid, o.login FROM own o JOIN linked_trainee l"
           " ON l.trainee_uuid = o.uuid) SELECT DISTINCT ON (subject, detail) subject, detail, action FROM audit a"
           " JOIN station b ON b.uuid = a.station WHERE action IN ('group joined', 'group left') AND (a.of_desk OR"
           " (a.subject, b.login) IN (SELECT uuid, login FROM whose)) ORDER BY subject, detail, a.seq DESC")) {
    bool& member = all[{links.home(connection, *row[0]), *row[1]}];
    member = member || *row[2] == "group joined";
  }
  return all;
}

/// Row of a trainee who has a name here; 0: none.
std::int64_t named_trainee(sqlite3* connection, const std::string& uuid) {
  sql::Statement row(connection, "SELECT t.id FROM trainee t JOIN person p ON p.trainee_id = t.id WHERE t.uuid = ?");
  return row.bind(uuid).step() ? row.integer(0) : 0;
}

void change(sqlite3* connection, std::int64_t trainee, const Membership& membership, bool joined) {
  sql::Statement row(connection, joined ? "INSERT INTO membership VALUES (?, ?)"
                                        : "DELETE FROM membership WHERE trainee_id = ? AND group_name = ?");
  row.bind(trainee).bind(membership.second).run();
  append_audit(connection, joined ? "group joined elsewhere" : "group left elsewhere", membership.first,
               membership.second, kFromCentre);
}

}  // namespace

void take_memberships(CentralLink& link, Database& database, const Links& links, PullReport& report) {
  sqlite3* connection = database.connection();
  const auto there = at_the_centre(link, connection, links);
  if (there.empty()) return;
  AnchoredTransaction transaction(database);
  const auto own = unpushed(connection, cursor_of(database, link.uuid()), links);
  int changed = 0;
  for (const auto& [membership, member] : there) {
    const std::int64_t trainee = named_trainee(connection, membership.first);
    if (trainee == 0 || own.contains(membership)) continue;
    sql::Statement known(connection, "SELECT 1 FROM membership WHERE trainee_id = ? AND group_name = ?");
    if (known.bind(trainee).bind(membership.second).step() == member) continue;
    known.run();
    changed +=
        take_one(connection, "membership of trainee " + membership.first + " in \"" + membership.second + "\"",
                 report.problems, [&, joined = member, &of = membership] { change(connection, trainee, of, joined); });
  }
  if (changed == 0) return;
  transaction.commit();
  report.added["membership"] += changed;
}

void take_seen(CentralLink& link, Database& database, std::int64_t since, PullReport& report) {
  const auto rows = link.run("SELECT note_uuid, utc FROM note_seen WHERE seq > $1::bigint ORDER BY note_uuid",
                             {std::to_string(since)});
  if (rows.empty()) return;
  AnchoredTransaction transaction(database);
  int taken = 0;
  for (const Values& row : rows) {
    bool news = false;
    if (take_one(database.connection(), "that note " + *row[0] + " was met", report.problems,
                 [&] { news = keep_note_seen(database.connection(), *row[0], *row[1], kFromCentre); }))
      taken += news;
  }
  transaction.commit();
  if (taken > 0) report.added["note_seen"] += taken;
}

}  // namespace trocar::sync
