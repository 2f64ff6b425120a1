#include "trainees/desk/server/sent_answer.h"

#include <httplib.h>

#include <algorithm>

namespace trocar::review {
namespace {

/// The library reads a request of our own from it: that of the visitor has been read and judged before
/// (request_head.h).
class AnswerStream : public httplib::Stream {
 public:
  explicit AnswerStream(bool head_only)
      : request_(std::string(head_only ? "HEAD" : "GET") + " / HTTP/1.1\r\nHost: desk\r\n\r\n") {}
  bool is_readable() const override { return true; }
  bool is_writable() const override { return true; }
  ssize_t read(char* into, size_t most) override {
    const std::size_t count = std::min(most, request_.size() - read_);
    std::copy_n(request_.data() + read_, count, into);
    read_ += count;
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* from, size_t count) override {
    written.append(from, count);
    return static_cast<ssize_t>(count);
  }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return INVALID_SOCKET; }

  std::string written = {};

 private:
  std::string request_;
  std::size_t read_ = 0;
};

/// Answers one request with what it was given; it never listens.
class OneAnswer : public httplib::Server {
 public:
  OneAnswer(const Response& response, const std::vector<std::pair<std::string, std::string>>& headers) {
    set_pre_routing_handler([&](const httplib::Request&, httplib::Response& out) {
      out.status = response.status;
      out.set_content(response.body, response.type);
      for (const auto& [name, value] : headers) out.set_header(name, value);
      return HandlerResponse::Handled;
    });
  }
  void write(AnswerStream& stream) {
    bool closed = false;
    process_request(stream, true, closed, nullptr);
  }
};

}  // namespace

std::string answer_bytes(const Response& response, const std::vector<std::pair<std::string, std::string>>& headers,
                         bool head_only) {
  AnswerStream stream(head_only);
  OneAnswer(response, headers).write(stream);
  return std::move(stream.written);
}

}  // namespace trocar::review
