// How often somebody may try to sign in: five wrong ones, then a wait of 30 s that doubles with each further one, up to
// 15 minutes.
//
// Counted are those of a login from one address in a day, until the right one comes, so that whoever guesses elsewhere
// keeps nobody out; those from an address in 15 minutes, which a whole class may share; and, for who guesses from many
// addresses, those of a login in a day from wherever it never was right, of which a hundred are free. A try counts as
// wrong from its beginning until it is known to be right, so that many at once gain nothing. Where somebody who is
// signed in gives the password again, the session stands for the address.
//
// What is counted has an upper bound: where too much is, the counts of logins that exist stay longest, then the high
// ones, then the newest, so that tries with invented logins let nobody go on guessing. Thread: any.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "trainees/desk/server/desk_sessions.h"

namespace trocar::review {

class SignInLimit {
 public:
  static constexpr int kFree = 5, kFreeOfLogin = 100;
  static constexpr std::chrono::seconds kOfLogin{86400}, kOfAddress{900}, kFirstWait{30}, kLongestWait{900};
  static constexpr std::size_t kMostKnown = 20000, kMostTold = 60, kMostOwn = 16;

  /// Seconds to wait before a try is taken, 0: it is taken, and counts as wrong. A try that is not taken counts
  /// nothing. @param exists the login is an account's.
  int begin(const std::string& login, const std::string& address, DeskTime now, bool exists = false);
  /// The try that began was wrong, and from now on the login or the address has to wait: told once, and no more than
  /// kMostTold times an hour, for the audit trail keeps it for ever.
  bool tell_held_back(const std::string& login, const std::string& address, DeskTime now);
  /// The try that began was right: it does not count, and the login's wrong ones from there are forgotten.
  void was_right(const std::string& login, const std::string& address);

 private:
  using Tries = std::vector<DeskTime>;  ///< newest last
  struct Counted {
    std::string key;
    std::chrono::seconds memory;
    int free;
    bool of_login = false;  ///< from wherever
  };
  struct Wrong {
    Tries tries = {};
    std::chrono::seconds memory{0};
    bool stays = false;         ///< of a login that exists
    void forget(DeskTime now);  ///< those that are older
  };
  std::vector<Counted> counted(const std::string& login, const std::string& address) const;
  int wait(const Counted& counted, DeskTime now);
  void make_room(DeskTime now);

  std::mutex mutex_;
  std::map<std::string, Wrong> wrong_;
  std::map<std::string, std::vector<std::string>> own_;  ///< where a login was right, newest last
  Tries told_;
};

}  // namespace trocar::review
