// `trocar sync central|admit|dismiss`: the owner's part of a central database. InputError and EnvironmentError leave as
// they are.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "app/cli/command.h"

namespace trocar {

struct CentralOptions {
  std::string at{};  ///< address, as its owner
  std::filesystem::path password_file{};
  bool weak_tls = false;
  bool json = false;                     ///< of central
  std::string login{}, station{};        ///< of admit and dismiss; of admit: whose rows are that login's
  bool desk = false;                     ///< of admit: a desk for all stations, not a station
  std::filesystem::path password_out{};  ///< of admit: the password of a new role
};

/// Makes the schema or brings it to this program's; who is let in, which stations there are. @return exit code: 0; 2
/// when a login may more than it should.
int central_set_up(const CentralOptions& options, std::ostream& out);
/// @return exit code 0
int central_admit(const CentralOptions& options, std::ostream& out);
int central_dismiss(const CentralOptions& options, std::ostream& out);

/// The options of whoever asks a central database.
void add_central_access(CLI::App& command, std::filesystem::path& password_file, bool& weak_tls);

void add_central(CLI::App& sync, CommandAction& chosen);

}  // namespace trocar
