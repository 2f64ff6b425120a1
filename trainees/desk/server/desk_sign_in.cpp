// Signing in and out: DeskGate's own two addresses.
#include <algorithm>

#include "trainees/desk/pages/desk_page.h"
#include "trainees/desk/server/desk_accounts.h"
#include "trainees/desk/server/request_context.h"
#include "trainees/desk/server/url_text.h"
#include "trainees/integrity/station_key.h"
#include "trainees/records/password_rules.h"
#include "trainees/store/disk_full.h"

namespace trocar::review {
namespace {

/// Verifying takes memory and time on purpose: so many at once, of whatever sort; pages are made meanwhile. Those who
/// sign in wait their turn before (DeskServer).
constexpr int kVerifyingAtOnce = 3;

std::string printable(const std::string& text) {
  std::string out = text.substr(0, 32);
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c <= ' ' || c >= 0x7f; }, '?');
  return out;
}

std::string first_page(const Account& account, const std::string& next) {
  const bool trainee = account.role == Role::kTrainee;
  if (local_path(next) && !next.starts_with("/sign-") && !(trainee && next == "/")) return next;
  return trainee ? "/trainee/" + percent_encoded(account.trainee_code) : "/";
}

std::string waiting_words(int seconds) {
  const std::string time =
      seconds < 120 ? std::to_string(seconds) + " s" : std::to_string((seconds + 59) / 60) + " min";
  return "Too many wrong tries. Wait " + time + ", then try again.";
}

Answer redirection(const std::string& to) { return {.response = {.status = 303, .location = to}}; }

/// Counts down when it goes out of scope.
class Counted {
 public:
  explicit Counted(std::atomic<int>& count) : count_(count), before_(count.fetch_add(1)) {}
  ~Counted() { count_.fetch_sub(1); }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
  int before() const { return before_; }

 private:
  std::atomic<int>& count_;
  int before_;
};

}  // namespace

Answer DeskGate::ask_to_sign_in(RequestContext& context, int status, const std::string& message,
                                const std::string& login, const std::string& next) {
  if (context.number.empty()) set_cookie(context, DeskSessions::fresh_number());
  SignInForm form{.status = status,
                  .message = message,
                  .login = login,
                  .next = local_path(next) ? next : "",
                  .token = sessions_.token(context.number)};
  if (context.posts() && context.incoming.head.path != "/sign-in") {
    form.message = "Your sign-in has ended. Nothing was changed.";
    if (const auto sent = form_fields(context.incoming.body)) form.written = prose_of(*sent);
  }
  if (form.message.empty() && !somebody_can_sign_in(context.desk.database))
    form.message =
        "Nobody has an account yet, and this desk is open without one only to the person who started it, on that "
        "machine. "
        "An account is made there by: trocar review account add LOGIN --role administrator";
  if (form.message.empty()) form.message = why_nobody_signs_in(context);
  return {.response = sign_in_page(form)};
}

/// No password can be judged while another key lies in place of the record's: no account's row holds under it. Where
/// there is none, people sign in to read. @returns "": they can.
std::string DeskGate::why_nobody_signs_in(RequestContext& context) const {
  const std::string nobody = "Nobody can sign in to this record now: ";
  sqlite3* connection = context.desk.database.connection();
  try {
    if (!station_key(connection)) return "";
  } catch (const std::runtime_error& error) {
    say(error.what());
    return nobody + "its key cannot be read: the terminal of the desk says why.";
  }
  const std::string lost = lost_key(connection);
  return lost.empty() ? "" : nobody + lost + ".";
}

Answer DeskGate::sign_in(RequestContext& context) {
  if (!context.posts()) {
    const auto query = form_fields(context.incoming.head.query);
    const std::string next = query && query->contains("next") ? query->at("next") : "";
    return ask_to_sign_in(context, 200, "", "", next);
  }
  if (auto refusal = refuse_posted(context)) {
    if (refusal->response.status != 403) return *refusal;
    return ask_to_sign_in(context, 403, "The form was too old. Sign in again.", "", "");
  }
  std::map<std::string, std::string>& form = context.request.form;
  return try_sign_in(context, form["login"], form["next"]);
}

/// What came of a password that was given.
struct DeskGate::Try {
  std::optional<Account> account = {};  ///< it was right
  std::string stamp = {};               ///< of the sign-in, then
  std::string why = {};                 ///< it was not looked at
  int wait_s = 0;                       ///< then: try again after so long, 0: not before something is done
};

