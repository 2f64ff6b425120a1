#include "trainees/desk/server/sent_answer.h"

#include <httplib.h>

#include <algorithm>

namespace trocar::review {
namespace {

/// The library reads a request of our own from it: that of the visitor has been read and judged before
/// (request_head.h).
class AnswerStream : public httplib::Stream {
 public:
  AnswerStream(Connection& connection, Deadline until, bool head_only)
      : connection_(connection),
        until_(until),
        request_(std::string(head_only ? "HEAD" : "GET") + " / HTTP/1.1\r\nHost: desk\r\n\r\n") {}
  bool is_readable() const override { return true; }
  bool is_writable() const override { return true; }
  ssize_t read(char* into, size_t most) override {
    const std::size_t count = std::min(most, request_.size() - read_);
    std::copy_n(request_.data() + read_, count, into);
    read_ += count;
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* from, size_t count) override {
    whole_ = whole_ && connection_.write(from, count, until_);
    return whole_ ? static_cast<ssize_t>(count) : -1;
  }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return connection_.socket(); }
  bool whole() const { return whole_; }

 private:
  Connection& connection_;
  Deadline until_;
  std::string request_;
  std::size_t read_ = 0;
  bool whole_ = true;
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
  bool send(AnswerStream& stream) {
    bool closed = false;
    process_request(stream, true, closed, nullptr);
    return stream.whole();
  }
};

}  // namespace

bool send_answer(Connection& connection, const Response& response,
                 const std::vector<std::pair<std::string, std::string>>& headers, bool head_only, Deadline until) {
  AnswerStream stream(connection, until, head_only);
  return OneAnswer(response, headers).send(stream);
}

}  // namespace trocar::review
