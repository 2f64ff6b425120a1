// The rights of a person over the record: everything about one, as JSON; and erasure, which is itself recorded.
//
// Identity: name, e-mail, code, groups, notes, consents, the account, and what it signed and rated; attempts stay under
// the trainee's UUID, which nobody can tell any more. Training: also events, scores, metrics, sub-scores, warnings,
// ratings, signatures, overrides, certificates and the files of the recordings; the attempts' bare rows stay with their
// hashes, so that the chain of everybody else's still holds. Erased bytes are overwritten with zeros in the database's
// file. Backups made before keep what they have: docs/privacy.md says so. Thread: that of the Database.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "trainees/records/assessments.h"

namespace trocar {

enum class ErasureKind : std::uint8_t { kIdentity, kTraining };

struct ErasureReport {
  std::string trainee_uuid;
  int attempts = 0, notes = 0;
  std::vector<std::filesystem::path> recordings = {};  ///< files removed
  std::vector<std::string> left = {};                  ///< what could not be removed, and why
};

/// What an erasure would take, counted; nothing is changed.
struct ErasurePreview {
  std::string code, trainee_uuid, last_utc;  ///< last_utc: start of the newest attempt, else when the trainee was added
  int attempts = 0;                          ///< emptied with kTraining, else kept without a name
  int notes = 0, consents = 0, groups = 0, accounts = 0;
  int assessments = 0;  ///< signatures, ratings, overrides: own ones, with kTraining all on the attempts
  int certificates = 0, recordings = 0;  ///< with kTraining; files that are there
};
/// @throws InputError as erase_trainee().
ErasurePreview preview_erasure(Database& database, const std::string& trainee, ErasureKind kind);

/// An erasure that was interrupted after it was recorded is completed by the same call; kTraining may follow kIdentity.
/// @param trainee code, or "erased-..." or the UUID of somebody whose identity has gone.
/// @param rule why: "request of the person", "retention 730 days".
/// @throws InputError: no such trainee, an attempt of theirs runs. EnvironmentError: the database cannot take it;
/// nothing is erased then.
ErasureReport erase_trainee(Database& database, const std::string& trainee, ErasureKind kind, const std::string& rule,
                            const Author& author);

/// Codes whose newest attempt (or creation, without one) is older than so many days before `now_utc`, without those
/// whose attempt runs.
std::vector<std::string> older_than(Database& database, int days, const std::string& now_utc);

/// Everything kept of one person as JSON (UTF-8, two-space indent): identity, consents, attempts with every number,
/// notes, signatures, overrides, certificates, ratings, groups, audit entries that name them, and the files of the
/// recordings. @throws InputError: nobody.
std::string everything_about(Database& database, const std::string& trainee);

}  // namespace trocar
