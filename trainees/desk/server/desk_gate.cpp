#include "trainees/desk/server/desk_gate.h"

#include <algorithm>
#include <exception>

#include "haptics/input_error.h"
#include "trainees/desk/pages/desk_page.h"
#include "trainees/desk/pages/page_frame.h"
#include "trainees/desk/server/desk_accounts.h"
#include "trainees/desk/server/path_redaction.h"
#include "trainees/desk/server/request_context.h"
#include "trainees/desk/server/url_text.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/store/disk_full.h"

namespace trocar::review {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return text;
}

/// Value of a cookie of that name; "" when it is missing or stands twice.
std::string cookie_value(const std::string& cookies, const std::string& name) {
  std::string out;
  int found = 0;
  for (std::size_t from = 0; from < cookies.size();) {
    const std::size_t to = std::min(cookies.find(';', from), cookies.size());
    const std::string pair = cookies.substr(from, to - from);
    const std::size_t begin = pair.find_first_not_of(' ');
    if (begin != std::string::npos && pair.compare(begin, name.size() + 1, name + "=") == 0) {
      out = pair.substr(begin + name.size() + 1);
      ++found;
    }
    from = to + 1;
  }
  return found == 1 ? out : "";
}

Answer refused(int status, const std::string& why = "") { return {.response = error_page(status, why)}; }

/// Where a trainee who opens the desk belongs; nothing for everybody else.
std::optional<std::string> own_page(const std::optional<Account>& account) {
  if (!account || account->role != Role::kTrainee || account->trainee_code.empty()) return {};
  return "/trainee/" + percent_encoded(account->trainee_code);
}

bool header_value(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c < 0x7f; });
}

}  // namespace

DeskGate::DeskGate(GateOptions options, std::vector<Route> routes)
    : options_(std::move(options)), table_(std::move(routes)), sessions_(options_.sessions) {}

void DeskGate::say(const std::string& line) const {
  if (options_.log) options_.log(line);
}

std::string DeskGate::cookie_name() const { return options_.secure ? "__Host-" + options_.cookie : options_.cookie; }

/// Of the visitor's cookie, "" without one.
std::string DeskGate::number_of(const RequestHead& head) const {
  const std::string number = cookie_value(head.header("cookie"), cookie_name());
  return DeskSessions::is_number(number) ? number : "";
}

std::string DeskGate::turn(const RequestHead& head, const std::string& address) const {
  const std::string account = sessions_.account(number_of(head));
  return account.empty() ? "address " + address : "account " + account;
}

void DeskGate::set_cookie(RequestContext& context, const std::string& number) const {
  context.number = number;
  context.cookie = cookie_name() + "=" + number + "; Path=/; HttpOnly; SameSite=Strict" +
                   (options_.secure ? "; Secure" : "") + (number.empty() ? "; Max-Age=0" : "");
}

bool DeskGate::known_host(const IncomingRequest& incoming) const {
  const std::string host = lower(incoming.head.header("host"));
  const std::size_t colon = host.rfind(':');
  const std::string name = host.substr(0, colon);
  const int usual = options_.secure ? 443 : 80;
  const std::string port = colon == std::string::npos ? std::to_string(usual) : host.substr(colon + 1);
  if (port != std::to_string(options_.port)) return false;
  if (std::find(options_.hosts.begin(), options_.hosts.end(), name) != options_.hosts.end()) return true;
  const bool loopback = incoming.local_address.starts_with("127.");
  return (!name.empty() && name == incoming.local_address) || (loopback && name == "localhost");
}

void DeskGate::open_session(RequestContext& context) {
  Database& database = context.desk.database;
  const bool open_to_user = !options_.lan && !somebody_can_sign_in(database);
  if (const auto session = sessions_.find(context.number, context.now)) {
    if (session->account.empty()) {
      if (open_to_user) context.request.account = local_instructor();
    } else if (const std::string stamp = sign_in_stamp(database, session->account);
               !stamp.empty() && stamp == session->stamp) {
      context.request.account = AccountStore(database).by_uuid(session->account);
    }
    if (!context.request.account) sessions_.end(context.number);
  }
  if (context.request.account || !open_to_user || context.posts()) return;
  if (!context.incoming.same_user || !context.incoming.same_user()) return;
  set_cookie(context, sessions_.begin({}, context.now));
  context.request.account = local_instructor();
}

