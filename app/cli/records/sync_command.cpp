#include "app/cli/records/sync_command.h"

#include <cstdlib>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/cli/records/central_command.h"
#include "app/cli/records/open_database.h"
#include "haptics/input_error.h"
#include "trainees/exchange/sync/synchronise.h"

namespace trocar {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kNotAll = 1;

std::string counts(const std::map<std::string, int>& added) {
  std::string text;
  for (const auto& [table, count] : added) text += (text.empty() ? "" : ", ") + table + " " + std::to_string(count);
  return text.empty() ? "nothing new" : text;
}

void print_lines(const std::vector<std::string>& lines, std::ostream& out) {
  for (const std::string& line : lines) out << line << '\n';
}

Json pulled_json(const PullReport& pulled) {
  return {{"added", Json(pulled.added)},
          {"erased", pulled.erased},
          {"erasures", pulled.erasures},
          {"problems", pulled.problems},
          {"told", pulled.told}};
}

void print_pulled(const PullReport& pulled, std::ostream& out) {
  out << "fetched: " << counts(pulled.added) << '\n';
  if (pulled.erased > 0) out << "erased here: " << pulled.erased << '\n';
  print_lines(pulled.told, out);
  print_lines(pulled.erasures, out);
  print_lines(pulled.problems, out);
}

int exchange(Database& database, const SyncOptions& options, std::ostream& out, std::ostream& err) {
  PushOptions push{{options.to, options.password_file, options.weak_tls},
                   options.station,
                   options.new_station,
                   options.with_identity,
                   options.recordings};
  push.after_batch = [&err](std::int64_t position, std::int64_t head) {
    if (position < head) err << "pushed up to " << position << " of " << head << '\n';
  };
  const PushReport pushed = push_to_central(database, push);
  for (const std::string& remark : pushed.remarks) err << "remark: " << remark << '\n';
  const PullReport pulled = pull_from_central(database, push.central, options.apply_erasures);
  if (options.json) {
    const Json result{{"station", {{"uuid", pushed.station}, {"name", pushed.name}}},
                      {"pushed",
                       {{"from", pushed.from},
                        {"to", pushed.to},
                        {"added", Json(pushed.added)},
                        {"conflicts", pushed.conflicts},
                        {"problems", pushed.problems},
                        {"told", pushed.told}}},
                      {"fetched", pulled_json(pulled)}};
    out << result.dump(2) << '\n';
  } else {
    out << "station " << pushed.name << " (" << pushed.station << ")\n";
    out << "pushed: " << counts(pushed.added) << " (audit trail " << pushed.from << " to " << pushed.to << ")\n";
    print_lines(pushed.told, out);
    print_lines(pushed.conflicts, out);
    print_lines(pushed.problems, out);
    print_pulled(pulled, out);
  }
  return pushed.conflicts.empty() && pushed.problems.empty() && pulled.problems.empty() ? 0 : kNotAll;
}

int replicate(Database& database, const SyncOptions& options, std::ostream& out) {
  const PullReport pulled =
      replicate_central(database, {{options.from, options.password_file, options.weak_tls}, options.recordings});
  if (options.json)
    out << pulled_json(pulled).dump(2) << '\n';
  else
    print_pulled(pulled, out);
  return pulled.problems.empty() ? 0 : kNotAll;
}

int link(const SyncLinkOptions& options, bool linked, std::ostream& out, std::ostream& err) {
  const char* user = std::getenv("USER");
  const std::string author =
      options.author.empty() ? (user != nullptr && *user != '\0' ? user : "unknown") : options.author;
  const LinkedPeople people =
      link_people({options.at, options.password_file, options.weak_tls}, options.one, options.other, linked, author);
  out << people.one << ' ' << people.other << '\n';
  err << (linked ? "They are one person now" : "They are two people again")
      << ", for every desk and station from its next sync on.\n";
  return 0;
}

}  // namespace

int sync_link(const SyncLinkOptions& options, std::ostream& out, std::ostream& err) {
  return link(options, true, out, err);
}
int sync_unlink(const SyncLinkOptions& options, std::ostream& out, std::ostream& err) {
  return link(options, false, out, err);
}

int sync_command(const SyncOptions& options, std::ostream& out, std::ostream& err) {
  if (options.to.empty() == options.from.empty())
    throw InputError("sync: give --to URL (a station) or --from URL (a copy for a desk)");
  if (!options.from.empty() && options.database.empty()) {
    throw InputError("sync: --from fetches every station's record: give it a file of its own, --db FILE");
  }
  if (!options.from.empty()) {
    Database database = open_database(options.database, OpenMode::kCreate, err);
    return replicate(database, options, out);
  }
  Database database = open_database(options.database, OpenMode::kExisting, err);
  return exchange(database, options, out, err);
}

namespace {

void add_links(CLI::App& sync, CommandAction& chosen) {
  const auto given = std::make_shared<SyncLinkOptions>();
  SyncLinkOptions& o = *given;
  CLI::App* link = add_command(sync, "link", "Two trainees are one person, who practises at two stations", chosen,
                               [given] { return sync_link(*given, std::cout, std::cerr); });
  CLI::App* unlink = add_command(sync, "unlink", "Two who were linked are two people after all", chosen,
                                 [given] { return sync_unlink(*given, std::cout, std::cerr); });
  for (CLI::App* command : {link, unlink}) {
    command->add_option("one", o.one, "CODE@STATION, or the trainee's UUID")->required();
    command->add_option("other", o.other, "Likewise")->required();
    command->add_option("--at", o.at, "postgresql://USER@HOST/DATABASE")->required();
    add_central_access(*command, o.password_file, o.weak_tls);
    command->add_option("--author", o.author, "Who says so (default: $USER)");
  }
}

}  // namespace

void add_sync(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<SyncOptions>();
  SyncOptions& o = *given;
  CLI::App* sync = parent.add_subcommand(
      "sync", "This station's record to a central PostgreSQL database, or all stations' into a file for a desk");
  CLI::Option* to =
      sync->add_option("--to", o.to,
                       "postgresql://USER@HOST/DATABASE: push what is finished, fetch rules, and what was said of"
                       " the people here");
  CLI::Option* from = sync->add_option(
      "--from", o.from, "postgresql://USER@HOST/DATABASE: fetch what all stations pushed into --db FILE");
  to->excludes(from);
  add_central_access(*sync, o.password_file, o.weak_tls);
  sync->add_option("--station", o.station, "Name of this station (default: the host's)")->needs(to);
  sync->add_flag("--new-station", o.new_station,
                 "Go on under a new UUID: an older copy was put back, or the database was copied")
      ->needs(to);
  sync->add_flag("--with-identity", o.with_identity, "Also codes, names and e-mail addresses")->needs(to);
  sync->add_flag("--apply-erasures", o.apply_erasures, "Erase here too whom another station erased")->needs(to);
  sync->add_option("--db", o.database, "Database file");
  sync->add_flag("--json", o.json, "As JSON");
  sync->add_flag("--recordings", o.recordings, "Also the recordings of attempts; motion tells who moved");
  add_links(*sync, chosen);
  add_central(*sync, chosen);
  sync->callback([given, sync, &chosen] {
    if (sync->get_subcommands().empty()) chosen = [given] { return sync_command(*given, std::cout, std::cerr); };
  });
}

}  // namespace trocar
