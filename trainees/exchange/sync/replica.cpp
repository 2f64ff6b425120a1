#include <algorithm>
#include <map>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "trainees/exchange/sync/exchange.h"
#include "trainees/exchange/sync/fetch.h"
#include "trainees/exchange/sync/station.h"
#include "trainees/exchange/sync/synchronise.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/attempt_chain.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/records/replica_facts.h"

namespace trocar {
namespace {

using namespace sync;  // NOLINT(google-build-using-namespace): this file is its public side

constexpr std::size_t kAttemptsAtOnce = 100;

struct AttemptThere {
  std::string uuid, station;
};

class Replica {
 public:
  Replica(CentralLink& link, Database& database, std::int64_t since, PullReport& report)
      : link_(&link), database_(&database), connection_(database.connection()), since_(since), report_(&report) {}

  void take_stations() {
    AnchoredTransaction transaction(*database_);
    mark_replica(connection_, link_->uuid());
    for (const Values& row : link_->run("SELECT uuid, name FROM station ORDER BY uuid")) {
      sql::Statement insert(
          connection_,
          "INSERT INTO station VALUES (?1, ?2, 0) ON CONFLICT (uuid) DO UPDATE SET name = ?2 WHERE own = 0");
      insert.bind(*row[0]).bind(*row[1]).run();
    }
    transaction.commit();
  }

  void take_bases() {
    for (const CarriedTable& table : carried_bases()) {
      fetch_missing(*link_, connection_, table, {since_}, [&](const std::vector<Values>& rows) {
        AnchoredTransaction transaction(*database_);
        int taken = 0;
        for (const Values& row : rows) {
          taken += take_one(connection_, table.name + " " + row.front().value_or(""), report_->problems,
                            [&] { take_base(table, row); });
        }
        if (taken == 0) return;
        transaction.commit();
        report_->added[table.name] += taken;
      });
    }
  }

  /// Codes and names where they were pushed; a code that says nothing for others, unless they were erased.
  void take_people() {
    AnchoredTransaction transaction(*database_);
    for (const Values& row : link_->run(
             "SELECT t.uuid, p.code, coalesce(p.name, ''), coalesce(p.email, '') FROM trainee t LEFT JOIN person p"
             " ON p.trainee_uuid = t.uuid WHERE greatest(t.seq, p.seq) > $1::bigint ORDER BY t.uuid",
             {std::to_string(since_)})) {
      const std::string uuid = *row[0], tail = uuid.substr(uuid.size() - std::min<std::size_t>(uuid.size(), 8));
      sql::Statement here(
          connection_,
          "SELECT t.id, EXISTS (SELECT 1 FROM erasure e WHERE trainee_id = t.id AND row_holds('erasure', e.id)),"
          " p.trainee_id IS NOT NULL"
          " FROM trainee t LEFT JOIN person p ON p.trainee_id = t.id WHERE t.uuid = ?");
      if (!here.bind(uuid).step() || here.integer(1) != 0) continue;
      if (!row[1] && here.integer(2) != 0) continue;
      const std::int64_t trainee = here.integer(0);
      here.run();
      take_one(connection_, "person of trainee " + uuid, report_->problems, [&] {
        take_person(uuid, trainee, free_code(row[1].value_or("unnamed-" + tail), trainee, uuid, tail), *row[2],
                    *row[3]);
      });
    }
    transaction.commit();
  }

  /// What erased people had signed and rated under their own names: the trails of the stations name it.
  void drop_own_words() {
    AnchoredTransaction transaction(*database_);
    bool dropped = false;
    for (const Values& row :
         link_->run("SELECT action, subject FROM audit WHERE action LIKE '% erased' AND action IN ('signature erased',"
                    " 'rating erased') ORDER BY subject")) {
      const std::string table = row[0]->substr(0, row[0]->find(' '));
      sql::Statement here(connection_, "SELECT e.uuid FROM " + table +
                                           " r JOIN attempt a ON a.id = r.attempt_id JOIN erasure e ON"
                                           " e.trainee_id = a.trainee_id AND row_holds('erasure', e.id)"
                                           " WHERE r.uuid = ?");
      if (!here.bind(*row[1]).step()) continue;
      note_erased_row(connection_, table, *row[1], here.text(0), "");
      here.run();
      sql::Statement(connection_, "DELETE FROM " + table + " WHERE uuid = ?").bind(*row[1]).run();
      dropped = true;
    }
    if (dropped) transaction.commit();
  }

