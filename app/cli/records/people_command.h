// `trocar trainee import|group|deactivate|reactivate`: many people at once. Results on `out`, messages on `err`;
// InputError and EnvironmentError leave as they are.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace trocar {

struct PeopleOptions {
  std::filesystem::path database;  ///< empty: the default path
  std::filesystem::path list;      ///< of import
  bool preview = false;            ///< of import: nothing is written
  std::string group;               ///< of import: of those who name none; of group: which
  bool leave = false;              ///< of group
  std::vector<std::string> codes;
  std::string reason;  ///< of deactivate and reactivate
  std::string author;  ///< as printed; empty: who runs the program
};

/// @return exit code 0; 2 when lines were refused, which are named; the others are taken all the same.
int trainee_import(const PeopleOptions& options, std::ostream& out, std::ostream& err);
/// @return exit code 0. @throws InputError: nobody of a code; then nobody was changed.
int trainee_group(const PeopleOptions& options, std::ostream& out, std::ostream& err);
int trainee_set_active(const PeopleOptions& options, bool active, std::ostream& out, std::ostream& err);

}  // namespace trocar
