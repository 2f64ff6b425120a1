// The centre as a witness: heads of this record's trail that it pushed, against the trail that is here now.
#include <set>

#include "trainees/exchange/sync/carried_rows.h"
#include "trainees/exchange/sync/central_link.h"
#include "trainees/exchange/sync/synchronise.h"
#include "trainees/integrity/audit.h"
#include "trainees/integrity/witness.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

using namespace sync;  // NOLINT(google-build-using-namespace): this file is its public side

/// Every station that this record says that it was.
std::vector<std::string> own_names(const Database& database) {
  std::vector<std::string> uuids;
  sql::Statement rows(database.connection(), "SELECT DISTINCT subject FROM audit WHERE action = ? ORDER BY subject");
  rows.bind(kActionStation);
  while (rows.step()) uuids.push_back(rows.text(0));
  return uuids;
}

/// The last entry up to which the trail that the centre has is the one here. Chains part once and for good.
std::int64_t last_common(CentralLink& link, const Database& database, const std::string& station) {
  const auto top = link.run("SELECT coalesce(max(position), 0)::text FROM audit WHERE station = $1", {station});
  std::int64_t same = 0, parted = std::stoll(*top.front()[0]) + 1;
  while (same + 1 < parted) {
    const std::int64_t middle = same + (parted - same) / 2;
    const auto row = link.run("SELECT row_hash FROM audit WHERE station = $1 AND position = $2::bigint",
                              {station, std::to_string(middle)});
    const std::string here = audit_hash(database.connection(), middle);
    const bool holds = !row.empty() && !here.empty() && here == row.front()[0].value_or("");
    (holds ? same : parted) = middle;
  }
  return same;
}

struct HeadThere {
  std::string station, name;
  SignedHead head;
};

/// The newest ones first, station by station.
std::vector<HeadThere> heads_there(CentralLink& link, const std::vector<std::string>& stations) {
  std::vector<HeadThere> all;
  for (const Values& row : link.run(
           "SELECT h.station, s.name, h.position::text, h.row_hash, h.utc, h.key, h.signature FROM head h JOIN station"
           " s ON s.uuid = h.station WHERE h.station IN (SELECT json_array_elements_text($1::json)) OR s.login IN "
           "(SELECT"
           " name FROM login WHERE name = session_user AND kind = 'station') ORDER BY h.station, h.position DESC",
           {json_list(stations)})) {
    all.push_back({*row[0], *row[1], {std::stoll(*row[2]), *row[3], *row[4], *row[5], *row[6]}});
  }
  return all;
}

}  // namespace

std::vector<std::string> check_central_witness(const Database& database, const CentralAddress& central) {
  CentralLink link(central);
  link.begin_reading();
  std::vector<std::string> problems;
  std::set<std::string> parted;  ///< stations of which a line says so
  const auto heads = heads_there(link, own_names(database));
  for (const HeadThere& there : heads) {
    const std::string from = "station " + there.name + " (" + there.station + ") at the central database";
    if (!head_holds(there.head))
      problems.push_back("witness " + from + ": the head of entry " + std::to_string(there.head.position) +
                         " bears no signature of its key: somebody else left it there");
    const std::string problem = check_head(database, there.head, from);
    if (problem.empty() || !parted.insert(there.station).second) continue;
    problems.push_back(problem + "; the same up to entry " +
                       std::to_string(last_common(link, database, there.station)));
  }
  if (heads.empty())
    problems.emplace_back(
        "witness: the central database has no head of this record: it was never pushed there, or another record lies"
        " in its place");
  link.commit();
  return problems;
}

}  // namespace trocar
