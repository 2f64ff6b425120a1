// `trocar trainee add|list|show`. Results on `out`, messages on `err`; InputError and EnvironmentError leave as they
// are.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace trocar {

struct TraineeOptions {
  std::filesystem::path database;  ///< empty: the default path
  std::string code;                ///< of add and show
  int limit = 20;                  ///< attempts that show lists, newest first; 0: all
  bool json = false;
};

/// @return exit code 0; adding a code that exists is no error and says so on `err`.
int trainee_add(const TraineeOptions& options, std::ostream& out, std::ostream& err);
int trainee_list(const TraineeOptions& options, std::ostream& out, std::ostream& err);
/// @throws InputError when there is no such trainee.
int trainee_show(const TraineeOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
