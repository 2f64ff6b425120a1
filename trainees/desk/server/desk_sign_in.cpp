// Signing in and out: DeskGate's own two addresses.
#include <algorithm>

#include "trainees/desk/pages/desk_page.h"
#include "trainees/desk/server/desk_accounts.h"
#include "trainees/desk/server/request_context.h"
#include "trainees/desk/server/url_text.h"

namespace trocar::review {
namespace {

/// Verifying takes memory and time on purpose: so many at once, the others wait outside.
constexpr int kVerifyingAtOnce = 2;

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
  return {.response = sign_in_page(form)};
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

Answer DeskGate::try_sign_in(RequestContext& context, const std::string& login, const std::string& next) {
  const std::string &password = context.request.form["password"],
                    who = printable(login) + " from " + context.incoming.address;
  const Counted counted(verifying_);
  if (counted.before() >= kVerifyingAtOnce) {
    Answer busy = ask_to_sign_in(context, 429, "Many sign in at this moment. Try again.", login, next);
    busy.retry_after_s = 2;
    return busy;
  }
  if (const int seconds = limit_.begin(login, context.incoming.address, context.now); seconds > 0) {
    say("sign-in held back: " + who);
    Answer late = ask_to_sign_in(context, 429, waiting_words(seconds), login, next);
    late.retry_after_s = seconds;
    return late;
  }
  AccountStore accounts(context.desk.database);
  const auto account = accounts.verify(login, password);
  const std::string stamp = account ? sign_in_stamp(context.desk.database, account->uuid) : "";
  if (stamp.empty()) {
    say("sign-in refused: " + who);
    if (limit_.tell_held_back(login, context.incoming.address, context.now)) {
      const auto known = accounts.find(login);
      accounts.held_back(known ? known->uuid : "");
    }
    return ask_to_sign_in(context, 401, "Login or password is wrong.", login, next);
  }
  limit_.was_right(login, context.incoming.address);
  accounts.signed_in(account->uuid);  // what cannot be recorded does not happen
  sessions_.end(context.number);
  set_cookie(context, sessions_.begin({account->uuid, stamp}, context.now));
  say("signed in: " + who);
  return redirection(first_page(*account, next));
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
  if (session && !session->account.empty()) AccountStore(context.desk.database).signed_out(session->account);
  return redirection("/sign-in");
}

}  // namespace trocar::review
