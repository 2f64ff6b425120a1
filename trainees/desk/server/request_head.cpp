#include "trainees/desk/server/request_head.h"

#include <algorithm>
#include <array>
#include <optional>

namespace trocar::review {
namespace {

bool token_character(char c) {
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  return letter || std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
}

bool token(std::string_view text) { return !text.empty() && std::all_of(text.begin(), text.end(), token_character); }

bool visible_text(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < 0x7f; });
}

/// No controls but tab; bytes above ASCII are left to whoever reads that header.
bool header_text(std::string_view text) {
  return std::none_of(text.begin(), text.end(),
                      [](char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7f; });
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return out;
}

std::optional<Refusal> read_request_line(std::string_view line, const RequestLimits& limits, RequestHead& head) {
  const std::size_t first = line.find(' '), last = line.rfind(' ');
  if (first == std::string_view::npos || first == last) return Refusal{400, "The request line cannot be read."};
  const std::string_view method = line.substr(0, first), target = line.substr(first + 1, last - first - 1),
                         version = line.substr(last + 1);
  if (!version.starts_with("HTTP/")) return Refusal{400, "The request line cannot be read."};
  if (version != "HTTP/1.1" && version != "HTTP/1.0") return Refusal{505, "Only HTTP/1.1 is spoken here."};
  if (!token(method) || method.size() > 16) return Refusal{400, "The method cannot be read."};
  if (target.empty() || target[0] != '/' || !visible_text(target)) return Refusal{400, "The address cannot be read."};
  const std::size_t question = target.find('?');
  head.method = method;
  head.path = target.substr(0, question);
  if (question != std::string_view::npos) head.query = target.substr(question + 1);
  if (head.path.size() > limits.path_bytes) return Refusal{414, "The address is too long."};
  if (target.find('#') != std::string_view::npos) return Refusal{400, "The address cannot be read."};
  return {};
}

std::optional<Refusal> read_header(std::string_view line, RequestHead& head) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos || !token(line.substr(0, colon))) return Refusal{400, "A header cannot be read."};
  const std::string name = lower(line.substr(0, colon));
  const std::string_view value = trimmed(line.substr(colon + 1));
  if (!header_text(value)) return Refusal{400, "A header has control characters."};
  const auto [at, fresh] = head.headers.try_emplace(name, value);
  if (fresh) return {};
  constexpr std::array<std::string_view, 6> kOnce{"host",   "content-length", "content-type", "transfer-encoding",
                                                  "origin", "sec-fetch-site"};
  if (std::find(kOnce.begin(), kOnce.end(), name) != kOnce.end()) return Refusal{400, "A header stands twice."};
  at->second += (name == "cookie" ? "; " : ", ") + std::string(value);
  return {};
}

std::optional<Refusal> read_body_length(const RequestLimits& limits, RequestHead& head) {
  if (head.headers.contains("transfer-encoding")) return Refusal{411, "The length of the request must be told."};
  if (const std::string encoding = lower(head.header("content-encoding")); !encoding.empty() && encoding != "identity")
    return Refusal{415, "Packed requests are not read."};
  const std::string length = head.header("content-length");
  if (!head.headers.contains("content-length")) {
    return head.method == "POST" ? std::optional(Refusal{411, "The length of the request must be told."})
                                 : std::nullopt;
  }
  const bool digits =
      !length.empty() && std::all_of(length.begin(), length.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!digits) return Refusal{400, "The length of the request cannot be read."};
  constexpr std::size_t kMostDigits = 12;
  if (length.size() > kMostDigits || std::stoull(length) > limits.body_bytes)
    return Refusal{413, "The request is too large."};
  head.content_length = std::stoull(length);
  return {};
}

}  // namespace

std::string RequestHead::header(const std::string& name) const {
  const auto at = headers.find(name);
  return at == headers.end() ? "" : at->second;
}

std::variant<RequestHead, Refusal> parse_head(std::string_view text, const RequestLimits& limits) {
  RequestHead head;
  std::size_t lines = 0;
  if (text.size() > limits.head_bytes) return Refusal{431, "The head of the request is too large."};
  while (true) {
    const std::size_t end = text.find("\r\n");
    if (end == std::string_view::npos) return Refusal{400, "The head of the request has no end."};
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 2);
    if (line.find_first_of(std::string_view("\r\n\0", 3)) != std::string_view::npos)
      return Refusal{400, "A line ends wrongly."};
    if (line.empty()) break;
    if (lines > limits.headers) return Refusal{431, "The request has too many headers."};
    if (const auto refusal = lines++ == 0 ? read_request_line(line, limits, head) : read_header(line, head))
      return *refusal;
  }
  if (lines == 0) return Refusal{400, "The request line is missing."};
  if (head.header("host").empty()) return Refusal{400, "The host is missing."};
  if (const auto refusal = read_body_length(limits, head)) return *refusal;
  return head;
}

}  // namespace trocar::review
