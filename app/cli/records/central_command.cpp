#include "app/cli/records/central_command.h"

#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/text_table.h"
#include "trainees/exchange/sync/central_logins.h"

namespace trocar {
namespace {

using CentralJson = nlohmann::ordered_json;

constexpr int kTooMighty = 2;

CentralAddress address_of(const CentralOptions& options) {
  return {options.at, options.password_file, options.weak_tls};
}

CentralJson state_json(const CentralState& state) {
  CentralJson logins = CentralJson::array(), stations = CentralJson::array();
  for (const CentralLogin& login : state.logins) logins.push_back({{"name", login.name}, {"kind", login.kind}});
  for (const CentralStation& one : state.stations)
    stations.push_back({{"uuid", one.uuid},
                        {"name", one.name},
                        {"login", one.login},
                        {"entries", one.entries},
                        {"head", one.head},
                        {"last_seen", one.last_seen}});
  return {{"uuid", state.uuid}, {"schema", state.version}, {"schema_before", state.from},
          {"logins", logins},   {"stations", stations},    {"problems", state.problems}};
}

void print_state(const CentralState& state, std::ostream& out) {
  out << "schema " << state.version
      << (state.from == state.version ? std::string(", up to date")
          : state.from == 0           ? std::string(", made now")
                                      : ", brought from schema " + std::to_string(state.from))
      << '\n';
  for (const CentralLogin& login : state.logins) out << login.kind << " login " << login.name << '\n';
  TextTable table({{"station"},
                   {"login"},
                   {"entries", TextTable::Align::kRight},
                   {"signed head", TextTable::Align::kRight},
                   {"last seen"},
                   {"uuid"}});
  for (const CentralStation& one : state.stations)
    table.add({one.name, one.login.empty() ? "nobody's yet" : one.login, std::to_string(one.entries),
               one.head == 0 ? "-" : std::to_string(one.head), one.last_seen, one.uuid});
  if (!state.stations.empty()) table.print(out);
  for (const std::string& problem : state.problems) out << problem << '\n';
}

}  // namespace

int central_set_up(const CentralOptions& options, std::ostream& out) {
  const CentralState state = set_up_central(address_of(options));
  if (options.json)
    out << state_json(state).dump(2) << '\n';
  else
    print_state(state, out);
  return state.problems.empty() ? 0 : kTooMighty;
}

int central_admit(const CentralOptions& options, std::ostream& out) {
  const bool made = admit_login(
      address_of(options), {options.login, options.desk ? "desk" : "station", options.station, options.password_out});
  out << (options.desk ? "desk" : "station") << " login " << options.login << " is let in";
  if (made) out << "; its password is in " << options.password_out.string();
  out << '\n';
  return 0;
}

int central_dismiss(const CentralOptions& options, std::ostream& out) {
  const std::vector<std::string> left = dismiss_login(address_of(options), options.login);
  out << "login " << options.login << " is out; what it wrote stays\n";
  for (const std::string& line : left) out << line << '\n';
  return left.empty() ? 0 : 1;
}

void add_central_access(CLI::App& command, std::filesystem::path& password_file, bool& weak_tls) {
  command.add_option("--password-file", password_file, "First line: the password (else PGPASSWORD, ~/.pgpass)");
  command.add_flag("--allow-weak-tls", weak_tls,
                   "Let the address have an sslmode that does not check who answers (beyond this machine it is"
                   " verify-full)");
}

void add_central(CLI::App& sync, CommandAction& chosen) {
  const auto given = std::make_shared<CentralOptions>();
  CentralOptions& o = *given;
  CLI::App* central = add_command(sync, "central", "As its owner: set a central database up, or see who is let in",
                                  chosen, [given] { return central_set_up(*given, std::cout); });
  central->add_flag("--json", o.json, "As JSON");
  CLI::App* admit = add_command(sync, "admit", "As its owner: let a station or a desk in under a login of its own",
                                chosen, [given] { return central_admit(*given, std::cout); });
  admit->add_flag("--desk", o.desk, "A desk for all stations: it also says things about people of others");
  admit->add_option("--station", o.station, "Name or UUID of a station that is there and is that login's from now on");
  admit->add_option("--password-out", o.password_out, "Where a new login's password goes")->check(writable_path());
  CLI::App* dismiss = add_command(sync, "dismiss", "As its owner: a login is out, what it wrote stays", chosen,
                                  [given] { return central_dismiss(*given, std::cout); });
  for (CLI::App* command : {admit, dismiss}) command->add_option("login", o.login, "Name of the login")->required();
  for (CLI::App* command : {central, admit, dismiss}) {
    command->add_option("--at", o.at, "postgresql://OWNER@HOST/DATABASE")->required();
    add_central_access(*command, o.password_file, o.weak_tls);
  }
}

}  // namespace trocar
