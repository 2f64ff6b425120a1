#include "trainees/exchange/sync/central_link.h"

#include <pqxx/pqxx>

#include "haptics/input_error.h"
#include "trainees/exchange/sync/central_address.h"
#include "trainees/exchange/sync/central_schema.h"
#include "trainees/records/attempt_identity.h"

namespace trocar::sync {
namespace {

constexpr const char* kLock = "SELECT pg_advisory_xact_lock(1414677330)";  // "TRCR"
// Whoever may connect can hold that lock: nobody waits for it for ever. A shorter or longer time that the server's
// administrator has set for the login stands.
constexpr const char* kPatience =
    "SELECT set_config('lock_timeout', '30s', true) WHERE current_setting('lock_timeout') = '0'; ";
constexpr const char* kHolders =
    "SELECT coalesce(string_agg(DISTINCT 'login ' || coalesce(s.usename::text, '?') || ' (process ' || l.pid || ')',"
    " ', '), 'nobody any more') FROM pg_locks l LEFT JOIN pg_stat_activity s ON s.pid = l.pid WHERE l.granted AND"
    " l.locktype = 'advisory' AND l.classid = 0 AND l.objid = 1414677330 AND l.database = (SELECT oid FROM pg_database"
    " WHERE datname = current_database())";
// Doubles come back as they went; "exists already" is no news; compiling a short statement takes longer than running
// it.
constexpr const char* kSettings =
    "SET LOCAL extra_float_digits = 3; SET LOCAL client_min_messages = warning; SET LOCAL search_path TO trocar; "
    "SET LOCAL jit = off; ";

/// Somebody else has had a lock for too long.
struct LockHeld : EnvironmentError {
  using EnvironmentError::EnvironmentError;
};

/// libpq's own words end in line ends.
std::string one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  for (char& c : text) {
    if (c == '\n' || c == '\t') c = ' ';
  }
  return text;
}

template <class Action>
auto told(const char* doing, const Action& action) {
  try {
    return action();
  } catch (const pqxx::broken_connection& error) {
    throw EnvironmentError(std::string("central database: ") + doing + ": " + one_line(error.what()) +
                           "; what was committed stays, the same command goes on from there");
  } catch (const pqxx::in_doubt_error& error) {
    throw EnvironmentError(std::string("central database: the connection was lost while it committed: ") +
                           one_line(error.what()) + "; the same command goes on, whichever way it ended");
  } catch (const pqxx::insufficient_privilege& error) {
    throw EnvironmentError("central database: no permission (is this login let in? trocar sync admit): " +
                           one_line(error.what()));
  } catch (const pqxx::sql_error& error) {
    if (error.sqlstate() == "55P03")
      throw LockHeld(std::string("central database: ") + doing + ": " + one_line(error.what()));
    const std::string state = error.sqlstate().substr(0, 2);
    const std::string message = std::string("central database: ") + doing + ": " + one_line(error.what());
    if (state == "22" || state == "23" || state == "42") throw InputError(message);
    throw EnvironmentError(message);
  } catch (const pqxx::failure& error) {
    throw EnvironmentError(std::string("central database: ") + doing + ": " + one_line(error.what()));
  }
}

}  // namespace

struct CentralLink::Session {
  explicit Session(const std::string& text) : connection(text) {}
  pqxx::connection connection;
  pqxx::quiet_errorhandler quiet{connection};
  std::unique_ptr<pqxx::work> transaction = {};
};

CentralLink::CentralLink(const CentralAddress& address, Purpose purpose) {
  const std::string text = connection_text(address);
  try {
    session_ = std::make_unique<Session>(text);
  } catch (const pqxx::failure& error) {
    throw EnvironmentError("central database: cannot be reached: " + connecting_words(one_line(error.what())));
  }
  if (purpose == Purpose::kUse) look();
}

CentralLink::~CentralLink() = default;

void CentralLink::begin() {
  // A station that vanishes must not hold up the others.
  try {
    open(std::string("SET LOCAL idle_in_transaction_session_timeout = '60s'; ") + kSettings + kPatience + kLock);
  } catch (const LockHeld&) {
    begin_reading();
    const std::string holders = run(kHolders).front().front().value_or("");
    commit();
    throw EnvironmentError("central database: somebody holds the lock that writers take, for too long now: " + holders +
                           "; nothing is lost, the same command goes on when it is free (its owner ends a login's"
                           " sessions with trocar sync dismiss LOGIN)");
  }
}

void CentralLink::begin_out_of_turn() { open(std::string(kSettings) + kPatience + "SELECT 1"); }

void CentralLink::begin_reading() {
  open(std::string("SET TRANSACTION ISOLATION LEVEL REPEATABLE READ READ ONLY; ") + kSettings + "SELECT 1");
}

void CentralLink::open(const std::string& first) {
  told("a transaction cannot begin", [&] {
    session_->transaction.reset();
    session_->transaction = std::make_unique<pqxx::work>(session_->connection);
    session_->transaction->exec(first);
  });
}

void CentralLink::commit() {
  told("a transaction cannot be committed", [&] {
    session_->transaction->commit();
    session_->transaction.reset();
  });
}

void CentralLink::touch() { run("SELECT touch()"); }

std::int64_t CentralLink::revision() {
  return std::stoll(run("SELECT revision::text FROM central").front().front().value_or("0"));
}

std::vector<Values> CentralLink::run(const std::string& sql, const std::vector<std::string>& parameters) {
  return told("a statement failed", [&] {
    const pqxx::result result = session_->transaction->exec_params(
        sql, pqxx::prepare::make_dynamic_params(parameters.begin(), parameters.end()));
    std::vector<Values> rows;
    for (const auto& row : result) {
      Values values;
      for (const auto& field : row) {
        values.push_back(field.is_null() ? std::nullopt
                                         : std::optional<std::string>(std::string(field.c_str(), field.size())));
      }
      rows.push_back(std::move(values));
    }
    return rows;
  });
}

int CentralLink::version() {
  if (!run("SELECT to_regclass('trocar.central')").front().front()) return 0;
  const Values about = run("SELECT uuid, version::text FROM central").front();
  uuid_ = *about[0];
  const int version = std::stoi(*about[1]);
  if (version > kCentralVersion) {
    throw EnvironmentError("central database: was made by a newer trocar (schema " + std::to_string(version) +
                           ", this program knows up to " + std::to_string(kCentralVersion) + "); it was left as it is");
  }
  return version;
}

int CentralLink::make_schema() {
  const int before = version();
  if (before == kCentralVersion) return before;
  for (const std::string& statement : central_statements(before)) run(statement);
  if (before == 0) {
    uuid_ = make_uuid();
    run("INSERT INTO central (uuid, version, revision) VALUES ($1, $2::integer, 0)",
        {uuid_, std::to_string(kCentralVersion)});
  }
  return before;
}

void CentralLink::look() {
  begin_reading();
  if (const int there = version(); there < kCentralVersion) {
    throw EnvironmentError((there == 0 ? std::string("central database: nothing of trocar is there yet")
                                       : "central database: is of an older trocar (schema " + std::to_string(there) +
                                             ", this program needs " + std::to_string(kCentralVersion) + ")") +
                           ": its owner sets it up with trocar sync central --at URL");
  }
  owner_ = run("SELECT is_owner()").front().front() == "t";
  commit();
}

}  // namespace trocar::sync
