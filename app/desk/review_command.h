// `trocar review serve`, `trocar review demo` and `trocar review account add|list|password|disable|enable`. InputError
// and EnvironmentError leave as they are.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace trocar {

struct ReviewServeOptions {
  std::filesystem::path database = {};               ///< empty: the default path
  int port = 8642;                                   ///< 0: any that is free
  bool lan = false;                                  ///< the network, not this machine alone
  std::filesystem::path certificate = {}, key = {};  ///< both or none
  std::vector<std::string> names = {};               ///< more names that it goes by
  std::string from = {};  ///< address of a central database: its record instead of this station's
  std::filesystem::path password_file = {};
  bool weak_tls = false;    ///< of the central database's address
  bool recordings = false;  ///< fetches recordings too, with `from`
  bool demo = false;        ///< the invented cohort, made when it is not there yet
};

/// What to say of a disk on which a desk can be read but may keep nothing; "" where there is room.
std::string little_room(const std::filesystem::path& folder, std::uintmax_t free_bytes);

/// Serves the desk until Ctrl-C or SIGTERM. Its address is the result. @return exit code 0
int review_serve(const ReviewServeOptions& options, std::ostream& out, std::ostream& err);

struct ReviewDemoOptions {
  std::filesystem::path database = {};  ///< the demo's own; empty: beside the default one
  int jobs = 0;                         ///< attempts at a time, 0: one a core
  bool remove = false;
};

/// Makes the invented cohort, or removes it. Its file is the result. @return exit code 0
int review_demo(const ReviewDemoOptions& options, std::ostream& out, std::ostream& err);

struct ReviewAccountOptions {
  std::filesystem::path database = {};
  std::string login = {}, name = {};  ///< name: as printed, empty: the login
  std::string role = "trainee";
  std::string trainee = {};  ///< code, of a trainee's account; empty: the login
  bool json = false;         ///< of list
  bool own = false;          ///< of password: by its owner, who knows the present one
  std::string as = {};       ///< of password: the role, where the row is not the one that the trail holds
};

/// Passwords are asked for at the terminal, twice and unseen; from elsewhere lines of `in` are taken, the present one
/// first where it is asked for. @return
/// exit code 0
int review_account_add(const ReviewAccountOptions& options, std::istream& in, std::ostream& out, std::ostream& err);
int review_account_password(const ReviewAccountOptions& options, std::istream& in, std::ostream& out,
                            std::ostream& err);
int review_account_disable(const ReviewAccountOptions& options, bool disabled, std::ostream& out, std::ostream& err);
int review_account_list(const ReviewAccountOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
