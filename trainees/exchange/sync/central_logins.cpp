#include "trainees/exchange/sync/central_logins.h"

#include <sodium.h>

#include <chrono>
#include <thread>

#include "haptics/input_error.h"
#include "trainees/exchange/sync/central_address.h"
#include "trainees/exchange/sync/central_link.h"
#include "trainees/exchange/sync/central_rights.h"
#include "trainees/exchange/sync/central_schema.h"
#include "trainees/files/write_file.h"

namespace trocar {
namespace {

using namespace sync;  // NOLINT(google-build-using-namespace): this file is its public side

constexpr const char* kOwnerName = "(SELECT nspowner FROM pg_namespace WHERE nspname = 'trocar')";

/// @throws InputError.
void require_owner(CentralLink& link) {
  if (link.run(std::string("SELECT pg_has_role(session_user, ") + kOwnerName + ", 'USAGE')").front().front() == "t")
    return;
  throw InputError("central database: only its owner, " +
                   link.run(std::string("SELECT pg_get_userbyid(") + kOwnerName + ")").front().front().value_or("") +
                   ", may do that");
}

/// Why a role is no station's: "" when it may nothing by itself.
std::string too_mighty(CentralLink& link, const std::string& role) {
  const auto found = link.run(
      std::string("SELECT concat_ws(', ', CASE WHEN rolsuper THEN 'is a superuser' END, CASE WHEN rolcreaterole THEN"
                  " 'may make roles' END, CASE WHEN rolbypassrls THEN 'passes by row-level security' END, CASE WHEN"
                  " rolreplication THEN 'may replicate' END, CASE WHEN pg_has_role(oid, ") +
          kOwnerName +
          ", 'MEMBER') THEN 'is the owner or a member of it' END, CASE WHEN EXISTS (SELECT 1 FROM pg_auth_members m"
          " WHERE m.member = r.oid) THEN 'is a member of other roles' END, CASE WHEN EXISTS (SELECT 1 FROM pg_database"
          " d WHERE d.datname = current_database() AND d.datdba = r.oid) THEN 'owns the database' END)"
          " FROM pg_roles r WHERE rolname = $1",
      {role});
  return found.empty() ? "is no role of this server any more" : found.front().front().value_or("");
}

std::string random_password() {
  static constexpr char kLetters[] = "abcdefghijkmnpqrstuvwxyzABCDEFGHJKLMNPQRSTUVWXYZ23456789";
  if (sodium_init() < 0) throw EnvironmentError("libsodium cannot be initialised");
  std::string text;
  for (int i = 0; i < 32; ++i) text += kLetters[randombytes_uniform(sizeof kLetters - 1)];
  return text;
}

/// @returns the password.
std::string make_role(CentralLink& link, const CentralAddress& central, const std::string& name) {
  const std::string password = random_password();
  // A statement that makes a role takes no parameters: the server quotes them.
  const auto statement = link.run(
      "SELECT format('CREATE ROLE %I LOGIN NOINHERIT NOSUPERUSER NOCREATEDB NOCREATEROLE PASSWORD %L', $1::text,"
      " $2::text)",
      {name, encrypted_password(central, name, password)});
  link.run(statement.front().front().value_or(""));
  return password;
}

/// A statement that names a role takes no parameters: the server quotes the name. @param pattern for format().
void run_for_role(CentralLink& link, const std::string& pattern, const std::string& role) {
  link.run(link.run("SELECT format($1, $2::text)", {pattern, role}).front().front().value_or(""));
}

/// The same, without effect where this owner may not.
void try_for_role(CentralLink& link, const std::string& block, const std::string& role) {
  link.run(link.run("SELECT format('DO %L', format($1, $2::text))",
                    {"BEGIN " + block + " EXCEPTION WHEN insufficient_privilege THEN NULL; END", role})
               .front()
               .front()
               .value_or(""));
}

constexpr const char* kEndSessions =
    "PERFORM pg_terminate_backend(pid) FROM pg_stat_activity WHERE usename = %1$L AND pid <> pg_backend_pid();";

/// Ends what is open of a login. Who made a role may end its sessions only as a member of it. @returns how many go on.
int end_sessions(CentralLink& link, const std::string& login) {
  link.begin_out_of_turn();
  try_for_role(link,
               std::string("BEGIN ") + kEndSessions +
                   " EXCEPTION WHEN insufficient_privilege THEN GRANT %1$I TO SESSION_USER; " + kEndSessions +
                   " REVOKE %1$I FROM SESSION_USER; END;",
               login);
  link.commit();
  int open = 0;
  for (int i = 0; i < 20; ++i) {  // each ends when it comes to it
    link.begin_reading();
    open = std::stoi(link.run("SELECT count(*)::text FROM pg_stat_activity WHERE usename = $1 AND pid <>"
                              " pg_backend_pid()",
                              {login})
                         .front()
                         .front()
                         .value_or("0"));
    link.commit();
    if (open == 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return open;
}

void give_station(CentralLink& link, const std::string& station, const std::string& login) {
  const auto given =
      link.run("UPDATE station SET login = $2 WHERE uuid = $1 OR name = $1 RETURNING uuid", {station, login});
  if (given.size() == 1) return;
  throw InputError("\"" + station + "\": " +
                   (given.empty() ? std::string("no station of that name or UUID is at the centre")
                                  : std::to_string(given.size()) + " stations have that name; give the UUID of one"));
}

void look_at_logins(CentralLink& link, CentralState& state) {
  for (const Values& row : link.run("SELECT name, kind FROM login ORDER BY name")) {
    state.logins.push_back({*row[0], *row[1]});
    const std::string mighty = too_mighty(link, *row[0]);
    if (!mighty.empty()) state.problems.push_back("login " + *row[0] + " " + mighty);
  }
}

void look_at_stations(CentralLink& link, CentralState& state) {
  for (const Values& row :
       link.run("SELECT s.uuid, s.name, s.login, coalesce((SELECT max(position) FROM audit a WHERE a.station = s.uuid),"
                " 0)::text, coalesce((SELECT max(position) FROM head h WHERE h.station = s.uuid), 0)::text,"
                " to_char(s.last_seen AT TIME ZONE 'UTC', 'YYYY-MM-DD\"T\"HH24:MI:SS\"Z\"') FROM station s"
                " ORDER BY s.name, s.uuid")) {
    state.stations.push_back({*row[0], *row[1], *row[2], std::stoll(*row[3]), std::stoll(*row[4]), *row[5]});
  }
}

}  // namespace

CentralState set_up_central(const CentralAddress& central) {
  CentralLink link(central, CentralLink::Purpose::kSetUp);
  CentralState state;
  link.begin();
  if (link.run("SELECT 1 FROM pg_namespace WHERE nspname = 'trocar'").size() == 1) require_owner(link);
  state.from = link.make_schema();
  state.version = kCentralVersion;
  state.uuid = link.uuid();
  look_at_logins(link, state);
  for (const CentralLogin& login : state.logins) {
    if (state.from == kCentralVersion) break;
    for (const std::string& statement : grant_statements(login.name)) link.run(statement);
  }
  look_at_stations(link, state);
  link.commit();
  return state;
}

bool admit_login(const CentralAddress& central, const Admission& admission) {
  const std::string& name = admission.login;
  if (name.empty() || name.size() > 63) throw InputError("\"" + name + "\": a login has 1 to 63 bytes");
  CentralLink link(central);
  link.begin();
  require_owner(link);
  std::string password;
  if (link.run("SELECT 1 FROM pg_roles WHERE rolname = $1", {name}).empty()) {
    std::error_code none;
    if (admission.password_out.empty())
      throw InputError("login " + name + " is not there yet: say where its password goes, --password-out FILE");
    if (std::filesystem::exists(admission.password_out, none))
      throw InputError(admission.password_out.string() + ": is there already; it is not overwritten");
    password = make_role(link, central, name);
  } else if (const std::string mighty = too_mighty(link, name); !mighty.empty()) {
    throw InputError("login " + name + " " + mighty + ": a station's or a desk's may nothing but what it is granted");
  } else if (link.run("SELECT 1 FROM pg_roles WHERE rolname = $1 AND rolcanlogin", {name}).empty()) {
    run_for_role(link, "ALTER ROLE %I LOGIN", name);  // one that was dismissed
  }
  link.run("INSERT INTO login (name, kind) VALUES ($1, $2) ON CONFLICT (name) DO UPDATE SET kind = $2",
           {name, admission.kind});
  for (const std::string& statement : grant_statements(name)) link.run(statement);
  if (!admission.station.empty()) give_station(link, admission.station, name);
  // Before the commit: a role whose password nobody knows is worse than a file for a role that was not made.
  if (!password.empty()) write_owner_file(admission.password_out, password + "\n");
  link.commit();
  return !password.empty();
}

std::vector<std::string> dismiss_login(const CentralAddress& central, const std::string& login) {
  CentralLink link(central);
  link.begin_out_of_turn();  // that very login may hold the lock
  require_owner(link);
  if (link.run("DELETE FROM login WHERE name = $1 RETURNING 1", {login}).empty())
    throw InputError("login " + login + ": is not let in");
  for (const std::string& statement : revoke_statements(login)) link.run(statement);
  try_for_role(link, "ALTER ROLE %I NOLOGIN;", login);  // else it may connect still, and hold the lock
  std::vector<std::string> told;
  if (!link.run("SELECT 1 FROM pg_roles WHERE rolname = $1 AND rolcanlogin", {login}).empty())
    told.push_back("login " + login +
                   ": may still connect to the server, and so hold up whoever writes; this owner may not change that:"
                   " whoever administers the server does ALTER ROLE ... NOLOGIN");
  link.commit();
  if (const int open = end_sessions(link, login); open > 0)
    told.push_back("login " + login + ": " + std::to_string(open) +
                   " of its connections are open; whoever administers the server ends them");
  return told;
}

}  // namespace trocar
