#include "trainees/records/signing.h"

#include "haptics/input_error.h"
#include "trainees/integrity/station_key.h"
#include "trainees/records/accounts.h"
#include "trainees/records/demo_record.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

/// Its newest password, or its first one, was set by another account.
bool given_by_another(sqlite3* connection, const std::string& account) {
  sql::Statement row(connection,
                     "SELECT actor FROM audit WHERE subject = ? AND action IN ('account added', 'account password')"
                     " ORDER BY position DESC LIMIT 1");
  return row.bind(account).step() && row.text(0) != "trocar" && row.text(0) != account;
}

}  // namespace

std::string why_no_signature(const Database& database, const std::string& account_uuid) {
  if (is_demo(database)) return "";
  sqlite3* connection = database.connection();
  if (const std::string lost = lost_key(connection); !lost.empty()) return lost;
  if (!account_uuid.empty())
    return given_by_another(connection, account_uuid)
               ? "your password was given to you by somebody else, who knows it too: set your own first"
               : "";
  if (accounts_kept(connection, false)) return "accounts are kept here, so only an account can sign: sign in first";
  if (sql::query_integer(connection, "SELECT count(*) FROM person") > 1)
    return "several people are kept here, so a signature must be somebody's: make an account first";
  return "";
}

void require_signature(const Database& database, const std::string& account_uuid) {
  if (const std::string why = why_no_signature(database, account_uuid); !why.empty())
    throw InputError("no signature: " + why);
}

void require_key(const Database& database) {
  if (const std::string lost = lost_key(database.connection()); !lost.empty())
    throw InputError("nothing was written, for what is not signed counts nowhere: " + lost);
}

}  // namespace trocar
