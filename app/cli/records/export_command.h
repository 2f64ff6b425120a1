// `trocar export`: attempts for other programs. `trocar score FILE --jigsaws SIDE`: the motion metrics of somebody
// else's kinematics. InputError and EnvironmentError leave as they are.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "app/cli/command.h"
#include "trainees/exchange/export/export_choice.h"
#include "trainees/exchange/export/xapi_export.h"

namespace trocar {

struct ExportOptions {
  std::string format;         ///< csv, json, xapi or traces
  std::filesystem::path out;  ///< folder of csv and traces, else a file; must not exist
  ExportFilter filter = {};
  std::filesystem::path database;   ///< empty: the default path
  std::string home_page = {};       ///< xapi: of the actors; empty: XapiSetting's
  std::filesystem::path cmi5 = {};  ///< xapi: launch data; empty: no launch
};

/// Reads the pass mark of a ruleset; each is parsed once a level.
PassMark remembered_pass_mark();

void add_export_filter(CLI::App& command, ExportFilter& filter);

/// @return exit code 0.
int export_command(const ExportOptions& options, std::ostream& out, std::ostream& err);

struct KinematicsOptions {
  std::filesystem::path file;
  std::string side;  ///< right or left
  bool json = false;
};

/// @return exit code 0.
int kinematics_command(const KinematicsOptions& options, std::ostream& out);

}  // namespace trocar