  void take_attempts(const std::function<void(std::size_t, std::size_t)>& going) {
    std::map<std::string, bool> missing;
    for (const std::string& uuid : missing_here(*link_, connection_, carried_attempt(), {since_})) missing[uuid] = true;
    std::vector<AttemptThere> wanted;
    for (const Values& row : link_->run("SELECT uuid, station FROM attempt a WHERE a.seq > $1::bigint"
                                        " ORDER BY station, chain_position, uuid",
                                        {std::to_string(since_)})) {
      if (missing.contains(*row[0])) wanted.push_back({*row[0], *row[1]});
    }
    for (std::size_t from = 0; from < wanted.size(); from += kAttemptsAtOnce) {
      const auto begin = wanted.begin() + static_cast<std::ptrdiff_t>(from);
      take_some({begin, begin + static_cast<std::ptrdiff_t>(std::min(kAttemptsAtOnce, wanted.size() - from))});
      if (going) going(std::min(from + kAttemptsAtOnce, wanted.size()), wanted.size());
    }
  }

 private:
  using Rows = std::map<std::string, std::vector<Values>>;

  void take_base(const CarriedTable& table, const Values& row) {
    const std::string key = row.front().value_or("");
    if (table.name == "ruleset" && digest::of_bytes(row.back().value_or("")) != key)
      throw InputError("its content is not that of its hash; left out");
    insert_local(connection_, table, row);
    if (table.name == "trainee") keep_trainee(connection_, key, kFromCentre);
    if (table.name == "exercise") keep_exercise(connection_, key);
  }

  /// Two stations may have given one code to two people; and one may have chosen UUIDs whose ends are the same.
  std::string free_code(const std::string& code, std::int64_t trainee, const std::string& uuid,
                        std::string tail) const {
    sql::Statement taken(connection_, "SELECT 1 FROM person WHERE code = ? AND trainee_id <> ?");
    std::string free = code;
    for (int tries = 0; taken.bind(free).bind(trainee).step(); ++tries) {
      taken.run();
      free = code.substr(0, 23) + "-" + tail;
      tail = digest::of_bytes(uuid + " " + std::to_string(tries)).substr(0, 8);
    }
    return free;
  }

  void take_person(const std::string& uuid, std::int64_t trainee, const std::string& code, const std::string& name,
                   const std::string& email) {
    sql::Statement keep(
        connection_,
        "INSERT INTO person (trainee_id, code, name, email) VALUES (?1, ?2, ?3, ?4) ON CONFLICT (trainee_id)"
        " DO UPDATE SET code = ?2, name = ?3, email = ?4 WHERE (code, name, email) <> (?2, ?3, ?4) RETURNING 1");
    if (!keep.bind(trainee).bind(code).bind(name).bind(email).step()) return;  // as it was
    keep.run();
    keep_person(connection_, uuid, kFromCentre);
  }

  Rows by_attempt(const CarriedTable& table, const std::vector<std::string>& keys) const {
    Rows rows;
    for (Values& row : central_rows(*link_, table, keys)) rows[row.front().value_or("")].push_back(std::move(row));
    return rows;
  }

  void take_some(const std::vector<AttemptThere>& some) {
    std::vector<std::string> keys;
    for (const AttemptThere& one : some) keys.push_back(one.uuid);
    Rows attempts = by_attempt(carried_attempt(), keys);
    std::vector<Rows> parts;
    for (const CarriedTable& table : carried_of_attempt()) parts.push_back(by_attempt(table, keys));
    AnchoredTransaction transaction(*database_);
    int taken = 0;
    for (const AttemptThere& one : some) {
      taken += take_one(connection_, "attempt " + one.uuid, report_->problems,
                        [&] { insert_attempt(one, attempts.at(one.uuid).front(), parts); });
    }
    if (taken == 0) return;
    transaction.commit();
    report_->added["attempt"] += taken;
  }

