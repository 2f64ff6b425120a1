// Between the network and the pages: everything that must hold before a page is called, without a socket, so that it is
// tested without one.
//
// In this order: name of the host, method, route, session, audience, token and origin of what is posted, decoding,
// whose data. A page is called only when all of it holds; docs/decisions/0009-desk-sign-in.md says why so. Thread: any;
// the Desk is its thread's own.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "trainees/desk/routes/route_table.h"
#include "trainees/desk/server/desk_sessions.h"
#include "trainees/desk/server/request_head.h"
#include "trainees/desk/server/sign_in_limit.h"
#include "trainees/desk/words/page_language.h"

namespace trocar::review {

struct GateOptions {
  bool lan = false;                     ///< everybody signs in
  bool secure = false;                  ///< behind TLS
  std::string cookie = "trocar_desk";   ///< name; cookies do not tell ports apart, so the port stands in it
  std::vector<std::string> hosts = {};  ///< names it goes by, in lower case, without port
  int port = 0;
  std::function<void(const std::string&)> log = {};  ///< one line; any thread
  std::function<DeskTime()> clock = std::chrono::steady_clock::now;
  SessionLimits sessions = {};
  std::shared_ptr<const PageLanguages> languages = {};  ///< without them every page is English
};

/// A request as it came, whole.
struct IncomingRequest {
  RequestHead head;
  std::string body;
  std::string address;                   ///< of who sent it
  std::string local_address = {};        ///< at which it arrived: a name it goes by too
  std::function<bool()> same_user = {};  ///< sent by a program of the user that runs the desk; asked when it matters
};

/// An answer as it goes out: the page's, and what only the server knows.
struct Answer {
  Response response;
  std::string cookie = {};  ///< "Set-Cookie"
  std::string allow = {};   ///< of 405
  int retry_after_s = 0;    ///< of 429 and 503
  double made_in_ms = 0;    ///< told as "Server-Timing"; 0: not measured
};

class DeskGate {
 public:
  DeskGate(GateOptions options, std::vector<Route> routes);

  /// Never throws but for what no answer can be made of (no memory).
  Answer answer(const IncomingRequest& incoming, Desk& desk);
  /// Whose a request is while requests wait: the account's that is signed in, else the address's.
  std::string turn(const RequestHead& head, const std::string& address) const;
  /// Ones that every answer has, and those of this one. Values are safe to send.
  std::vector<std::pair<std::string, std::string>> headers(const Answer& answer) const;

 private:
  struct RequestContext;
  Answer answered(RequestContext& context);
  std::optional<Answer> choose_language(RequestContext& context) const;
  const PageLanguage* language_of(const IncomingRequest& incoming) const;
  bool known_host(const IncomingRequest& incoming) const;
  void open_session(RequestContext& context);
  std::optional<Answer> refuse_audience(RequestContext& context) const;
  std::optional<Answer> refuse_posted(RequestContext& context) const;
  std::optional<Answer> refuse_foreign(RequestContext& context) const;
  Answer page(RequestContext& context);
  Answer sign_in(RequestContext& context);
  Answer try_sign_in(RequestContext& context, const std::string& login, const std::string& next);
  std::string why_nobody_signs_in(RequestContext& context) const;
  struct Try;
  /// @param from what its wrong tries are counted by, besides the login: address or session.
  Try try_password(RequestContext& context, const std::string& login, const std::string& password, SignInLimit& limit,
                   const std::string& from);
  void confirm(RequestContext& context);
  void renew_session(RequestContext& context);
  bool recorded_late(RequestContext& context);
  Answer sign_out(RequestContext& context);
  Answer ask_to_sign_in(RequestContext& context, int status, const std::string& message, const std::string& login,
                        const std::string& next);
  void set_cookie(RequestContext& context, const std::string& number) const;
  std::string cookie_name() const;
  std::string number_of(const RequestHead& head) const;
  void say(const std::string& line) const;

  GateOptions options_;
  RouteTable table_;
  DeskSessions sessions_;
  /// Apart: whoever guesses at PINs keeps nobody with a password out, and whoever guesses at either nobody who is
  /// signed in from signing.
  SignInLimit limit_, pin_limit_, signing_limit_;
  std::atomic<int> verifying_{0};
};

}  // namespace trocar::review
