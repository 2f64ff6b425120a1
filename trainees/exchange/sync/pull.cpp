// What a station fetches: rules of everybody; what was said, decided and agreed about the people and attempts that it
// knows.
#include "trainees/exchange/sync/exchange.h"
#include "trainees/exchange/sync/fetch.h"
#include "trainees/records/demo_record.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

using namespace sync;  // NOLINT(google-build-using-namespace): this file is its public side

/// Trainees of this station who have not been erased; and with everybody who is the same person.
struct KnownHere {
  std::string own, all;  ///< JSON lists
};

KnownHere known_here(sqlite3* connection, const Links& links) {
  std::vector<std::string> own, all;
  sql::Statement rows(connection, "SELECT t.uuid FROM trainee t JOIN person p ON p.trainee_id = t.id ORDER BY t.uuid");
  while (rows.step()) {
    own.push_back(rows.text(0));
    for (const std::string& same : links.same_as(own.back())) all.push_back(same);
  }
  return {json_list(own), json_list(all)};
}

Wanted wanted_of(const CarriedTable& table, const KnownHere& known) {
  const std::string listed = "(SELECT json_array_elements_text($2::json))",
                    more = "(SELECT json_array_elements_text($3::json))";
  const std::string attempts = "(SELECT uuid FROM attempt WHERE trainee_uuid IN " + listed + ")";
  if (table.name == "curriculum" || table.name == "benchmark") return {};
  if (table.name == "note") {
    const std::string on_nothing = "(c.attempt_uuid IS NULL AND c.trainee_uuid IN " + more + ")";
    return {-1, "c.attempt_uuid IN " + attempts + " OR " + on_nothing, {known.own, known.all}};
  }
  if (table.name == "revocation") {
    return {
        -1, "c.certificate_uuid IN (SELECT uuid FROM certificate WHERE trainee_uuid IN " + listed + ")", {known.all}};
  }
  if (table.name == "assignment") return {-1, "c.trainee_uuid IS NULL OR c.trainee_uuid IN " + listed, {known.all}};
  if (table.name == "withdrawal") {
    return {-1,
            "c.assignment_uuid IN (SELECT uuid FROM assignment WHERE trainee_uuid IS NULL OR trainee_uuid IN " +
                listed + ")",
            {known.all}};
  }
  if (table.name == "consent" || table.name == "certificate" || table.name == "standing")
    return {-1, "c.trainee_uuid IN " + listed, {known.all}};
  return {-1, "c.attempt_uuid IN " + attempts, {known.own}};
}

}  // namespace

PullReport pull_from_central(Database& database, const CentralAddress& central, bool apply_erasures) {
  require_no_demo(database, "nothing is synchronised to it");
  CentralLink link(central);
  PullReport report;
  link.begin_reading();
  const Links links(link);
  take_erasures(link, database, apply_erasures, report);  // before what they are about
  const KnownHere known = known_here(database.connection(), links);
  for (const CarriedTable& table : carried_sealed()) {
    if (table.name != "erasure") take_sealed(link, database, table, wanted_of(table, known), links, report);
  }
  settle_links(database, links);
  take_memberships(link, database, links, report);
  take_seen(link, database, -1, report);
  link.commit();
  return report;
}

}  // namespace trocar
