// People who are known under several trainees, because somebody linked them at the centre. Internal to
// trainees/exchange/sync.
//
// Nothing is renamed there: the centre keeps who is the same as whom, and every database puts rows that came from it
// under one of them, its "home": the lowest UUID among those that have a name here, else among those that are known
// here. What was linked can be parted again: each moved row keeps, in the audit trail, the trainee it was written of
// (replica_facts.h). A station's own attempts are never moved.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "trainees/exchange/sync/central_link.h"
#include "trainees/store/database.h"

namespace trocar::sync {

class Links {
 public:
  Links() = default;
  /// Those that hold at the centre. Inside a transaction of it.
  explicit Links(CentralLink& link);

  bool empty() const { return groups_.empty(); }
  /// The trainee and all who are the same, by UUID; alone when nobody is.
  std::vector<std::string> same_as(const std::string& trainee) const;
  /// UUID of the trainee under which rows of `origin` stand in this database.
  std::string home(sqlite3* connection, const std::string& origin) const;
  const std::map<std::string, std::vector<std::string>>& groups() const { return groups_; }

 private:
  std::map<std::string, std::vector<std::string>> groups_;  ///< sorted, with the key
};

/// Says in the audit trail that the row was written of `origin`. Inside a transaction.
void note_origin(sqlite3* connection, const std::string& row, const std::string& origin);

/// Moves notes, consents, certificates and attempts of other stations to where they belong now. @returns how many.
int settle_links(Database& database, const Links& links);

}  // namespace trocar::sync