/// Any page with ?lang=de: a cookie that the browser keeps for a year, and back to the page. No form is needed, since
/// nothing of the record depends on it.
std::optional<Answer> DeskGate::choose_language(RequestContext& context) const {
  constexpr std::string_view kName = "lang=";
  const RequestHead& head = context.incoming.head;
  std::string language, others;
  for (std::size_t from = 0; from < head.query.size();) {
    const std::size_t to = std::min(head.query.find('&', from), head.query.size());
    const std::string one = head.query.substr(from, to - from);
    from = to + 1;
    if (one.starts_with(kName))
      language = one.substr(kName.size());
    else
      others += (others.empty() ? "?" : "&") + one;
  }
  if (language.empty() || context.posts()) return {};
  if (!desk_tongue(language)) return refused(400, "The desk has no such language.");
  context.cookie = "lang=" + language + "; Path=/; HttpOnly; SameSite=Strict; Max-Age=31536000" +
                   (options_.secure ? "; Secure" : "");
  const bool page = head.path == "/sign-in" || table_.find("GET", head.path).route != nullptr;
  return Answer{.response = {.status = 303, .location = page ? head.path + others : "/"}};
}

const PageLanguage* DeskGate::language_of(const IncomingRequest& incoming) const {
  if (!options_.languages) return nullptr;
  return options_.languages->chosen(cookie_value(incoming.head.header("cookie"), "lang"),
                                    incoming.head.header("accept-language"));
}

std::optional<Answer> DeskGate::refuse_audience(RequestContext& context) const {
  const Audience audience = context.found.route->audience;
  if (audience == Audience::kEverybody) return {};
  if (!context.request.account)
    return Answer{.response = {.status = 401}};  // the form is made by whoever may set a cookie
  const Role role = context.request.account->role;
  if (audience == Audience::kSignedIn && context.request.account->uuid.empty())
    return refused(403, "Nobody signs in here, so there is no password. Accounts are made under Accounts.");
  if (audience == Audience::kAdministrators && role != Role::kAdministrator) return refused(403);
  if (audience == Audience::kInstructors && role == Role::kTrainee) return refused(403);
  return {};
}

std::optional<Answer> DeskGate::refuse_posted(RequestContext& context) const {
  const RequestHead& head = context.incoming.head;
  const std::string site = lower(head.header("sec-fetch-site")), origin = lower(head.header("origin"));
  if (!site.empty() && site != "same-origin" && site != "none")
    return refused(403, "This form was sent by another site.");
  // Browsers say "null" where a page forbids to tell where it comes from, as these do.
  const std::string own = (options_.secure ? "https://" : "http://") + lower(head.header("host"));
  if (!origin.empty() && origin != "null" && origin != own) return refused(403, "This form was sent by another site.");
  const std::string type = lower(head.header("content-type"));
  if (type.substr(0, type.find(';')) != "application/x-www-form-urlencoded")
    return refused(415, "Only forms of this desk are read here.");
  const auto form = form_fields(context.incoming.body);
  if (!form) return refused(400);
  context.request.form = *form;
  const std::string token = context.request.form["token"];
  context.request.form.erase("token");
  if (context.number.empty() || !sessions_.token_fits(context.number, token))
    return Answer{.response = error_page(
                      403,
                      "This form is too old, or not from this desk. Nothing was changed. Open the page again and "
                      "repeat what you did.",
                      prose_of(context.request.form))};
  return {};
}

std::optional<Answer> DeskGate::refuse_foreign(RequestContext& context) const {
  Request& request = context.request;
  const Audience audience = context.found.route->audience;
  if (!request.account || request.account->role != Role::kTrainee || audience == Audience::kEverybody ||
      audience == Audience::kSignedIn)
    return {};
  const Account& account = *request.account;
  const auto end = request.arguments.end();
  const auto code = request.arguments.find("code"), attempt = request.arguments.find("attempt"),
             certificate = request.arguments.find("certificate");
  const bool none = code == end && attempt == end && certificate == end;
  if (none || (code != end && !may_see_trainee(account, code->second)) ||
      (certificate != end && !may_see_certificate(account, context.desk.database, certificate->second)))
    return refused(403, "You see your own attempts only.");
  if (attempt != end) {
    const auto own = own_attempt(account, context.desk.database, attempt->second);
    if (!own) return refused(403, "You see your own attempts only.");
    attempt->second = *own;  // whatever comes in between, the page takes the one that was looked at
  }
  for (const auto* fields : {&request.query, &request.form, &request.arguments}) {
    for (const auto& [name, value] : *fields) {
      if (names_another(context.desk.database, value, account.trainee_code))
        return refused(403, "You see your own attempts only.");
    }
  }
  return {};
}

