// `trocar lrs`: statements to a learning record store. InputError and EnvironmentError leave as they are.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "app/cli/command.h"
#include "trainees/exchange/lrs/lrs_delivery.h"

namespace trocar {

struct LrsOptions {
  LrsAddress lrs{};
  ExportFilter filter{};
  std::string home_page{};  ///< of the actors: who runs the simulator
  int at_once = 50;
  int patience_s = 300;
  bool json = false;
  std::filesystem::path database{};  ///< empty: the default path
};

/// @return exit code: 0 everything is there; 1 the store refused some: they are named, the rest was delivered.
int lrs_command(const LrsOptions& options, std::ostream& out, std::ostream& err);

void add_lrs(CLI::App& parent, CommandAction& chosen);

}  // namespace trocar
