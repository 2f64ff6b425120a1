// Many random requests against a live desk: none brings it down, none is answered with an error of the program, none
// shows a trainee what is another's, and the database is sound afterwards. DESK_REQUESTS says how many; 100000 under
// the label long.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "tests/support/repeats.h"
#include "tests/trainees/desk/server/live_desk.h"
#include "trainees/desk/server/url_text.h"

namespace trocar::review::desk_random_test {
namespace {

const int kRequests = test::repeats("DESK_REQUESTS", 2000);

class RequestMaker {
 public:
  RequestMaker(std::uint64_t seed, int port, std::vector<std::string> paths, std::vector<Visitor> visitors,
               std::string attempt)
      : random_(seed),
        port_(port),
        paths_(std::move(paths)),
        visitors_(std::move(visitors)),
        attempt_(std::move(attempt)) {}

  std::string next() {
    visitor_ = draw(visitors_.size());
    const Visitor& visitor = visitors_[visitor_];
    const std::string path = target();
    std::string out;
    if (chance(4)) {
      std::string form = fields();
      if (chance(2)) form += "&token=" + percent_encoded(visitor.token);
      out = raw_post(port_, path, visitor.cookie, form);
    } else {
      out = raw_get(port_, path, visitor.cookie, chance(10) ? pick(kMethods) : "GET");
    }
    if (chance(5)) out.insert(out.find("\r\n") + 2, odd_header());
    if (chance(10)) spoil(out);
    return out;
  }
  /// Number of the visitor who sends the newest request.
  std::size_t visitor() const { return visitor_; }

 private:
  std::uint64_t draw(std::uint64_t below) { return random_() % below; }
  bool chance(std::uint64_t one_in) { return draw(one_in) == 0; }
  template <class T>
  const T& pick(const std::vector<T>& all) {
    return all[draw(all.size())];
  }

  std::string word() {
    switch (draw(4)) {
      case 0:
        return pick(kWords);
      case 1:
        return std::to_string(static_cast<std::int64_t>(random_()));
      case 2:
        return percent_encoded(pick(kWords));
      default: {
        std::string bytes;
        for (std::uint64_t i = draw(30); i > 0; --i) bytes += static_cast<char>(random_());
        return percent_encoded(bytes);
      }
    }
  }

  std::string target() {
    std::string out;
    const std::string path = pick(paths_);
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (path[i] != '{') {
        out += path[i];
        continue;
      }
      const std::size_t end = path.find('}', i);
      const std::string name = path.substr(i + 1, end - i - 1);
      out += chance(3) ? word() : name == "code" ? "T-anna" : name == "attempt" || name == "other" ? attempt_ : "1";
      i = end;
    }
    if (chance(20)) out = "/" + word() + "/" + word();
    if (chance(2)) out += "?" + fields();
    return out;
  }

  std::string fields() {
    std::string out;
    for (std::uint64_t i = draw(6); i > 0; --i)
      out += (out.empty() ? "" : "&") + (chance(5) ? word() : pick(kFields)) + "=" + word();
    return out;
  }

  std::string odd_header() {
    return pick(std::vector<std::string>{
        "Range: bytes=0-,0-,0-\r\n", "Accept-Encoding: gzip, br\r\n", "Expect: 100-continue\r\n",
        "Connection: Upgrade\r\n", "Upgrade: websocket\r\n", "X-HTTP-Method-Override: DELETE\r\n",
        "X-Forwarded-For: 127.0.0.1\r\n", "X-Original-URL: /admin\r\n", "Content-Length: 3\r\n",
        "Transfer-Encoding: chunked\r\n", "Cookie: a=b\r\n", "Host: evil.example\r\n",
        "Origin: http://evil.example\r\n", "If-None-Match: *\r\n"});
  }

  void spoil(std::string& bytes) {
    for (std::uint64_t i = draw(5); i > 0 && !bytes.empty(); --i) {
      const std::size_t at = draw(bytes.size());
      if (chance(3))
        bytes.erase(at, draw(20));
      else if (chance(2))
        bytes[at] = static_cast<char>(random_());
      else
        bytes.insert(at, pick(kWords));
    }
  }

