// Who is signed in: 256-bit random numbers in cookies, of which only a keyed hash is kept, in memory alone.
//
// A session ends by sign-out, after so long without a request, at the latest after so long, and when its account's
// sign-in changes (stamp). Everybody, signed in or not, has a number in a cookie; the token that forms carry is a keyed
// hash of it, so that none need be kept and that of another visitor never fits. The keys live as long as the program.
// Thread: any.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace trocar::review {

using DeskTime = std::chrono::steady_clock::time_point;

struct SessionLimits {
  std::chrono::seconds idle{1800}, most{43200};
  std::size_t of_account = 16, of_all = 2000;  ///< beyond these the one that was used longest ago ends
};

struct Session {
  std::string account;   ///< UUID; "" for the station's own instructor
  std::string stamp;     ///< of the account's sign-in when it began (desk_accounts.h)
  bool recorded = true;  ///< its beginning stands in the audit trail; else the disk was full, and it may only read
};

class DeskSessions {
 public:
  /// @throws EnvironmentError when the machine gives no random numbers.
  explicit DeskSessions(const SessionLimits& limits = {});

  /// A fresh number for a cookie: 43 letters, digits, - and _.
  static std::string fresh_number();
  /// Has the form of one.
  static bool is_number(const std::string& text);

  /// @returns its number, never one that was known before.
  std::string begin(const Session& session, DeskTime now);
  /// The session, which counts as used now.
  std::optional<Session> find(const std::string& number, DeskTime now);
  /// Its account without using it, "" where there is none.
  std::string account(const std::string& number) const;
  void end(const std::string& number);
  void mark_recorded(const std::string& number);
  std::size_t count() const;

  /// What forms carry for that number.
  std::string token(const std::string& number) const;
  /// Compared in constant time.
  bool token_fits(const std::string& number, const std::string& token) const;

 private:
  struct Kept {
    Session session;
    DeskTime begun, used;
  };
  using Key = std::array<unsigned char, 32>;
  std::string digest(const Key& key, const std::string& number) const;
  void make_room(const std::string& account, DeskTime now);
  bool over(const Kept& kept, DeskTime now) const;

  SessionLimits limits_;
  Key session_key_{}, token_key_{};
  mutable std::mutex mutex_;
  std::map<std::string, Kept> sessions_;  ///< by digest of the number
};

}  // namespace trocar::review
