#include "app/cli/records/people_command.h"

#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/cli/records/open_database.h"
#include "app/cli/text_table.h"
#include "scenarios/files/strict_toml.h"
#include "trainees/records/curricula.h"
#include "trainees/records/people_import.h"
#include "trainees/records/standings.h"

namespace trocar {
namespace {

constexpr int kRefusedLines = 2;

}  // namespace

int trainee_import(const PeopleOptions& options, std::ostream& out, std::ostream& err) {
  const std::string csv = read_text_file(options.list.string()), name = options.list.string();
  Database database = open_database(options.database, OpenMode::kCreate, err);
  const ImportPreview seen = options.preview
                                 ? preview_people(database, csv, name, options.group)
                                 : take_people(database, csv, name, options.group, author_said(options.author));
  for (const std::string& remark : seen.remarks) err << name << ": " << remark << '\n';
  TextTable table({{"line", TextTable::Align::kRight}, {"what"}, {"code"}, {"name"}, {"group"}, {"why"}});
  for (const ImportRow& row : seen.rows)
    table.add({std::to_string(row.line), fate_words(row.fate), row.code, row.name, row.group, row.reason});
  table.print(out);
  const int refused = seen.count(RowFate::kRefused);
  err << seen.count(RowFate::kNew) << " added, " << seen.count(RowFate::kJoins) << " joining a group, "
      << seen.count(RowFate::kThere) << " skipped, " << refused << " refused"
      << (options.preview ? "; nothing is written yet" : "") << '\n';
  return refused > 0 ? kRefusedLines : 0;
}

int trainee_group(const PeopleOptions& options, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  CurriculumStore store(database);
  if (options.leave)
    store.leave(options.codes, options.group, author_said(options.author));
  else
    store.join(options.codes, options.group, author_said(options.author));
  for (const std::string& member : store.members(options.group)) out << member << '\n';
  return 0;
}

int trainee_set_active(const PeopleOptions& options, bool active, std::ostream& out, std::ostream& err) {
  Database database = open_database(options.database, OpenMode::kExisting, err);
  const int changed = StandingStore(database).set_active({options.codes.begin(), options.codes.end()}, active,
                                                         options.reason, author_said(options.author));
  out << changed << (active ? " reactivated\n" : " deactivated\n");
  return 0;
}

void add_trainee_many(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<PeopleOptions>();
  PeopleOptions& o = *given;
  CLI::App* import = add_command(parent, "import", "Add people from a list that a spreadsheet saved as CSV", chosen,
                                 [given] { return trainee_import(*given, std::cout, std::cerr); });
  import->add_option("file", o.list, "First line: code, and any of name, first name, last name, e-mail, group")
      ->required()
      ->check(file_name());
  import->add_flag("--preview", o.preview, "What would be done; nothing is written");
  import->add_option("--group", o.group, "Group of those who name none");
  CLI::App* group = add_command(parent, "group", "Put people into a group, or take them out", chosen,
                                [given] { return trainee_group(*given, std::cout, std::cerr); });
  group->add_option("group", o.group, "Name of the group")->required();
  group->add_flag("--leave", o.leave, "Out of it");
  CLI::App* off = add_command(parent, "deactivate", "People who no longer take part: the record stays", chosen,
                              [given] { return trainee_set_active(*given, false, std::cout, std::cerr); });
  CLI::App* on = add_command(parent, "reactivate", "People who take part again", chosen,
                             [given] { return trainee_set_active(*given, true, std::cout, std::cerr); });
  for (CLI::App* command : {off, on}) command->add_option("--reason", o.reason, "Kept with it, up to 200 bytes");
  for (CLI::App* command : {group, off, on}) command->add_option("code", o.codes, "Trainee codes")->required();
  for (CLI::App* command : {import, group, off, on}) {
    command->add_option("--author", o.author, "Who says so (default: $USER)");
    command->add_option("--db", o.database, "Database file");
  }
}

}  // namespace trocar
