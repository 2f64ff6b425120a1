// `trocar review serve` and `trocar review account add|list|password|disable|enable`. InputError and EnvironmentError leave as they are.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace trocar {

struct ReviewServeOptions {
  std::filesystem::path database = {};     ///< empty: the default path
  int port = 8642;                         ///< 0: any that is free
  bool lan = false;                        ///< the network, not this machine alone
  std::filesystem::path certificate = {}, key = {};  ///< both or none
  std::vector<std::string> names = {};     ///< more names that it goes by
};

/// Serves the desk until Ctrl-C or SIGTERM. Its address is the result. @return exit code 0
int review_serve(const ReviewServeOptions& options, std::ostream& out, std::ostream& err);

struct ReviewAccountOptions {
  std::filesystem::path database = {};
  std::string login = {}, name = {};       ///< name: as printed, empty: the login
  std::string role = "trainee";
  std::string trainee = {};                ///< code, of a trainee's account; empty: the login
  bool json = false;                       ///< of list
};

/// Passwords are asked for at the terminal, twice and unseen; from elsewhere the first line of `in` is taken. @return exit code 0
int review_account_add(const ReviewAccountOptions& options, std::istream& in, std::ostream& out, std::ostream& err);
int review_account_password(const ReviewAccountOptions& options, std::istream& in, std::ostream& out, std::ostream& err);
int review_account_disable(const ReviewAccountOptions& options, bool disabled, std::ostream& out, std::ostream& err);
int review_account_list(const ReviewAccountOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
