#include <algorithm>
#include <set>

#include "haptics/input_error.h"
#include "trainees/exchange/sync/batch.h"
#include "trainees/exchange/sync/central_address.h"
#include "trainees/exchange/sync/central_rights.h"
#include "trainees/exchange/sync/exchange.h"
#include "trainees/exchange/sync/station.h"
#include "trainees/exchange/sync/synchronise.h"
#include "trainees/integrity/audit.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/integrity/witness.h"
#include "trainees/records/demo_record.h"
#include "trainees/records/replica_facts.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

using namespace sync;  // NOLINT(google-build-using-namespace): this file is its public side

class Push {
 public:
  Push(CentralLink& link, Station station, PushReport& report)
      : link_(&link), station_(std::move(station)), report_(&report) {}

  /// Says who comes. @returns how far the centre has this station's trail.
  std::int64_t announce(sqlite3* connection) {
    link_->begin();
    tell_others();
    const Values about = link_->run("SELECT announce($1, $2)::text", {station_.uuid, station_.name}).front();
    const auto last =
        link_->run("SELECT position::text, row_hash FROM audit a WHERE station = $1 ORDER BY a.position DESC LIMIT 1",
                   {station_.uuid});
    link_->commit();
    if (!last.empty()) require_same_trail(connection, std::stoll(*last.front()[0]), *last.front()[1]);
    return std::stoll(*about.front());
  }

  void send(const Batch& batch) {
    link_->begin();
    for (const CarriedTable& table : carried_bases()) insert(table, rows_of(batch, table.name));
    send_attempts(batch);
    for (const CarriedTable& table : carried_sealed()) note_conflicts(table, insert(table, rows_of(batch, table.name)));
    send_audit(batch);
    keep_erased();
    if (!counted_.empty() || tells(batch)) link_->touch();
    link_->run("SELECT advance($1, $2::bigint)", {station_.uuid, std::to_string(batch.to)});
    link_->commit();
    take_count();
  }

  /// A person is not sealed: what was pushed last stands. Nobody comes back once erased.
  void send_identities(const Batch& batch) {
    link_->begin();
    insert(carried_bases()[2], rows_of(batch, carried_bases()[2].name));
    for (const CarriedTable& table : carried_sealed()) note_conflicts(table, insert(table, rows_of(batch, table.name)));
    const std::string changed =
        link_
            ->run("SELECT keep_people($1, $2::json)::text",
                  {station_.uuid, json_rows(carried_person(), rows_of(batch, carried_person().name))})
            .front()
            .front()
            .value_or("0");
    if (changed != "0") counted_["person"] += std::stoi(changed);
    keep_erased();
    if (!counted_.empty()) link_->touch();
    link_->commit();
    take_count();
  }

  /// When a note was met first, at whichever station, stands.
  void send_seen(const std::vector<Values>& rows) {
    static const CarriedTable kSeen{"note_seen", {{"note_uuid", "note_uuid"}, {"utc", "utc"}}, 1, ""};
    link_->begin();
    insert(kSeen, rows);
    keep_erased();
    if (!counted_.empty()) link_->touch();
    link_->commit();
    take_count();
  }

  /// The newest entry, signed: a witness that this station cannot take back.
  void send_head(const SignedHead& head) {
    link_->begin();
    link_->run(
        "INSERT INTO head (station, position, row_hash, utc, key, signature) VALUES ($1, $2::bigint, $3, $4, $5, $6)"
        " ON CONFLICT DO NOTHING",
        {station_.uuid, std::to_string(head.position), head.row_hash, head.utc, head.key, head.signature});
    link_->commit();
  }

  void tell_conflicts() {
    link_->begin();
    for (const Values& row : link_->run("SELECT kind, uuid, hash, kept, " + names_row() +
                                            " FROM conflict WHERE station = $1 ORDER BY kind, uuid, hash",
                                        {station_.uuid})) {
      report_->conflicts.push_back(*row[0] + " " + *row[1] + why_not(*row[2], *row[3], row[4] == "t"));
    }
    link_->commit();
  }

 private:
  /// @param kept the hash that is there, "" where the row may not come. @param named as names_row() says.
  static std::string why_not(const std::string& hash, const std::string& kept, bool named) {
    if (!kept.empty()) {
      return ": the central database has it with another hash (" + kept.substr(0, 12) + ", here " + hash.substr(0, 12) +
             "); nothing was overwritten";
    }
    if (!named) {
      return ": its UUID is none of trocar's, or of a time more than a year ahead of the central database's clock: it"
             " is not taken there. See whether the clock here is right";
    }
    return ": is about somebody of another station, or about a group; this login may not bring it, a desk may";
  }