DeskGate::Try DeskGate::try_password(RequestContext& context, const std::string& login, const std::string& password,
                                     SignInLimit& limit, const std::string& from) {
  if (const std::string why = why_nobody_signs_in(context); !why.empty()) return {.why = why};
  const std::string who = printable(login) + " from " + context.incoming.address;
  const Counted counted(verifying_);
  if (counted.before() >= kVerifyingAtOnce) return {.why = "Many sign in at this moment. Try again.", .wait_s = 2};
  AccountStore accounts(context.desk.database);
  const auto known = accounts.find(login);
  if (const int seconds = limit.begin(login, from, context.now, known.has_value()); seconds > 0) {
    say("sign-in held back: " + who);
    return {.why = waiting_words(seconds), .wait_s = seconds};
  }
  // Before the password is looked at, which takes a while: one that is reset meanwhile must not get the new one's
  // stamp.
  const std::string stamp = known ? sign_in_stamp(context.desk.database, known->uuid) : "";
  Try out{.account = accounts.verify(login, password)};
  if (out.account && known && out.account->uuid == known->uuid) out.stamp = stamp;
  if (!out.stamp.empty()) {
    limit.was_right(login, from);
    return out;
  }
  say("sign-in refused: " + who);
  if (limit.tell_held_back(login, from, context.now)) {
    try {
      accounts.held_back(known ? known->uuid : "");
    } catch (const DiskFull& error) {
      say(error.what());
    }
  }
  return {};
}

Answer DeskGate::try_sign_in(RequestContext& context, const std::string& login, const std::string& next) {
  const std::string password = context.request.form["password"];
  const Try tried =
      try_password(context, login, password, looks_like_pin(password) ? pin_limit_ : limit_, context.incoming.address);
  if (!tried.why.empty()) {
    Answer late = ask_to_sign_in(context, tried.wait_s > 0 ? 429 : 503, tried.why, login, next);
    late.retry_after_s = tried.wait_s;
    return late;
  }
  if (!tried.account) return ask_to_sign_in(context, 401, "Login or password is wrong.", login, next);
  Session session{tried.account->uuid, tried.stamp};
  try {
    AccountStore(context.desk.database).signed_in(session.account);  // what cannot be recorded does not happen
  } catch (const DiskFull&) {  // but for reading: who finds out what to do about it must get in
    session.recorded = false;
    say("the disk is full: this sign-in is not on record, and may read only");
  }
  sessions_.end(context.number);
  set_cookie(context, sessions_.begin(session, context.now));
  say("signed in: " + printable(login) + " from " + context.incoming.address);
  return redirection(first_page(*tried.account, next));
}

/// A browser that stands open is not the person: what binds somebody asks for the password again.
void DeskGate::confirm(RequestContext& context) {
  Request& request = context.request;
  const std::string password = request.form["password"];
  request.form.erase("password");
  if (!request.account || request.account->uuid.empty()) return;
  if (password.empty()) {
    request.unconfirmed = "your password is missing: it is asked for again here";
    return;
  }
  // By session: others who get the login's password wrong do not stop who is signed in, and who guesses at a browser
  // that was left open waits.
  const Try tried =
      try_password(context, request.account->login, password, signing_limit_, sessions_.token(context.number));
  if (tried.account) return;
  request.unconfirmed = tried.why.empty() ? "the password is wrong; nothing was written" : tried.why;
}

/// Whoever came while the disk was full is put on record before anything is written in their name.
/// @returns false: it still is full, and the route gives the form back. @throws DiskFull where the route cannot.
bool DeskGate::recorded_late(RequestContext& context) {
  const auto session = sessions_.find(context.number, context.now);
  if (!session || session->recorded) return true;
  try {
    AccountStore(context.desk.database).signed_in(session->account);
  } catch (const DiskFull&) {
    if (!context.found.route->keeps_form) throw;
    return false;
  }
  sessions_.mark_recorded(context.number);
  return true;
}

/// A new password ends every sign-in of the account but the one that set it, and gave the old one for it.
void DeskGate::renew_session(RequestContext& context) {
  if (!context.request.unconfirmed.empty() || context.found.route->path != kPasswordPath) return;
  if (!context.request.account || context.request.account->uuid.empty()) return;
  const std::string stamp = sign_in_stamp(context.desk.database, context.request.account->uuid);
  const auto session = sessions_.find(context.number, context.now);
  if (!session || stamp.empty() || stamp == session->stamp) return;
  sessions_.end(context.number);
  set_cookie(context, sessions_.begin({context.request.account->uuid, stamp}, context.now));
}

Answer DeskGate::sign_out(RequestContext& context) {
  if (!context.posts()) {
    Answer out{.response = error_page(405, "Sign out with the button that pages have.")};
    out.allow = "POST";
    return out;
  }
  if (const auto refusal = refuse_posted(context)) return *refusal;
  const auto session = sessions_.find(context.number, context.now);
  sessions_.end(context.number);
  set_cookie(context, "");
  try {
    if (session && !session->account.empty()) AccountStore(context.desk.database).signed_out(session->account);
  } catch (const DiskFull& error) {  // who goes is gone
    say(error.what());
  }
  return redirection("/sign-in");
}

}  // namespace trocar::review
