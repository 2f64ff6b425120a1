#include "tests/trainees/desk/server/live_desk.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include "trainees/desk/server/url_text.h"

namespace trocar::review {

DeskServerOptions LiveDesk::options() {
  DeskServerOptions out;
  out.open = [file = file_] { return Database(file); };
  out.routes = sample_routes();
  for (const Route& route : desk_routes()) out.routes.push_back(route);
  out.port = 0;
  out.page_threads = 2;
  return out;
}

void LiveDesk::serve(DeskServerOptions given) {
  server_ = std::make_unique<DeskServer>(std::move(given));
  server_->start();
}

Visitor LiveDesk::signed_in_there(const std::string& login) {
  const auto cookie_in = [](const std::string& raw) {
    return raw_header(raw, "Set-Cookie").substr(0, raw_header(raw, "Set-Cookie").find(';'));
  };
  const std::string page = raw_answer(port(), raw_get(port(), "/sign-in"));
  const std::string form = "login=" + login + "&password=" + percent_encoded(kPassword) +
                           "&token=" + percent_encoded(field_of(page, "token"));
  const std::string cookie = cookie_in(raw_answer(port(), raw_post(port(), "/sign-in", cookie_in(page), form)));
  return {cookie, field_of(raw_answer(port(), raw_get(port(), "/sign-in", cookie)), "token")};
}

std::string raw_header(const std::string& raw, const std::string& name) {
  const std::size_t end = raw.find("\r\n\r\n"), at = raw.find("\r\n" + name + ": ");
  if (at == std::string::npos || at > end) return "";
  const std::size_t from = at + name.size() + 4;
  return raw.substr(from, raw.find("\r\n", from) - from);
}

SlowVisitor::SlowVisitor(int port, const char* from) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
  sockaddr_in mine{}, server{};
  mine.sin_family = server.sin_family = AF_INET;
  ::inet_pton(AF_INET, from, &mine.sin_addr);
  ::bind(socket_, reinterpret_cast<sockaddr*>(&mine), sizeof mine);
  server.sin_port = htons(static_cast<std::uint16_t>(port));
  server.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(::connect(socket_, reinterpret_cast<sockaddr*>(&server), sizeof server), 0);
}

SlowVisitor::~SlowVisitor() { ::close(socket_); }

bool SlowVisitor::send(const std::string& bytes) {
  return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
}

std::string SlowVisitor::rest() {
  std::string out;
  char piece[4096];
  for (ssize_t count = 0; (count = ::recv(socket_, piece, sizeof piece, 0)) > 0;)
    out.append(piece, static_cast<std::size_t>(count));
  return out;
}

}  // namespace trocar::review
