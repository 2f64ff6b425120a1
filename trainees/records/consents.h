// Consents of a trainee: given and withdrawn are rows of their own, the newest of a purpose holds. Sealed rows
// (sealed_rows.h).
//
// Training itself usually rests on another basis than consent (docs/privacy.md); research is the purpose that needs
// one. Thread: that of the Database.
#pragma once

#include <string>
#include <vector>

#include "trainees/records/assessments.h"

namespace trocar {

struct Consent {
  std::string uuid, purpose, text, author, utc;
  bool given = false;
};

class ConsentStore {
 public:
  explicit ConsentStore(Database& database) : database_(&database) {}

  /// @param purpose "research", 1 to 64 characters. @param text what was agreed to or withdrawn, in its words.
  /// @throws InputError: no such trainee, purpose or text empty, a withdrawal of what does not hold.
  Consent record(const std::string& trainee, const std::string& purpose, bool given, const std::string& text,
                 const Author& author);
  std::vector<Consent> of(const std::string& trainee) const;  ///< newest first
  bool holds(const std::string& trainee, const std::string& purpose) const;

 private:
  Database* database_;
};

}  // namespace trocar
