#include "trainees/records/demo_record.h"

#include "haptics/input_error.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/audit.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

constexpr std::int64_t kMarkedAt = 2;  // the trail begins with "database made"

void tell(Database& database, const char* action) {
  AnchoredTransaction transaction(database);
  append_audit(database.connection(), action, "demo", "");
  transaction.commit();
}

bool is_whole(const Database& database) {
  sql::Statement row(database.connection(), "SELECT 1 FROM audit WHERE action = ?");
  return row.bind(kActionDemoWhole).step();
}

}  // namespace

bool is_demo(const Database& database) { return audit_action(database.connection(), kMarkedAt) == kActionDemo; }

void mark_demo(Database& database) {
  if (audit_head(database.connection()).position != kMarkedAt - 1)
    throw InputError(database.file().string() + ": is in use already and cannot become a demo");
  tell(database, kActionDemo);
}

void mark_demo_whole(Database& database) { tell(database, kActionDemoWhole); }

std::string attempt_not_invented(const Database& database) {
  sql::Statement row(database.connection(),
                     "SELECT uuid FROM attempt WHERE uuid NOT IN (SELECT u.subject FROM audit u WHERE u.action = ?1"
                     " AND u.position < (SELECT position FROM audit WHERE action = ?2)) ORDER BY id LIMIT 1");
  return row.bind(kActionFinished).bind(kActionDemoWhole).step() ? row.text(0) : "";
}

void require_no_demo(const Database& database, const std::string& what) {
  if (is_demo(database) && is_whole(database))
    throw InputError(database.file().string() + ": is the demo, whose people are invented: " + what);
}

}  // namespace trocar