  /// What came just now of people who were erased goes again.
  void keep_erased() {
    if (link_->run("SELECT 1 FROM erasure LIMIT 1").empty()) return;
    link_->run("SELECT erase()");
  }

  /// Entries that are news by themselves: others fetch groups and what erased people had signed by them.
  static bool tells(const Batch& batch) {
    return std::any_of(batch.audit.begin(), batch.audit.end(), [](const Values& entry) {
      const std::string action = entry[3].value_or("");
      return action == "group joined" || action == "group left" || action.ends_with(" erased");
    });
  }

  /// A station's login that comes as another than before: a record that was put in the place of another does so.
  void tell_others() {
    if (!link_->run("SELECT 1 FROM station WHERE uuid = $1", {station_.uuid}).empty()) return;
    for (const Values& row :
         link_->run("SELECT s.name, s.uuid, s.last_position::text FROM station s JOIN login l ON l.name = s.login AND"
                    " l.kind = 'station' WHERE s.login = session_user ORDER BY s.uuid")) {
      report_->told.push_back("this login pushed as station " + *row[0] + " (" + *row[1] + ") up to entry " + *row[2] +
                              " and comes as another station now: another record, or one under a new UUID");
    }
  }

  /// What was counted counts once it is committed.
  void take_count() {
    for (const auto& [table, count] : counted_) report_->added[table] += count;
    counted_.clear();
  }

  void require_same_trail(sqlite3* connection, std::int64_t position, const std::string& hash) const {
    const std::string here = audit_hash(connection, position);
    if (!here.empty() && here == hash) return;
    throw InputError("the audit trail of station " + station_.name + " (" + station_.uuid +
                     ") is not the one that was pushed, at position " + std::to_string(position) +
                     ": an older copy of the database was put back, or two machines use copies of one. Nothing"
                     " was pushed; --new-station goes on under a new UUID");
  }

  static const std::vector<Values>& rows_of(const Batch& batch, const std::string& table) {
    static const std::vector<Values> kNone;
    const auto found = batch.rows.find(table);
    return found == batch.rows.end() ? kNone : found->second;
  }

  /// @returns the rows that were there already.
  std::vector<Values> insert(const CarriedTable& table, const std::vector<Values>& rows) {
    const auto added = insert_central(*link_, table, rows, station_.uuid);
    if (!added.empty()) counted_[table.name] += static_cast<int>(added.size());
    if (table.seal.empty()) return {};
    const std::set<std::string> fresh(added.begin(), added.end());
    std::vector<Values> known;
    for (const Values& row : rows) {
      if (!fresh.contains(row.front().value_or(""))) known.push_back(row);
    }
    return known;
  }

  void send_attempts(const Batch& batch) {
    const auto& attempts = rows_of(batch, carried_attempt().name);
    const auto known = insert(carried_attempt(), attempts);
    note_conflicts(carried_attempt(), known);
    std::set<std::string> there;
    for (const Values& row : known) there.insert(row.front().value_or(""));
    for (const CarriedTable& table : carried_of_attempt()) {  // they came, or came not, with their attempt
      std::vector<Values> rows;
      for (const Values& row : rows_of(batch, table.name)) {
        if (!there.contains(row.front().value_or(""))) rows.push_back(row);
      }
      insert(table, rows);
    }
  }

  void send_audit(const Batch& batch) {
    const auto added = insert_central(*link_, carried_audit(), batch.audit, station_.uuid);
    if (added.size() == batch.audit.size()) return;
    // Those that were there must be these: another program may push the same file at this moment, but no other file as
    // this station.
    for (const Values& row : link_->run(
             "SELECT position::text, row_hash FROM audit a WHERE station = $1 AND position BETWEEN $2::bigint AND"
             " $3::bigint ORDER BY a.position",
             {station_.uuid, *batch.audit.front()[0], *batch.audit.back()[0]})) {
      const auto same =
          std::find_if(batch.audit.begin(), batch.audit.end(), [&](const Values& ours) { return ours[0] == row[0]; });
      if (same != batch.audit.end() && (*same)[7] != row[1])
        note_conflict("audit entry", *row[0], *(*same)[7], *row[1]);
    }
  }

  void note_conflicts(const CarriedTable& table, const std::vector<Values>& known) {
    if (known.empty()) return;
    std::vector<std::string> keys;
    for (const Values& row : known) keys.push_back(row.front().value_or(""));
    std::map<std::string, std::string> kept;
    for (const Values& row : link_->run("SELECT uuid, " + table.seal + " FROM \"" + table.name +
                                            "\" WHERE uuid IN (SELECT json_array_elements_text($1::json))",
                                        {json_list(keys)})) {
      kept[row[0].value_or("")] = row[1].value_or("");
    }
    for (const Values& row : known) {
      const std::string uuid = row.front().value_or(""), hash = row.back().value_or("");
      if (kept[uuid] != hash) note_conflict(table.name, uuid, hash, kept[uuid]);
    }
  }

