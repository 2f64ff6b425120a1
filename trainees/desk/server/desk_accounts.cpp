#include "trainees/desk/server/desk_accounts.h"

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "trainees/records/attempt_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::review {

bool somebody_can_sign_in(const Database& database) { return accounts_kept(database.connection(), true); }

std::string sign_in_stamp(const Database& database, const std::string& account_uuid) {
  sql::Statement row(database.connection(),
                     "SELECT password, role, trainee_id, login FROM account"
                     " WHERE uuid = ? AND disabled_utc IS NULL AND password <> ''");
  row.bind(account_uuid);
  if (!row.step()) return "";
  return digest::of_bytes(row.canonical(0) + row.canonical(1) + row.canonical(2) + row.canonical(3));
}

bool may_see_trainee(const Account& account, const std::string& code) {
  return account.role != Role::kTrainee || (!account.trainee_code.empty() && account.trainee_code == code);
}

std::optional<std::string> own_attempt(const Account& account, Database& database, const std::string& attempt) {
  try {
    const AttemptSummary found = AttemptStore(database).find(attempt);
    return may_see_trainee(account, found.trainee) ? std::optional(found.uuid) : std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

bool may_see_certificate(const Account& account, const Database& database, const std::string& certificate_uuid) {
  if (account.role != Role::kTrainee) return true;
  sql::Statement row(database.connection(),
                     "SELECT p.code FROM certificate c JOIN person p ON p.trainee_id = c.trainee_id WHERE c.uuid = ?");
  row.bind(certificate_uuid);
  return row.step() && may_see_trainee(account, row.text(0));
}

bool names_another(const Database& database, const std::string& text, const std::string& code) {
  sql::Statement row(database.connection(),
                     "SELECT 1 FROM known_trainee k WHERE k.code <> ?2 COLLATE NOCASE AND (k.code = ?1 COLLATE NOCASE "
                     "OR k.uuid = ?1 COLLATE NOCASE"
                     " OR k.id IN (SELECT trainee_id FROM attempt WHERE uuid = lower(?1))"
                     " OR k.id IN (SELECT trainee_id FROM certificate WHERE uuid = lower(?1))"
                     " OR k.id IN (SELECT trainee_id FROM account WHERE uuid = lower(?1)))");
  row.bind(text).bind(code);
  return row.step();
}

Account local_instructor() {
  Account out;
  out.login = "local";
  out.name = "Local instructor";
  out.role = Role::kAdministrator;
  return out;
}

}  // namespace trocar::review
