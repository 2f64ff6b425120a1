// Heads of requests: what is read, and that everything servers disagree about is refused (RFC 9112, sections 3 and 5 to
// 6).
#include "trainees/desk/server/request_head.h"

#include <gtest/gtest.h>

#include <random>

namespace trocar::review::request_head_test {
namespace {

int status_of(const std::string& text, const RequestLimits& limits = {}) {
  const auto read = parse_head(text, limits);
  const auto* refusal = std::get_if<Refusal>(&read);
  return refusal ? refusal->status : 200;
}

int status_with(const std::string& headers, const std::string& line = "GET / HTTP/1.1") {
  return status_of(line + "\r\nHost: desk\r\n" + headers + "\r\n");
}

TEST(RequestHead, ReadsWhatBrowsersSend) {
  const auto read = parse_head(
      "POST /trainee/T01?x=1&y=%20?z HTTP/1.1\r\nHost: 127.0.0.1:8642\r\nCOOKIE:a=1 \r\ncookie:\tb=2\r\n"
      "Content-Type: application/x-www-form-urlencoded\r\nContent-Length: 12\r\nAccept: text/html, */*\r\n\r\n");
  ASSERT_TRUE(std::holds_alternative<RequestHead>(read));
  const auto& head = std::get<RequestHead>(read);
  EXPECT_EQ(head.method, "POST");
  EXPECT_EQ(head.path, "/trainee/T01");
  EXPECT_EQ(head.query, "x=1&y=%20?z");
  EXPECT_EQ(head.header("host"), "127.0.0.1:8642");
  EXPECT_EQ(head.header("cookie"), "a=1; b=2");
  EXPECT_EQ(head.content_length, 12U);
  EXPECT_EQ(head.header("absent"), "");
}

TEST(RequestHead, RefusesRequestLines) {
  for (const char* line :
       {"", "GET", "GET /", "GET  / HTTP/1.1", "GET / HTTP/1.1 ", "GET x HTTP/1.1", "GET http://evil.example/ HTTP/1.1",
        "GET * HTTP/1.1", "G(T / HTTP/1.1", "GET /a b HTTP/1.1", "GET /\xC3\xA4 HTTP/1.1", "GET /a#b HTTP/1.1",
        "GET / FTP/1.1", "GET / http/1.1", "VERYLONGMETHODNAME / HTTP/1.1"}) {
    EXPECT_EQ(status_with("", line), 400) << line;
  }
  for (const char* line : {"GET / HTTP/2.0", "GET / HTTP/1.2", "GET / HTTP/"})
    EXPECT_EQ(status_with("", line), 505) << line;
  EXPECT_EQ(status_with("", "GET /" + std::string(1023, 'a') + " HTTP/1.1"), 200);
  EXPECT_EQ(status_with("", "GET /" + std::string(1024, 'a') + " HTTP/1.1"), 414);
}

TEST(RequestHead, RefusesHeadersThatSmuggle) {
  for (const char* headers :
       {"Host: other\r\n", "Content-Length: 1\r\nContent-Length: 2\r\n", "Content-Length : 1\r\n", " folded: 1\r\n",
        "a: 1\r\n b\r\n", "no colon\r\n", ": empty\r\n", "a: \x01\r\n", "a: b\nc: d\r\n", "a: b\rc\r\n",
        "Content-Length: +1\r\n", "Content-Length: 1a\r\n", "Content-Length: -1\r\n", "Content-Length: \r\n",
        "Content-Length: 1, 1\r\n", "Origin: a\r\nOrigin: b\r\n"}) {
    EXPECT_EQ(status_with(headers), 400) << headers;
  }
  EXPECT_EQ(status_with(std::string("a: b\0c\r\n", 8)), 400);
  EXPECT_EQ(status_with("Transfer-Encoding: chunked\r\n"), 411);
  EXPECT_EQ(status_with("Transfer-Encoding: chunked\r\nContent-Length: 3\r\n"), 411);
  EXPECT_EQ(status_with("Content-Encoding: gzip\r\n"), 415);
  EXPECT_EQ(status_with("Content-Encoding: identity\r\n"), 200);
  EXPECT_EQ(status_of("GET / HTTP/1.1\r\n\r\n"), 400) << "no host";
  EXPECT_EQ(status_of("GET / HTTP/1.1\nHost: desk\n\n"), 400) << "bare line feeds";
  EXPECT_EQ(status_of("\r\n"), 400);
}

TEST(RequestHead, HoldsToLimits) {
  EXPECT_EQ(status_with("Content-Length: 1048576\r\n"), 200);
  EXPECT_EQ(status_with("Content-Length: 1048577\r\n"), 413);
  EXPECT_EQ(status_with("Content-Length: 99999999999999999999999999\r\n"), 413);
  EXPECT_EQ(status_with("", "POST / HTTP/1.1"), 411) << "what is posted tells its length";
  std::string many;
  for (int i = 0; i < 63; ++i) many += "h" + std::to_string(i) + ": 1\r\n";
  EXPECT_EQ(status_with(many), 200);
  EXPECT_EQ(status_with(many + "last: 1\r\n"), 431);
  EXPECT_EQ(status_with("a: " + std::string(9000, 'x') + "\r\n"), 431);
}

TEST(RequestHead, SurvivesRandomBytes) {
  const std::string whole = "POST /a?b=c HTTP/1.1\r\nHost: desk\r\nContent-Length: 3\r\nCookie: a=b\r\n\r\n";
  std::mt19937 random(11);
  int read = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text = whole;
    for (unsigned i = 0; i <= random() % 4; ++i) text[random() % text.size()] = static_cast<char>(random());
    const auto parsed = parse_head(text);
    const auto* head = std::get_if<RequestHead>(&parsed);
    if (!head) continue;
    ++read;
    EXPECT_TRUE(head->path.starts_with('/'));
    EXPECT_LE(head->content_length, RequestLimits{}.body_bytes);
  }
  EXPECT_GT(read, 1000) << "the test must also see heads that are read";
}

}  // namespace
}  // namespace trocar::review::request_head_test