  /// As a station does: begun as running, its rows, then frozen; but with the place in the chain that it has there.
  void insert_attempt(const AttemptThere& one, const Values& row, std::vector<Rows>& parts) {
    CarriedTable begun = carried_attempt();
    Values values = row;
    const auto found =
        std::find_if(begun.columns.begin(), begun.columns.end(), [](const Column& c) { return c.central == "status"; });
    const auto status = static_cast<std::size_t>(found - begun.columns.begin());
    values.at(status) = "running";
    const std::size_t sealed = begun.columns.size() - 3;  // chain_position, prev_hash, row_hash
    begun.columns.resize(sealed);
    insert_local(connection_, begun, values);
    const std::int64_t id = number_of_attempt(one.uuid);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (const Values& part : parts[i][one.uuid]) insert_local(connection_, carried_of_attempt()[i], part);
    }
    sql::Statement place(connection_, "INSERT INTO replica VALUES (?, ?, ?, ?)");
    place.bind(id)
        .bind(one.station)
        .bind(static_cast<std::int64_t>(std::stoll(row[sealed].value_or("0"))))
        .bind(row[sealed + 1].value_or(""))
        .run();
    sql::Statement freeze(connection_, "UPDATE attempt SET status = ?, row_hash = ? WHERE id = ?");
    freeze.bind(row.at(status).value_or("")).bind(row.back().value_or("")).bind(id).run();
    if (!erased(id) && !attempt_holds(connection_, id))
      throw InputError("its content is not that of its hash; left out");
    append_audit(connection_, kActionReplicated, one.uuid, row.back().value_or(""));
  }

  std::int64_t number_of_attempt(const std::string& uuid) const {
    sql::Statement row(connection_, "SELECT id FROM attempt WHERE uuid = ?");
    row.bind(uuid).step();
    return row.integer(0);
  }

  bool erased(std::int64_t id) const {
    sql::Statement row(
        connection_,
        "SELECT 1 FROM erasure e JOIN attempt a ON a.trainee_id = e.trainee_id WHERE a.id = ? AND e.kind = 'training'"
        " AND row_holds('erasure', e.id)");
    return row.bind(id).step();
  }

  CentralLink* link_;
  Database* database_;
  sqlite3* connection_;
  std::int64_t since_;
  PullReport* report_;
};

}  // namespace

namespace sync {

void require_place_of_copy(const Database& database, const std::string& central) {
  const std::string of = replica_of(database.connection());
  if (!of.empty() && of != central) {
    throw InputError(database.file().string() +
                     ": is a copy of another central database; give this one a file of its own (--db FILE)");
  }
  if (sql::query_integer(database.connection(),
                         "SELECT EXISTS (SELECT 1 FROM attempt WHERE id NOT IN (SELECT attempt_id FROM replica))") == 0)
    return;
  throw InputError(database.file().string() +
                   ": holds attempts of its own; what all stations have goes to a file of its own (--db FILE)");
}

std::string arrivals_of(const std::string& central_uuid) { return "arrivals of " + central_uuid; }

PullReport replicate_over(CentralLink& link, Database& database, const ReplicaOptions& options, bool whole) {
  PullReport report;
  link.begin_reading();
  const std::int64_t known = cursor_of(database, arrivals_of(link.uuid())), there = link.revision();
  if (there < known) {
    report.told.push_back("the central database is older than what this copy had of it (arrival " +
                          std::to_string(there) + " of " + std::to_string(known) +
                          "): it was put back to an older state. Stations push again what is missing");
  }
  const std::int64_t since = whole || known == 0 || there < known ? -1 : known;
  Replica replica(link, database, since, report);
  require_place_of_copy(database, link.uuid());
  replica.take_stations();
  replica.take_bases();
  take_erasures(link, database, true, report);  // before what they are about
  replica.drop_own_words();
  replica.take_people();
  replica.take_attempts(options.going);
  const Links links(link);
  for (const CarriedTable& table : carried_sealed()) {
    if (table.name != "erasure") take_sealed(link, database, table, {since}, links, report);
  }
  settle_links(database, links);
  take_memberships(link, database, links, report);
  take_seen(link, database, since, report);
  drop_erased_recordings(database);
  link.commit();
  if (options.recordings) {
    const int fetched = fetch_recordings(link, database, report.problems);
    if (fetched > 0) report.added["recording"] += fetched;
  }
  set_cursor(database, arrivals_of(link.uuid()), there);
  return report;
}

}  // namespace sync

PullReport replicate_central(Database& database, const ReplicaOptions& options) {
  CentralLink link(options.central);
  return replicate_over(link, database, options, true);
}

}  // namespace trocar
