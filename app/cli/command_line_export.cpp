#include "app/cli/command_line_export.h"

#include <iostream>

#include <CLI/CLI.hpp>

#include "app/cli/records/export_command.h"

namespace trocar {

struct ExportCommandLine {
  ExportOptions options;
};

std::shared_ptr<ExportCommandLine> add_export_command(CLI::App& app,
                                                      const std::function<void(std::function<int()>)>& choose) {
  auto c = std::make_shared<ExportCommandLine>();
  ExportOptions& o = c->options;
  CLI::App* command =
      app.add_subcommand("export", "Attempts for other programs: tables, one document, xAPI statements, kinematics");
  command->add_option("format", o.format, "csv, json, xapi or jigsaws")
      ->required()
      ->check(CLI::IsMember({"csv", "json", "xapi", "jigsaws"}));
  command->add_option("--out", o.out, "Folder (csv, jigsaws) or file (json, xapi) that does not exist yet")->required();
  command->add_option("--trainee", o.filter.trainee, "One trainee only");
  command->add_option("--group", o.filter.group, "One group only");
  command->add_option("--exercise", o.filter.exercise, "One exercise only, by its id");
  command->add_option("--attempt", o.filter.attempt, "One attempt only: its number, a part of its UUID, or 'latest'");
  command->add_option("--home-page", o.home_page,
                      "xapi: URL of who runs the simulator, of which the trainees' UUIDs are accounts");
  command->add_option("--cmi5", o.cmi5, "xapi: JSON with the data of a cmi5 launch, which the newest attempt answers");
  command->add_option("--db", o.database, "Database file");
  command->callback(
      [c = c.get(), choose] { choose([c] { return export_command(c->options, std::cout, std::cerr); }); });
  return c;
}

}  // namespace trocar
