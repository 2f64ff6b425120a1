// `trocar trainee add|list|show|edit`. Results on `out`, messages on `err`; InputError and EnvironmentError leave as
// they are.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

namespace trocar {

struct TraineeOptions {
  std::filesystem::path database;  ///< empty: the default path
  std::string code;                ///< of add, show and edit
  int limit = 20;                  ///< attempts that show lists, newest first; 0: all
  bool json = false;
  std::optional<std::string> name{}, email{};  ///< of edit; "" takes it away
};

/// @return exit code 0; adding a code that exists is no error and says so on `err`.
int trainee_add(const TraineeOptions& options, std::ostream& out, std::ostream& err);
int trainee_list(const TraineeOptions& options, std::ostream& out, std::ostream& err);
/// Name and e-mail address. @throws InputError: nobody, neither is given, not an address.
int trainee_edit(const TraineeOptions& options, std::ostream& out, std::ostream& err);
/// @throws InputError when there is no such trainee.
int trainee_show(const TraineeOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