  void note_conflict(const std::string& kind, const std::string& uuid, const std::string& hash,
                     const std::string& kept) {
    link_->run(
        "INSERT INTO conflict (station, kind, uuid, hash, kept) VALUES ($1, $2, $3, $4, $5) ON CONFLICT DO NOTHING",
        {station_.uuid, kind, uuid, hash, kept});
  }

  CentralLink* link_;
  Station station_;
  PushReport* report_;
  std::map<std::string, int> counted_;
};

}  // namespace

namespace sync {
namespace {

/// Changes when a note was met that had not been.
std::int64_t seen_mark(sqlite3* connection) {
  return sql::query_integer(connection, "SELECT count(*) + 1000003 * coalesce(sum(note_id), 0) FROM note_seen");
}

/// As signed entries say: what somebody put in goes nowhere.
std::vector<Values> seen_notes(sqlite3* connection) {
  std::vector<Values> rows;
  SeenEntries met(connection);
  sql::Statement notes(connection, "SELECT n.uuid FROM note_seen s JOIN note n ON n.id = s.note_id ORDER BY n.uuid");
  while (notes.step())
    if (std::string utc = met.when(notes.text(0)); !utc.empty()) rows.push_back({notes.text(0), std::move(utc)});
  return rows;
}

void send_batches(Push& push, Database& database, const std::string& central, const PushOptions& options,
                  PushReport& report) {
  for (;;) {
    const Batch batch = read_batch(database.connection(), report.to, options.batch);
    report.problems.insert(report.problems.end(), batch.problems.begin(), batch.problems.end());
    if (batch.to == report.to) return;
    push.send(batch);
    report.to = batch.to;
    set_cursor(database, central, report.to);
    if (options.after_batch) options.after_batch(report.to, audit_head(database.connection()).position);
  }
}

}  // namespace

std::vector<std::string> remarks_on(const CentralLink& link, const CentralAddress& central) {
  std::vector<std::string> remarks;
  if (const std::string weak = weak_tls_remark(central); !weak.empty()) remarks.push_back(weak);
  if (link.is_owner())
    remarks.emplace_back(
        "this login owns the central database and could rewrite all of it: let this place in under a login of its own"
        " (trocar sync admit)");
  return remarks;
}

PushReport push_over(CentralLink& link, Database& database, const PushOptions& options) {
  require_no_demo(database, "nothing is synchronised from it");
  if (options.with_identity && is_replica(database.connection())) {
    throw InputError(
        "this database is a copy for a desk: it knows people by what their stations pushed; identities go from there");
  }
  const Station station = own_station(database, options.station_name, options.new_station);
  PushReport report{station.uuid, station.name};
  Push push(link, station, report);
  const std::int64_t there = push.announce(database.connection());
  const std::int64_t known = options.new_station ? 0 : cursor_of(database, link.uuid());
  if (there < known) {
    report.told.push_back(
        "the central database knows this station up to entry " + std::to_string(there) + " of " +
        std::to_string(known) +
        " that it had: it was put back to an older state, or set up anew by a newer program. What is missing of this"
        " station is pushed again");
  }
  report.from = report.to = std::min(known, there);  // either side may have been put back
  send_batches(push, database, link.uuid(), options, report);
  if (report.to > 0) push.send_head(head_at(database, report.to));  // what came since goes the next time
  const std::string seen = "seen at " + link.uuid();
  const std::int64_t mark = seen_mark(database.connection());
  if (mark != 0 && (mark != cursor_of(database, seen) || there < known)) {
    push.send_seen(seen_notes(database.connection()));
    set_cursor(database, seen, mark);
  }
  if (options.with_identity) {
    const Batch identities = read_identities(database.connection());
    report.problems.insert(report.problems.end(), identities.problems.begin(), identities.problems.end());
    push.send_identities(identities);
  }
  if (options.recordings) {
    const int pushed = push_recordings(link, database, station.uuid, report.problems);
    if (pushed > 0) report.added["recording"] += pushed;
  }
  push.tell_conflicts();
  return report;
}

}  // namespace sync

PushReport push_to_central(Database& database, const PushOptions& options) {
  CentralLink link(options.central);
  PushReport report = push_over(link, database, options);
  report.remarks = remarks_on(link, options.central);
  return report;
}

}  // namespace trocar
