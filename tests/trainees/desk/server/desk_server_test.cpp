// The desk on a loopback port: what a browser gets, and what comes of requests that are too large, too slow, or not
// requests at all.
#include "trainees/desk/server/desk_server.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/trainees/desk/server/live_desk.h"
#include "trainees/desk/server/page_workers.h"

namespace trocar::review::desk_server_test {
namespace {

class DeskServerTest : public LiveDesk {
 protected:
  int sent(const std::string& bytes) { return status_of(raw_answer(port(), bytes)); }
  std::string host() const { return "Host: 127.0.0.1:" + std::to_string(port()) + "\r\n"; }
};

TEST_F(DeskServerTest, AnswersAndCloses) {
  serve(options());
  EXPECT_EQ(server_->addresses(), std::vector<std::string>{"http://127.0.0.1:" + std::to_string(port()) + "/"});
  const std::string raw = raw_answer(port(), raw_get(port(), "/everybody") + raw_get(port(), "/everybody"));
  EXPECT_TRUE(raw.starts_with("HTTP/1.1 200 OK\r\n")) << raw;
  EXPECT_TRUE(raw.ends_with("\r\n\r\npage for everybody\n")) << "one request a connection: " << raw;
  EXPECT_EQ(raw_header(raw, "Content-Length"), "19");
  EXPECT_EQ(raw_header(raw, "Content-Type"), "text/plain");
  EXPECT_EQ(raw_header(raw, "Connection"), "close");
  EXPECT_EQ(raw_header(raw, "X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(raw_header(raw, "Server"), "");
}

TEST_F(DeskServerTest, TellsHowLongThePageTook) {
  serve(options());
  for (const char* path : {"/everybody", "/nothing-here"}) {
    const std::string timing = raw_header(raw_answer(port(), raw_get(port(), path)), "Server-Timing");
    ASSERT_TRUE(timing.starts_with("page;dur=")) << timing;
    std::size_t read = 0;
    EXPECT_GE(std::stod(timing.substr(9), &read), 0);
    EXPECT_EQ(read, timing.size() - 9) << "a number, in ms: " << timing;
  }
}

TEST_F(DeskServerTest, AnswersHeadWithoutBody) {
  serve(options());
  const std::string raw = raw_answer(port(), raw_get(port(), "/everybody", "", "HEAD"));
  EXPECT_TRUE(raw.starts_with("HTTP/1.1 200 OK\r\n")) << raw;
  EXPECT_EQ(raw_header(raw, "Content-Length"), "19");
  EXPECT_TRUE(raw.ends_with("\r\n\r\n")) << raw;
}

TEST_F(DeskServerTest, SignsInThroughTheNetwork) {
  add_accounts();
  serve(options());
  const Visitor ines = signed_in_there("ines");
  EXPECT_EQ(get("/staff/x"), 401);
  EXPECT_EQ(get("/staff/x", ines.cookie), 200);
  EXPECT_EQ(get("/admin", ines.cookie), 403);
  EXPECT_EQ(sent(raw_post(port(), "/staff/x", ines.cookie, "token=" + ines.token)), 200);
  EXPECT_EQ(sent(raw_post(port(), "/staff/x", ines.cookie, "")), 403);
}

TEST_F(DeskServerTest, LetsItsOwnUserInWithoutAccount) {
  serve(options());
  EXPECT_EQ(get("/admin"), 200) << "this test is the user who started it";
  EXPECT_EQ(status_of(raw_answer(port(), raw_get(port(), "/admin"), 10000, true)), 401)
      << "whose an ended connection is Linux does not tell";
}

TEST_F(DeskServerTest, ServesNoFiles) {
  serve(options());
  for (const char* path : {"/../../../../etc/passwd", "/..%2f..%2f..%2fetc/passwd", "/%2e%2e/%2e%2e/etc/passwd",
                           "/desk.db", "/etc/passwd", "/%00", "/.", "/.."}) {
    const std::string raw = raw_answer(port(), raw_get(port(), path));
    EXPECT_EQ(status_of(raw), 404) << path;
    EXPECT_EQ(raw.find("root:"), std::string::npos);
  }
}

TEST_F(DeskServerTest, RefusesWhatIsTooLarge) {
  serve(options());
  EXPECT_EQ(get("/" + std::string(1100, 'a')), 414);
  EXPECT_EQ(get("/" + std::string(9000, 'a')), 431);
  std::string many = "GET / HTTP/1.1\r\n" + host();
  for (int i = 0; i < 200; ++i) many += "h" + std::to_string(i) + ": 1\r\n";
  EXPECT_EQ(sent(many + "\r\n"), 431);
  EXPECT_EQ(sent("GET / HTTP/1.1\r\n" + host() + "a: " + std::string(100000, 'x')), 431) << "a head without end";
  EXPECT_EQ(sent(raw_post(port(), "/everybody", "", std::string((1U << 20U) + 1, 'x'))), 413)
      << "the answer arrives although the body is still on its way";
  EXPECT_EQ(sent(raw_post(port(), "/everybody", "", "a=" + std::string((1U << 20U) - 2, 'x'))), 403)
      << "1 MB is read, the token is missing";
  EXPECT_EQ(get("/everybody"), 200);
}

TEST_F(DeskServerTest, RefusesWhatCannotBeRead) {
  serve(options());
  EXPECT_EQ(sent("\r\n\r\n"), 400);
  EXPECT_EQ(sent(std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\r\n\r\n", 15)), 400)
      << "TLS to a plain port";
  EXPECT_EQ(sent("GET / HTTP/1.1\r\n\r\n"), 400);
  EXPECT_EQ(sent("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n"), 421);
  EXPECT_EQ(sent("POST /everybody HTTP/1.1\r\n" + host() + "Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n"), 411);
  EXPECT_EQ(sent("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"), 505);
  EXPECT_EQ(raw_answer(port(), "GET / HT", 10000, true), "") << "half a request is none";
}

TEST_F(DeskServerTest, CutsOffWhoDribbles) {
  DeskServerOptions given = options();
  given.limits.head_ms = 400;
  given.limits.body_ms = 400;
  serve(std::move(given));
  SlowVisitor head(port()), body(port()), silent(port());
  EXPECT_TRUE(body.send("POST /everybody HTTP/1.1\r\n" + host() + "Content-Length: 100000\r\n\r\n"));
  std::atomic<bool> over{false};
  std::thread dribbles([&] {
    for (int i = 0; i < 1000 && !over; ++i) {
      head.send(i == 0 ? "GET / HTTP/1.1\r\na: " : "x");
      body.send("y");
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
  EXPECT_EQ(status_of(head.rest()), 408);
  EXPECT_EQ(status_of(body.rest()), 408);
  EXPECT_EQ(silent.rest(), "") << "who says nothing is told nothing";
  over = true;
  dribbles.join();
}

TEST_F(DeskServerTest, DribblersTakeTheirOwnPlacesOnly) {
  serve(options());  // 5 s for a head
  std::vector<std::unique_ptr<SlowVisitor>> visitors;
  for (int i = 0; i < 200; ++i) {
    visitors.push_back(std::make_unique<SlowVisitor>(port(), "127.0.0.2"));
    visitors.back()->send("GET / HTTP/1.1\r\na: ");
  }
  for (int i = 0; i < 10; ++i) EXPECT_EQ(get("/everybody"), 200);
}

/// Half-open connections, from as many addresses as it takes, and from the reader's own.
TEST_F(DeskServerTest, PagesComeAtOnceWhileManyConnectionsAreSlow) {
  serve(options());
  std::vector<std::unique_ptr<SlowVisitor>> visitors;
  for (int i = 0; i < 144; ++i) {
    const std::string from = "127.0.0." + std::to_string(1 + i % 9);
    visitors.push_back(std::make_unique<SlowVisitor>(port(), from.c_str()));
    if (i % 2 == 0) visitors.back()->send("GET / HTTP/1.1\r\na: ");
    if (i % 3 == 0) visitors.back()->send("x\r\nHost: a\r\nContent-Length: 500000\r\n\r\n");
  }
  for (int i = 0; i < 10; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(get("/everybody"), 200);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(300));
  }
}

TEST_F(DeskServerTest, StopsWhileSomebodyDribbles) {
  serve(options());
  SlowVisitor visitor(port());
  visitor.send("GET / HTTP/1.1\r\n");
  const int before = port();
  server_->stop();
  EXPECT_EQ(raw_answer(before, raw_get(before, "/everybody"), 200), "");
  server_->stop();  // twice is once
}

TEST_F(DeskServerTest, SaysWhyItCannotStart) {
  serve(options());
  DeskServerOptions second = options();
  second.port = port();
  const std::string taken = message_of<EnvironmentError>([&] { DeskServer(std::move(second)); });
  EXPECT_NE(taken.find("port " + std::to_string(port())), std::string::npos) << taken;
  EXPECT_NE(taken.find("--port"), std::string::npos) << "says what to do";
  DeskServerOptions open = options();
  open.lan = true;
  const std::string nobody = message_of<InputError>([&] { DeskServer(std::move(open)); });
  EXPECT_NE(nobody.find("trocar review account add"), std::string::npos) << nobody;
  DeskServerOptions half = options();
  half.certificate = file_;
  EXPECT_NE(message_of<InputError>([&] { DeskServer(std::move(half)); }).find("give both"), std::string::npos);
  DeskServerOptions missing = options();
  missing.open = [] { return Database("/nowhere/at/all.db", OpenMode::kExisting); };
  EXPECT_NE(message_of<EnvironmentError>([&] { DeskServer(std::move(missing)); }), "");
}

TEST_F(DeskServerTest, OnTheNetworkItAsksEverybody) {
  add_accounts();
  DeskServerOptions open = options();
  open.lan = true;
  serve(std::move(open));
  EXPECT_EQ(get("/admin"), 401);
  EXPECT_GE(server_->addresses().size(), 1U);
}

TEST_F(DeskServerTest, ManyAtOnceAllGetTheirOwn) {
  add_accounts();
  serve(options());
  const Visitor anna = signed_in_there("anna"), ines = signed_in_there("ines");
  std::atomic<int> wrong{0};
  std::vector<std::thread> browsers;
  for (int b = 0; b < 6; ++b) {
    browsers.emplace_back([&, b] {
      const bool trainee = b % 2 == 0;
      for (int i = 0; i < 40; ++i) {
        const std::string raw = raw_answer(port(), raw_get(port(), "/own/T-anna", trainee ? anna.cookie : ines.cookie));
        wrong += !raw.ends_with(trainee ? "page for anna\n" : "page for ines\n");
      }
    });
  }
  for (std::thread& browser : browsers) browser.join();
  EXPECT_EQ(wrong, 0);
}

TEST_F(DeskServerTest, AClassSignsInTogether) {
  add_accounts();
  serve(options());
  std::atomic<int> in{0};
  std::vector<std::thread> browsers;
  for (int b = 0; b < 12; ++b) browsers.emplace_back([&] { in += signed_in_there("anna").cookie.empty() ? 0 : 1; });
  for (std::thread& browser : browsers) browser.join();
  EXPECT_EQ(in, 12) << "each waits its turn";
}

TEST_F(DeskServerTest, PageThreadsHandBackErrorsAndEnd) {
  int opened = 0;
  PageWorkers workers(
      3, [&] { return ++opened, Database(file_); }, {}, true);
  EXPECT_EQ(opened, 3) << "a database each";
  EXPECT_THROW(workers.run("", [](Desk*) { throw std::out_of_range("x"); }), std::out_of_range);
  bool demo = false;
  workers.run("", [&](Desk* desk) { demo = desk->demo; });
  EXPECT_TRUE(demo);
  int count = 0;
  const auto second_fails = [&]() -> Database {
    return ++count == 2 ? throw EnvironmentError("full") : Database(file_);
  };
  EXPECT_THROW(PageWorkers(3, second_fails, {}, false), EnvironmentError);
}

TEST_F(DeskServerTest, WhoAsksOftenKeepsNobodyWaiting) {
  PageWorkers workers(
      1, [&] { return Database(file_); }, {}, false);
  std::promise<void> begun, made;
  workers.give("anna", [&](Desk*) {
    begun.set_value();
    made.get_future().wait();
  });
  begun.get_future().wait();
  std::string served;
  std::size_t refused = 0;
  const auto give = [&](const std::string& who) {
    workers.give(who, [&, who](Desk* desk) {
      if (desk != nullptr)
        served += who.front();
      else
        ++refused;
    });
  };
  for (int i = 0; i < 100; ++i) give("anna");
  for (const char* who : {"otto", "ines", "otto"}) give(who);
  for (int i = 0; i < 200; ++i) give("anna");
  EXPECT_EQ(refused, 303 - PageWorkers::kMostWaiting);
  made.set_value();
  workers.finish();
  give("late");
  EXPECT_EQ(served.substr(0, 7), "aoiaoaa") << "one of each in a round";
  EXPECT_EQ(served.size(), PageWorkers::kMostWaiting);
  EXPECT_EQ(served.find('l'), std::string::npos);
}

TEST_F(DeskServerTest, APageWaitsForOneOfEachOtherVisitor) {
  add_accounts();
  std::mutex busy;
  std::atomic<int> begun{0};
  DeskServerOptions slow = options();
  slow.page_threads = 1;
  slow.routes.push_back(
      {.method = "GET", .path = "/heavy/{code}", .audience = Audience::kOwnData, .answer = [&](const Request&, Desk&) {
         ++begun;
         const std::scoped_lock held(busy);
         std::this_thread::sleep_for(std::chrono::milliseconds(20));
         return Response{.body = "heavy"};
       }});
  serve(std::move(slow));
  const Visitor anna = signed_in_there("anna"), ines = signed_in_there("ines");
  std::vector<std::unique_ptr<SlowVisitor>> tabs;
  std::unique_lock closed(busy);
  for (int i = 0; i < 14 * 3; ++i) {
    const std::string from = "127.0.0." + std::to_string(2 + i % 3);
    tabs.push_back(std::make_unique<SlowVisitor>(port(), from.c_str()));
    tabs.back()->send(raw_get(port(), "/heavy/T-anna", anna.cookie));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // one is being made, the others wait
  EXPECT_EQ(begun, 1);
  std::atomic<int> before_hers{99}, before_stranger{99};
  std::thread hers([&] {
    if (get("/staff/x", ines.cookie) == 200) before_hers = begun.load();
  });
  std::thread stranger([&] {
    if (get("/sign-in") == 200) before_stranger = begun.load();
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  closed.unlock();
  hers.join();
  stranger.join();
  EXPECT_LT(before_hers, 14);
  EXPECT_LT(before_stranger, 14);
  server_->stop();  // what is still made uses what stands here
}

}  // namespace
}  // namespace trocar::review::desk_server_test