Answer DeskGate::page(RequestContext& context) {
  const bool staff = context.request.account && context.request.account->role != Role::kTrainee;
  const std::string what = context.incoming.head.method + " " + context.incoming.head.path.substr(0, 200);
  try {
    if (context.posts()) context.request.disk_full = !recorded_late(context);
    Answer out{.response = context.found.route->answer(context.request, context.desk)};
    const int status = out.response.status;
    if (status < 200 || status > 599 || !header_value(out.response.type))
      throw std::logic_error("answer with status or type that cannot be sent");
    return out;
  } catch (const InputError& error) {
    return refused(400, staff ? sentence(without_folders(error.what(), context.desk.database.file())) : "");
  } catch (const DiskFull& error) {
    say(what + ": " + error.what());
    if (!context.posts()) return refused(507);
    const RequestHead& head = context.incoming.head;
    std::map<std::string, std::string> form = context.request.form;
    if (context.found.route->asks_password) form["password"];  // was taken out, and is asked for anew
    return {.response =
                disk_full_page(head.path + (head.query.empty() ? "" : "?" + head.query), context.request.token, form)};
  } catch (const EnvironmentError& error) {
    say(what + ": " + error.what());
    Answer out = refused(503, staff ? sentence(without_folders(error.what(), context.desk.database.file())) : "");
    out.retry_after_s = 5;
    return out;
  } catch (const std::exception& error) {
    say(what + ": " + error.what());
    return refused(500);
  }
}

Answer DeskGate::answered(RequestContext& context) {
  const RequestHead& head = context.incoming.head;
  if (!known_host(context.incoming)) return refused(421);
  if (head.method != "GET" && head.method != "HEAD" && head.method != "POST") {
    Answer out = refused(405);
    out.allow = "GET, HEAD, POST";
    return out;
  }
  if (const auto chosen = choose_language(context)) return *chosen;
  if (head.path == "/sign-in") return sign_in(context);
  if (head.path == "/sign-out") return sign_out(context);
  context.found = table_.find(head.method, head.path);
  if (context.found.methods.empty()) return refused(404);
  if (!context.found.route) {
    Answer out = refused(405);
    for (const std::string& method : context.found.methods) out.allow += (out.allow.empty() ? "" : ", ") + method;
    return out;
  }
  Request& request = context.request;
  request.path = head.path;
  request.arguments = context.found.arguments;
  request.now_utc = utc_now();
  if (context.found.route->audience != Audience::kEverybody) open_session(context);
  if (const auto own = own_page(request.account); own && !context.posts() && head.path == "/")
    return {.response = {.status = 303, .location = *own}};
  if (const auto refusal = refuse_audience(context)) {
    if (refusal->response.status != 401) return *refusal;
    const std::string next = context.posts() ? "" : head.path + (head.query.empty() ? "" : "?" + head.query);
    return ask_to_sign_in(context, 401, "", "", next);
  }
  if (context.posts()) {
    if (const auto refusal = refuse_posted(context)) return *refusal;
  }
  const auto query = form_fields(head.query);
  if (!query) return refused(400);
  request.query = *query;
  if (const auto refusal = refuse_foreign(context)) return *refusal;
  if (!context.number.empty()) request.token = sessions_.token(context.number);
  request.range = head.header("range");
  if (!context.found.route->asks_password) return page(context);
  confirm(context);
  Answer out = page(context);
  renew_session(context);
  return out;
}

Answer DeskGate::answer(const IncomingRequest& incoming, Desk& desk) {
  RequestContext context{incoming, desk, options_.clock()};
  Answer out;
  try {
    context.number = number_of(incoming.head);
    out = answered(context);
  } catch (const EnvironmentError& error) {
    say(error.what());
    out = refused(503);
    out.retry_after_s = 5;
  } catch (const std::exception& error) {
    say(error.what());
    out = refused(500);
  }
  out.cookie = context.cookie;
  Response& made = out.response;
  if (const PageLanguage* language = language_of(incoming);
      language != nullptr && made.type.starts_with("text/html") && made.download.empty())
    made.body = language->page(made.body);
  return out;
}

std::vector<std::pair<std::string, std::string>> DeskGate::headers(const Answer& answer) const {
  std::vector<std::pair<std::string, std::string>> out{
      {"Content-Security-Policy",
       "default-src 'none'; style-src 'self'; img-src 'self' data:; script-src 'self'; connect-src 'self'; media-src "
       "'self'; form-action 'self'; "
       "frame-ancestors 'none'; base-uri 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"X-Frame-Options", "DENY"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Cache-Control", "no-store"}};
  const Response& response = answer.response;
  if (!response.location.empty()) out.emplace_back("Location", redirection_to(response.location));
  if (!response.download.empty())
    out.emplace_back("Content-Disposition", "attachment; filename=\"" + download_name(response.download) + "\"");
  if (response.accept_ranges) out.emplace_back("Accept-Ranges", "bytes");
  if (!response.content_range.empty() && header_value(response.content_range))
    out.emplace_back("Content-Range", response.content_range);
  if (!answer.cookie.empty()) out.emplace_back("Set-Cookie", answer.cookie);
  if (!answer.allow.empty()) out.emplace_back("Allow", answer.allow);
  if (answer.retry_after_s > 0) out.emplace_back("Retry-After", std::to_string(answer.retry_after_s));
  if (answer.made_in_ms > 0) {
    char text[40];
    std::snprintf(text, sizeof text, "page;dur=%.1f", answer.made_in_ms);
    out.emplace_back("Server-Timing", text);
  }
  return out;
}

}  // namespace trocar::review
