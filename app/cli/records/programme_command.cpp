#include "app/cli/records/programme_command.h"

#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/cli/records/open_database.h"
#include "app/cli/text_table.h"
#include "app/desk/desk_facts.h"
#include "app/session/setup/scene.h"
#include "haptics/input_error.h"
#include "scenarios/files/strict_toml.h"
#include "trainees/desk/queries/programme_views.h"
#include "trainees/records/attempt_identity.h"

namespace trocar {
namespace {

std::string step_name(const ProgrammeStep& step) { return step.exercise_id + " " + step.level; }

std::string said_groups(const std::vector<std::string>& groups) {
  std::string out;
  for (const std::string& group : groups) out += (out.empty() ? "" : ", ") + group;
  return out;
}

}  // namespace

int programme_list(const ProgrammeOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const ProgrammeStore store(database);
  TextTable programmes({{"programme"},
                        {"steps", TextTable::Align::kRight},
                        {"version", TextTable::Align::kRight},
                        {"saved (UTC)"},
                        {"remark"}});
  for (const KeptProgramme& one : store.list())
    programmes.add({one.text.name, std::to_string(one.programme.steps.size()), std::to_string(one.text.version),
                    cell_time(one.text.utc), one.problem});
  programmes.print(out);
  TextTable held({{"programme"}, {"to"}, {"by"}, {"given (UTC)"}, {"by whom"}, {"assignment"}});
  bool any = false;
  for (const Assignment& one : store.assignments()) {
    if (!one.withdrawn_utc.empty()) continue;
    held.add({one.programme, one.group.empty() ? one.trainee : "group " + one.group, one.due.empty() ? "-" : one.due,
              cell_time(one.utc), one.printed, one.uuid});
    any = true;
  }
  if (any) held.print(out << '\n');
  return 0;
}

int programme_show(const ProgrammeOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const auto kept = CurriculumStore(database).newest(options.name);
  if (!kept || !is_programme(kept->toml)) throw InputError("programme \"" + options.name + "\": there is none");
  out << kept->toml;
  return 0;
}

int programme_save(const ProgrammeOptions& options, std::ostream& out, std::ostream& err) {
  const std::string toml = read_text_file(options.text.string());
  const Programme programme = read_programme(toml, options.text.string());  // so that a fault is said of the file
  Database database = open_database(options.database, OpenMode::kCreate, err);
  require_known(programme, options.name, review::known_levels(database, desk_exercises(find_assets().exercises)));
  const Curriculum saved = ProgrammeStore(database).save(options.name, toml, author_said(options.author));
  out << saved.name << " version " << saved.version << '\n';
  return 0;
}

int programme_assign(const ProgrammeOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  out << ProgrammeStore(database)
             .assign(options.name, options.trainee, options.group, options.due, author_said(options.author))
             .uuid
      << '\n';
  return 0;
}

int programme_withdraw(const ProgrammeOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  ProgrammeStore(database).withdraw(options.assignment, options.reason, author_said(options.author));
  out << options.assignment << " withdrawn\n";
  return 0;
}

int programme_grid_command(const ProgrammeOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  review::GridView view;
  view.grid = programme_grid(database, options.name, {options.group, "", options.deactivated}, utc_now());
  if (options.csv) {
    out << review::grid_csv(view);
    return 0;
  }
  std::vector<TextTable::Column> columns{{"trainee"}, {"groups"}};
  for (const ProgrammeStep& step : view.grid.programme.steps) columns.push_back({step_name(step)});
  TextTable table(columns);
  for (const ProgrammeLine& line : view.grid.lines) {
    std::vector<std::string> cells{line.code + (line.active ? "" : " (deactivated)"), said_groups(line.groups)};
    for (const ProgrammeCell& one : line.cells) cells.emplace_back(step_state_words(one.state));
    table.add(std::move(cells));
  }
  table.print(out);
  return 0;
}

int programme_reminders(const ProgrammeOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const auto lines = reminders(database, options.name, options.group, options.days, utc_now());
  if (options.csv) {
    out << review::reminders_csv(lines);
    return 0;
  }
  TextTable table({{"trainee"},
                   {"groups"},
                   {"programme"},
                   {"step"},
                   {"by"},
                   {"days", TextTable::Align::kRight},
                   {"state"},
                   {"missing"}});
  for (const Reminder& one : lines)
    table.add({one.code, said_groups(one.groups), one.programme, step_name(one.step), one.due, std::to_string(one.days),
               step_state_words(one.state), one.missing});
  table.print(out);
  return 0;
}

void add_programme(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<ProgrammeOptions>();
  ProgrammeOptions& o = *given;
  const auto command = [&](const char* name, const char* help,
                           int (*run)(const ProgrammeOptions&, std::ostream&, std::ostream&)) {
    CLI::App* added =
        add_command(parent, name, help, chosen, [given, run] { return run(*given, std::cout, std::cerr); });
    added->add_option("--db", o.database, "Database file");
    return added;
  };
  command("list", "Programmes and the assignments that hold", programme_list);
  CLI::App* show = command("show", "The text of a programme (TOML)", programme_show);
  CLI::App* save = command("save", "The next version of a programme, from a text", programme_save);
  CLI::App* assign = command("assign", "Give a programme to a group or to one person", programme_assign);
  CLI::App* withdraw = command("withdraw", "An assignment no longer holds; it stays in the record", programme_withdraw);
  CLI::App* grid = command("grid", "People and steps: who stands where", programme_grid_command);
  CLI::App* late = command("reminders", "Who is overdue, or due within some days", programme_reminders);
  for (CLI::App* one : {show, save, assign, grid}) one->add_option("name", o.name, "Name of the programme")->required();
  save->add_option("file", o.text, "[[step]] after [[step]]")->required()->check(file_name());
  assign->add_option("--group", o.group, "To whoever is in the group, also who joins later");
  assign->add_option("--trainee", o.trainee, "To one person (code)");
  assign->add_option("--due", o.due, "Last day, such as 2026-06-30");
  withdraw->add_option("assignment", o.assignment, "Number of the assignment, as list has it")->required();
  withdraw->add_option("--reason", o.reason, "Kept with it, up to 200 bytes");
  for (CLI::App* one : {save, assign, withdraw}) one->add_option("--author", o.author, "Who says so (default: $USER)");
  late->add_option("--programme", o.name, "One programme only");
  late->add_option("--days", o.days, "So many days ahead")->capture_default_str()->check(CLI::Range(0, 3660));
  for (CLI::App* one : {grid, late}) {
    one->add_option("--group", o.group, "One group only");
    one->add_flag("--csv", o.csv, "As CSV");
  }
  grid->add_flag("--deactivated", o.deactivated, "People who are deactivated, too");
}

}  // namespace trocar
