// A transaction that ends with entries of the audit trail: once it stands, the trail's new head is anchored (anchor_file.h).
// Internal to trainees/.
#pragma once

#include "trainees/anchor_file.h"
#include "trainees/database.h"
#include "trainees/sqlite_handle.h"

namespace trocar {

class AnchoredTransaction {
 public:
  explicit AnchoredTransaction(Database& database) : database_(&database), transaction_(database.connection()) {}

  /// Rolled back unless this is called.
  void commit() {
    transaction_.commit();
    append_anchor(database_->file(), audit_head(database_->connection()));
  }

 private:
  Database* database_;
  sql::Transaction transaction_;
};

}  // namespace trocar
