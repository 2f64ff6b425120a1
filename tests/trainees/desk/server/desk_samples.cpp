#include "tests/trainees/desk/server/desk_samples.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "trainees/desk/server/url_text.h"
#include "trainees/records/assessments.h"
#include "trainees/records/trainee_store.h"

namespace trocar::review {
namespace {

Response plain(const Request& request, Desk&) {
  return {.type = "text/plain",
          .body = "page for " + (request.account ? request.account->login : std::string("everybody")) + "\n"};
}

}  // namespace

std::vector<Route> sample_routes() {
  std::vector<Route> out;
  const std::vector<std::pair<Audience, std::string>> kinds{{Audience::kEverybody, "/everybody"},
                                                            {Audience::kOwnData, "/own"},
                                                            {Audience::kOwnData, "/own/{code}"},
                                                            {Audience::kOwnData, "/own/attempt/{attempt}"},
                                                            {Audience::kOwnData, "/own/{code}/attempt/{attempt}"},
                                                            {Audience::kInstructors, "/staff/{code}"},
                                                            {Audience::kAdministrators, "/admin"}};
  for (const auto& [audience, path] : kinds) {
    for (const char* method : {"GET", "POST"})
      out.push_back({.method = method, .path = path, .audience = audience, .answer = plain});
  }
  const auto failing = [&](const std::string& path, const std::function<Response()>& fails) {
    out.push_back(
        {.method = "GET", .path = path, .audience = Audience::kOwnData, .answer = [fails](const Request&, Desk&) {
           return fails();
         }});
  };
  failing("/fails/input/{code}", []() -> Response { throw InputError("T-otto is <b>unknown</b>"); });
  failing("/fails/machine/{code}", []() -> Response { throw EnvironmentError("/home/x/trocar.db: disk full"); });
  failing("/fails/program/{code}", []() -> Response { throw std::out_of_range("secret of the program"); });
  failing("/fails/status/{code}", [] { return Response{.status = 99}; });
  failing("/fails/type/{code}", [] { return Response{.type = "text/html\r\nX-Evil: 1"}; });
  failing("/leads/{code}", [] { return Response{.status = 303, .location = "/a\r\nSet-Cookie: evil=1"}; });
  failing("/saves/{code}", [] { return Response{.body = "x", .download = "a\"\r\nX-Evil: 1/../b.csv"}; });
  return out;
}

DeskTest::DeskTest() : file_(folder_ / "desk.db"), database_(file_) {
  annas_ = store_attempt(database_, sample_start("T-anna"), sample_result(80)).uuid;
  ottos_ = store_attempt(database_, sample_start("T-otto"), sample_result(60)).uuid;
  store_attempt(database_, sample_start("T-anna"), sample_result(82));
  store_attempt(database_, sample_start("T-otto"), sample_result(64));
  AssessmentStore(database_).add_note("T-otto", "", kSecretNote, {"", "I. Instructor"});
}

void DeskTest::add_accounts() {
  AccountStore accounts(database_);
  accounts.add("anna", "Anna", Role::kTrainee, "T-anna", kPassword, "");
  accounts.add("otto", "Otto", Role::kTrainee, "T-otto", kPassword, "");
  accounts.add("ines", "Ines", Role::kInstructor, "", kPassword, "");
  accounts.add("adam", "Adam", Role::kAdministrator, "", kPassword, "");
}

void DeskTest::make_gate(GateOptions options, std::vector<Route> routes) {
  options.port = kDeskPort;
  options.clock = [this] { return now_; };
  options.log = [this](const std::string& line) { log_.push_back(line); };
  gate_ = std::make_unique<DeskGate>(std::move(options), std::move(routes));
}

Answer DeskTest::ask(const std::string& method, const std::string& target, const Visitor& visitor,
                     const std::string& body, const std::vector<std::string>& headers) {
  std::string text = method + " " + target + " HTTP/1.1\r\n";
  bool host = false;
  for (const std::string& line : headers) {
    text += line + "\r\n";
    host = host || line.starts_with("Host:");
  }
  if (!host) text += "Host: 127.0.0.1:" + std::to_string(kDeskPort) + "\r\n";
  if (!visitor.cookie.empty()) text += "Cookie: " + visitor.cookie + "\r\n";
  std::string form = body;
  if (method == "POST") {
    if (!visitor.token.empty()) form += (form.empty() ? "" : "&") + ("token=" + percent_encoded(visitor.token));
    text +=
        "Content-Type: application/x-www-form-urlencoded\r\nContent-Length: " + std::to_string(form.size()) + "\r\n";
  }
  const auto head = parse_head(text + "\r\n");
  if (const auto* refusal = std::get_if<Refusal>(&head)) {
    ADD_FAILURE() << target << ": " << refusal->why;
    return {};
  }
  const IncomingRequest incoming{.head = std::get<RequestHead>(head),
                                 .body = form,
                                 .address = address_,
                                 .local_address = local_address_,
                                 .same_user = [this] { return same_user_; }};
  return gate_->answer(incoming, desk_);
}

Visitor DeskTest::stranger() {
  const Answer page = ask("GET", "/sign-in");
  return {cookie_of(page), field_of(page.response.body, "token")};
}

Answer DeskTest::try_sign_in(const std::string& login, const std::string& password, const Visitor& visitor,
                             const std::string& next) {
  return ask(
      "POST", "/sign-in", visitor,
      "login=" + percent_encoded(login) + "&password=" + percent_encoded(password) + "&next=" + percent_encoded(next));
}

Visitor DeskTest::signed_in(const std::string& login, const std::string& password) {
  const Answer answer = try_sign_in(login, password, stranger());
  EXPECT_EQ(answer.response.status, 303) << login;
  const std::string cookie = cookie_of(answer);
  const Answer again = ask("GET", "/sign-in", {cookie, ""});
  return {cookie, field_of(again.response.body, "token")};
}

std::string cookie_of(const Answer& answer) { return answer.cookie.substr(0, answer.cookie.find(';')); }

std::string field_of(const std::string& page, const std::string& name) {
  const std::string mark = "name=\"" + name + "\" value=\"";
  const std::size_t at = page.find(mark);
  if (at == std::string::npos) return "";
  return page.substr(at + mark.size(), page.find('"', at + mark.size()) - at - mark.size());
}

std::string header_of(const DeskGate& gate, const Answer& answer, const std::string& name) {
  for (const auto& [header, value] : gate.headers(answer)) {
    if (header == name) return value;
  }
  return "";
}

std::string raw_answer(int port, const std::string& bytes, int patience_ms, bool ends) {
  const int client = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in server{};
  server.sin_family = AF_INET;
  server.sin_port = htons(static_cast<std::uint16_t>(port));
  server.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::string out;
  if (::connect(client, reinterpret_cast<sockaddr*>(&server), sizeof server) == 0) {
    for (std::size_t sent = 0; sent < bytes.size();) {
      // held back for the end, so that the other side never sees the request without it
      const int flags = MSG_NOSIGNAL | (ends ? MSG_MORE : 0);
      const ssize_t count = ::send(client, bytes.data() + sent, bytes.size() - sent, flags);
      if (count <= 0) break;
      sent += static_cast<std::size_t>(count);
    }
    if (ends) ::shutdown(client, SHUT_WR);
    pollfd watched{client, POLLIN, 0};
    char piece[16384];
    while (::poll(&watched, 1, patience_ms) > 0) {
      const ssize_t count = ::recv(client, piece, sizeof piece, 0);
      if (count <= 0) break;
      out.append(piece, static_cast<std::size_t>(count));
    }
  }
  ::close(client);
  return out;
}

int status_of(const std::string& raw) {
  constexpr std::size_t kAt = 9;  // behind "HTTP/1.1 "
  return raw.starts_with("HTTP/1.1 ") ? std::atoi(raw.c_str() + kAt) : 0;
}

std::string raw_get(int port, const std::string& target, const std::string& cookie, const std::string& method) {
  return method + " " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n" +
         (cookie.empty() ? "" : "Cookie: " + cookie + "\r\n") + "\r\n";
}

std::string raw_post(int port, const std::string& target, const std::string& cookie, const std::string& body) {
  return "POST " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
         "\r\nContent-Type: application/x-www-form-urlencoded\r\nContent-Length: " + std::to_string(body.size()) +
         "\r\n" + (cookie.empty() ? "" : "Cookie: " + cookie + "\r\n") + "\r\n" + body;
}

}  // namespace trocar::review
