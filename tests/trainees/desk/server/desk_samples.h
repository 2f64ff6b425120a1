// A desk to test: two trainees with attempts and accounts, an instructor, an administrator; pages of every audience;
// requests without a network (Gate) and with one (raw_answer).
#pragma once

#include <string>
#include <vector>

#include "tests/trainees/records/store_samples.h"
#include "trainees/desk/server/desk_gate.h"
#include "trainees/records/accounts.h"

namespace trocar::review {

inline constexpr int kDeskPort = 8642;
inline constexpr const char* kSecretNote = "zebra-7431 lets go too early";  ///< of trainee T-otto, known to nobody else
inline constexpr const char* kPassword = "correct horse battery";

/// Pages of every audience and method, with a code, with an attempt, with neither, and ones that fail. They echo
/// nothing but the account's login.
std::vector<Route> sample_routes();

/// Who looks: "" nobody, else a login.
struct Visitor {
  std::string cookie, token;
};

class DeskTest : public TemporaryFolder {
 protected:
  /// Trainees T-anna and T-otto, two attempts each, a note on T-otto. No accounts yet.
  DeskTest();
  /// anna and otto (trainees), ines (instructor), adam (administrator).
  void add_accounts();
  void make_gate(GateOptions options = {}, std::vector<Route> routes = sample_routes());

  /// One request. `headers` are whole lines without their end.
  Answer ask(const std::string& method, const std::string& target, const Visitor& visitor = {},
             const std::string& body = "", const std::vector<std::string>& headers = {});
  /// What the form of the sign-in page gave, before signing in.
  Visitor stranger();
  Visitor signed_in(const std::string& login, const std::string& password = kPassword);
  Answer try_sign_in(const std::string& login, const std::string& password, const Visitor& visitor,
                     const std::string& next = "");

  std::filesystem::path file_;
  Database database_;
  Desk desk_{database_};
  std::unique_ptr<DeskGate> gate_;
  std::string annas_, ottos_;  ///< UUID of an attempt of each
  std::string address_ = "10.0.0.7";
  std::string local_address_ = "127.0.0.1";
  bool same_user_ = true;
  DeskTime now_ = DeskTime(std::chrono::hours(1000));
  std::vector<std::string> log_;
};

std::string cookie_of(const Answer& answer);
/// Value of the form's hidden field `name` in a page.
std::string field_of(const std::string& page, const std::string& name);
/// Value of a header that the gate sends with the answer, "" without it.
std::string header_of(const DeskGate& gate, const Answer& answer, const std::string& name);

/// Sends bytes to the loopback port and returns all that comes back until the other side ends, or `patience_ms` is
/// over.
/// @param ends says that nothing more comes, so that nobody waits for the rest of half a request.
std::string raw_answer(int port, const std::string& bytes, int patience_ms = 10000, bool ends = false);
int status_of(const std::string& raw);
/// "GET /x HTTP/1.1" with host and end, for raw_answer.
std::string raw_get(int port, const std::string& target, const std::string& cookie = "",
                    const std::string& method = "GET");
std::string raw_post(int port, const std::string& target, const std::string& cookie, const std::string& body);

}  // namespace trocar::review
