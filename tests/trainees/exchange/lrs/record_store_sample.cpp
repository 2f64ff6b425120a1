#include "tests/trainees/exchange/lrs/record_store_sample.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

namespace trocar::test {
namespace {

using nlohmann::json;

std::string reply(const char* status, const std::string& body) {
  return std::string("HTTP/1.1 ") + status +
         "\r\nContent-Type: application/json\r\nContent-Length: " + std::to_string(body.size()) +
         "\r\nConnection: close\r\n\r\n" + body;
}

}  // namespace

RecordStoreSample::RecordStoreSample() : listener_(socket(AF_INET, SOCK_STREAM, 0)) {
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof here;
  bind(listener_, reinterpret_cast<sockaddr*>(&here), size);
  listen(listener_, 16);
  getsockname(listener_, reinterpret_cast<sockaddr*>(&here), &size);
  port_ = ntohs(here.sin_port);
  thread_ = std::thread([this] { serve(); });
}

RecordStoreSample::~RecordStoreSample() {
  ends_ = true;
  thread_.join();
  close(listener_);
}

std::map<std::string, std::string> RecordStoreSample::kept() const {
  const std::scoped_lock lock(mutex_);
  return kept_;
}

std::vector<std::string> RecordStoreSample::heads() const {
  const std::scoped_lock lock(mutex_);
  return heads_;
}

void RecordStoreSample::serve() {
  while (!ends_) {
    pollfd wait{listener_, POLLIN, 0};
    if (poll(&wait, 1, 50) <= 0) continue;
    const int line = accept(listener_, nullptr, nullptr);
    talk(line);
    close(line);
  }
}

void RecordStoreSample::talk(int line) {
  std::string text;
  char bytes[4096];
  std::size_t head_end = std::string::npos, whole = 0;
  for (;;) {
    const ssize_t got = recv(line, bytes, sizeof bytes, 0);
    if (got <= 0) return;
    text.append(bytes, static_cast<std::size_t>(got));
    if (head_end == std::string::npos && (head_end = text.find("\r\n\r\n")) != std::string::npos) {
      const std::size_t length = text.find("Content-Length: ");
      whole = head_end + 4 + (length < head_end ? std::stoul(text.substr(length + 16)) : 0);
    }
    if (head_end != std::string::npos && text.size() >= whole) break;
  }
  const std::string out = answer(text.substr(0, head_end), text.substr(head_end + 4));
  send(line, out.data(), out.size(), MSG_NOSIGNAL);
}

std::string RecordStoreSample::answer(const std::string& head, const std::string& body) {
  {
    const std::scoped_lock lock(mutex_);
    heads_.push_back(head);
  }
  if (head.starts_with("GET /xapi/about")) return reply("200 OK", R"({"version":)" + versions + "}");
  const std::string other = instead(requests_++);
  if (other != "." && other != "!") return other;
  const std::string whole = take(body, head.starts_with("POST"));
  return other == "!" ? "" : whole;
}

std::string RecordStoreSample::take(const std::string& body, bool many) {
  const std::scoped_lock lock(mutex_);
  const json statements = many ? json::parse(body) : json::array({json::parse(body)});
  json ids = json::array();
  std::map<std::string, std::string> fresh;
  for (const json& one : statements) {
    const std::string id = one["id"], text = one.dump();
    ids.push_back(id);
    if (text.find(refuses) != std::string::npos) return reply("400 Bad Request", R"({"error":"no such thing"})");
    const auto there = kept_.find(id);
    if (there == kept_.end()) {
      fresh[id] = text;
      continue;
    }
    ++doubled_;
    if (there->second != text) return reply("409 Conflict", "");
  }
  kept_.insert(fresh.begin(), fresh.end());
  return many ? reply("200 OK", ids.dump()) : "HTTP/1.1 204 No Content\r\nConnection: close\r\n\r\n";
}

}  // namespace trocar::test
