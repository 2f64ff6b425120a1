#include "trainees/exchange/sync/central_link.h"

#include <sys/stat.h>

#include <fstream>
#include <pqxx/pqxx>

#include "haptics/input_error.h"
#include "trainees/exchange/sync/central_schema.h"
#include "trainees/records/attempt_identity.h"

namespace trocar::sync {
namespace {

constexpr const char* kLock = "SELECT pg_advisory_xact_lock(1414677330)";  // "TRCR"
// Doubles come back as they went; "exists already" is no news.
constexpr const char* kSettings =
    "SET LOCAL extra_float_digits = 3; SET LOCAL client_min_messages = warning; SET LOCAL search_path TO trocar; ";

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
    throw EnvironmentError("central database: no permission: " + one_line(error.what()));
  } catch (const pqxx::sql_error& error) {
    const std::string state = error.sqlstate().substr(0, 2);
    const std::string message = std::string("central database: ") + doing + ": " + one_line(error.what());
    if (state == "22" || state == "23" || state == "42") throw InputError(message);
    throw EnvironmentError(message);
  } catch (const pqxx::failure& error) {
    throw EnvironmentError(std::string("central database: ") + doing + ": " + one_line(error.what()));
  }
}

std::string password_of(const std::filesystem::path& file) {
  struct stat about {};
  if (stat(file.c_str(), &about) != 0)
    throw InputError(file.string() + ": the password cannot be read: there is no such file");
  if ((about.st_mode & 077) != 0) throw InputError(file.string() + ": others may read the password; chmod 600 first");
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  if (line.empty()) throw InputError(file.string() + ": its first line is to be the password; it is empty");
  return line;
}

std::string percent(const std::string& text) {
  static constexpr char kHex[] = "0123456789ABCDEF";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    out += '%';
    out += kHex[byte >> 4];
    out += kHex[byte & 15];
  }
  return out;
}

void add_option(std::string& url, const std::string& name, const std::string& value) {
  if (url.find("?" + name + "=") != std::string::npos || url.find("&" + name + "=") != std::string::npos) return;
  url += (url.find('?') == std::string::npos ? "?" : "&") + name + "=" + value;
}

}  // namespace

std::string connection_text(const CentralAddress& address) {
  std::string url = address.url;
  const std::size_t scheme = url.find("://");
  if (!url.starts_with("postgresql://") && !url.starts_with("postgres://")) {
    throw InputError("\"" + url +
                     "\": an address begins with postgresql://, as postgresql://trocar@central.example/trocar");
  }
  const std::string place = url.substr(scheme + 3, url.find_first_of("/?", scheme + 3) - scheme - 3);
  const std::size_t at = place.rfind('@');
  const bool in_place = at != std::string::npos && place.substr(0, at).find(':') != std::string::npos;
  if (in_place || url.find("password=") != std::string::npos) {
    throw InputError(
        "the address holds a password, which every process of this machine could read: use --password-file, ~/.pgpass "
        "or"
        " PGPASSWORD");
  }
  if (!address.password_file.empty()) add_option(url, "password", percent(password_of(address.password_file)));
  add_option(url, "connect_timeout", "10");
  add_option(url, "keepalives_idle", "20");
  add_option(url, "tcp_user_timeout", "30000");
  add_option(url, "application_name", "trocar");
  return url;
}

struct CentralLink::Session {
  explicit Session(const std::string& text) : connection(text) {}
  pqxx::connection connection;
  pqxx::quiet_errorhandler quiet{connection};
  std::unique_ptr<pqxx::work> transaction = {};
};

CentralLink::CentralLink(const CentralAddress& address) {
  const std::string text = connection_text(address);
  session_ = told("cannot be reached", [&] { return std::make_unique<Session>(text); });
  make_schema();
}

CentralLink::~CentralLink() = default;

void CentralLink::begin() {
  // A station that vanishes must not hold up the others.
  open(std::string("SET LOCAL idle_in_transaction_session_timeout = '60s'; ") + kSettings + kLock);
}

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

void CentralLink::touch() { run("UPDATE central SET revision = (SELECT last_value FROM arrival)"); }

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

void CentralLink::make_schema() {
  begin();
  int version = 0;
  if (run("SELECT to_regclass('trocar.central')").front().front()) {
    const Values about = run("SELECT uuid, version::text FROM central").front();
    uuid_ = *about[0];
    version = std::stoi(*about[1]);
  } else {
    uuid_ = make_uuid();
  }
  if (version > kCentralVersion) {
    throw EnvironmentError("central database: was made by a newer trocar (schema " + std::to_string(version) +
                           ", this program knows up to " + std::to_string(kCentralVersion) + "); it was left as it is");
  }
  for (const std::string& statement : central_statements(version)) run(statement);
  if (version == 0) {
    run("INSERT INTO central (uuid, version, revision) VALUES ($1, $2::integer, 0)",
        {uuid_, std::to_string(kCentralVersion)});
  }
  commit();
}

}  // namespace trocar::sync
