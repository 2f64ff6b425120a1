// Setting up a central database, and who is let in: its owner's part. Thread: any; each call has a connection of its
// own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trainees/exchange/sync/synchronise.h"

namespace trocar {

struct CentralStation {
  std::string uuid, name, login;       ///< login "": nobody's yet
  std::int64_t entries = 0, head = 0;  ///< positions: of the trail that is there, of the newest signed head; 0: none
  std::string last_seen;               ///< the centre's clock
};

struct CentralLogin {
  std::string name, kind;  ///< "station", "desk"
};

struct CentralState {
  std::string uuid;
  int from = 0, version = 0;  ///< of the schema: before and now; 0: there was none
  std::vector<CentralLogin> logins = {};
  std::vector<CentralStation> stations = {};
  std::vector<std::string> problems = {};  ///< logins that may more than they should
};

/// Makes the schema, or brings it to this program's, as its owner. The same again changes nothing.
/// @throws InputError: the login is not the owner. EnvironmentError: not reached, no right to make it, a newer schema.
CentralState set_up_central(const CentralAddress& central);

struct Admission {
  std::string login, kind;                  ///< "station" or "desk"
  std::string station = {};                 ///< UUID or name of one that is there and from now on is that login's
  std::filesystem::path password_out = {};  ///< where a new role's password goes; must not exist
};

/// Lets a login in, as the owner. A role that is not there is made, with a password of 32 random characters that only
/// the file gets to know; one that is there keeps its password and is only granted what it needs, and may connect
/// again if it was dismissed.
/// @returns whether a role was made. @throws InputError: no such station, a role that may more than a station should.
bool admit_login(const CentralAddress& central, const Admission& admission);

/// Takes from a login what it was granted, and that it may connect to the server at all, and ends its connections; what
/// it wrote stays. admit_login() takes that back. @returns what this owner may not do of it, a line each.
/// @throws InputError: it is not let in.
std::vector<std::string> dismiss_login(const CentralAddress& central, const std::string& login);

}  // namespace trocar
