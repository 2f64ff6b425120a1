// A transaction that may leave entries in the audit trail: once it stands, the trail's new head is anchored
// (anchor_file.h). It begins only where this program's own triggers alone act on it. Internal to trainees/.
#pragma once

#include "trainees/integrity/anchor_file.h"
#include "trainees/store/database.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {

class AnchoredTransaction {
 public:
  explicit AnchoredTransaction(Database& database)
      : database_(&database), transaction_(database.connection()), before_(audit_head(database.connection()).position) {
    database.require_own_schema();
  }

  /// Rolled back unless this is called.
  void commit() {
    transaction_.commit();
    const AuditHead head = audit_head(database_->connection());
    if (head.position != before_) append_anchor(database_->file(), head);
  }

 private:
  Database* database_;
  sql::Transaction transaction_;
  std::int64_t before_;
};

}  // namespace trocar