  const std::vector<std::string> kMethods{"HEAD", "PUT", "DELETE", "OPTIONS", "TRACE", "PATCH", "POST", "get", "\xff"};
  const std::vector<std::string> kFields{"group",    "exercise", "level", "state",   "sort",   "page",  "limit",
                                         "with",     "from",     "to",    "text",    "reason", "name",  "login",
                                         "password", "next",     "code",  "attempt", "toml",   "token", "passed",
                                         "metric",   "t",        "width", "format"};
  const std::vector<std::string> kWords{
      "T-anna",        "..",      "%2e%2e%2f", "%00",      "%", "'",  "\"",    "' OR 1=1 --", "<script>",
      "surface-touch", "L1",      "latest",    "\r\nX: y", "0", "-1", "1e309", "NaN",         "9999999999999999999",
      "2026-11-22",    "",        "csv",       "pdf",      "/", "\\", "{}",    "&&&",         "a=b",
      "\xc3\xa4",      "csv.csv", "new"};
  std::mt19937_64 random_;
  int port_;
  std::vector<std::string> paths_;
  std::vector<Visitor> visitors_;
  std::string attempt_;
  std::size_t visitor_ = 0;
};

class DeskRandom : public LiveDesk {};

TEST_F(DeskRandom, RandomRequests) {
  add_accounts();
  DeskServerOptions given = options();
  std::vector<std::string> paths{"/sign-in"};  // not out: the visitors stay
  for (const Route& route : given.routes) {
    if (!route.path.starts_with("/fails/")) paths.push_back(route.path);  // those are to fail
  }
  std::vector<std::string> said;
  std::mutex mutex;
  given.log = [&](const std::string& line) {
    const std::scoped_lock lock(mutex);
    if (!line.starts_with("sign") && said.size() < 20) said.push_back(line);
  };
  given.limits.head_ms = given.limits.body_ms = 300;  // spoiled requests are cut off soon
  serve(std::move(given));
  const std::string ottos = AccountStore(database_).find("otto")->uuid;
  const Visitor nobody{}, anna = signed_in_there("anna"), ines = signed_in_there("ines"),
                          adam = signed_in_there("adam");
  RequestMaker maker(20261122, port(), paths, {ines, adam, nobody, anna, anna, anna}, annas_);
  constexpr std::size_t kStaff = 2;  // of the visitors
  std::map<int, int> count, of_anna;
  for (int i = 0; i < kRequests; ++i) {
    const std::string request = maker.next(), raw = raw_answer(port(), request, 10000, true);
    ++count[status_of(raw)];
    ASSERT_NE(status_of(raw), 500) << request;
    ASSERT_EQ(raw.find("argon2"), std::string::npos) << request;
    if (maker.visitor() < kStaff) continue;
    of_anna[status_of(raw)] += maker.visitor() > kStaff;
    for (const std::string& secret :
         {std::string("T-otto"), ottos_, ottos, std::string("zebra-7431"), folder_.string()}) {
      ASSERT_EQ(raw.find(secret), std::string::npos) << request << "\n" << raw;
    }
  }
  EXPECT_GT(of_anna[200], kRequests / 100) << "a trainee who sees nothing would see nothing of others either";
  for (const auto& [status, times] : count) RecordProperty("status_" + std::to_string(status), times);
  EXPECT_EQ(said, std::vector<std::string>{});
  for (const int status : {200, 400, 401, 403, 404})
    EXPECT_GT(count[status], 0) << "the requests must reach every part: " << status;
  EXPECT_EQ(get("/everybody"), 200);
  server_->stop();
  EXPECT_EQ(database_.check(), std::vector<std::string>{});
  EXPECT_EQ(AttemptStore(database_).list().size(), 4U);
}

}  // namespace
}  // namespace trocar::review::desk_random_test
