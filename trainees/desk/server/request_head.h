// The head of an HTTP request (RFC 9112), read strictly: what servers may disagree about is refused instead of guessed.
//
// CR LF only, no folded lines, no header twice that matters, Content-Length in digits, no Transfer-Encoding, no
// Content-Encoding, targets in visible ASCII that begin with '/'. Pure. Thread: any.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <variant>

namespace trocar::review {

struct RequestLimits {
  std::size_t head_bytes = 8192, body_bytes = 1U << 20U, path_bytes = 1024, headers = 64;
  int head_ms = 5000;    ///< until the head is whole
  int body_ms = 15000;   ///< from then until the body is
  int write_ms = 30000;  ///< until the answer is taken
};

struct RequestHead {
  std::string method;
  std::string path, query;                     ///< as sent; query without '?'
  std::map<std::string, std::string> headers;  ///< names in lower case; cookies of several headers joined by "; "
  std::size_t content_length = 0;

  std::string header(const std::string& name) const;
};

/// Status and one sentence for the page; status 0: nobody is there to answer.
struct Refusal {
  int status = 400;
  std::string why;
};

/// @param text up to and with the empty line.
std::variant<RequestHead, Refusal> parse_head(std::string_view text, const RequestLimits& limits = {});

}  // namespace trocar::review
