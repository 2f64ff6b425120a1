// Reading a request from a connection: in any pieces, within limits, and never longer than it may take.
#include "trainees/desk/server/connection.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <thread>

namespace trocar::review::connection_test {
namespace {

using std::chrono::milliseconds;

/// Two ends of a TCP connection on this machine: `ours` is read by the code under test.
class ConnectionTest : public testing::Test {
 protected:
  ConnectionTest() {
    const int listener = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof at;
    ::bind(listener, reinterpret_cast<sockaddr*>(&at), size);
    ::listen(listener, 1);
    ::getsockname(listener, reinterpret_cast<sockaddr*>(&at), &size);
    theirs_ = ::socket(AF_INET, SOCK_STREAM, 0);
    EXPECT_EQ(::connect(theirs_, reinterpret_cast<sockaddr*>(&at), size), 0);
    ours_ = std::make_unique<Connection>(::accept(listener, nullptr, nullptr), nullptr, stop_);
    ::close(listener);
  }
  ~ConnectionTest() override { hang_up(); }

  void say(const std::string& bytes) const {
    EXPECT_EQ(::send(theirs_, bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
  }
  void hang_up() {
    if (theirs_ >= 0) ::close(theirs_);
    theirs_ = -1;
  }
  static Deadline in(int ms) { return std::chrono::steady_clock::now() + milliseconds(ms); }
  int refusal(const RequestLimits& limits = {}) {
    const auto received = receive_request(*ours_, limits);
    const auto* refused = std::get_if<Refusal>(&received);
    return refused ? refused->status : 200;
  }

  std::atomic<bool> stop_{false};
  int theirs_ = -1;
  std::unique_ptr<Connection> ours_;
};

constexpr const char* kPost = "POST /note HTTP/1.1\r\nHost: desk\r\nContent-Length: 9\r\n\r\n";

TEST_F(ConnectionTest, ReadsARequestInOnePiece) {
  say(std::string(kPost) + "text=hurt");
  const auto received = receive_request(*ours_, {});
  ASSERT_TRUE(std::holds_alternative<ReceivedRequest>(received));
  EXPECT_EQ(std::get<ReceivedRequest>(received).head.path, "/note");
  EXPECT_EQ(std::get<ReceivedRequest>(received).body, "text=hurt");
}

TEST_F(ConnectionTest, ReadsARequestByteByByte) {
  std::thread sender([&] {
    for (const char c : std::string(kPost) + "text=hurt") say(std::string(1, c));
  });
  const auto received = receive_request(*ours_, {});
  sender.join();
  ASSERT_TRUE(std::holds_alternative<ReceivedRequest>(received));
  EXPECT_EQ(std::get<ReceivedRequest>(received).body, "text=hurt");
}

TEST_F(ConnectionTest, ReadsNoFurtherThanTheBody) {
  say(std::string(kPost) + "text=hurtGET /admin HTTP/1.1\r\n\r\n");
  const auto received = receive_request(*ours_, {});
  ASSERT_TRUE(std::holds_alternative<ReceivedRequest>(received));
  EXPECT_EQ(std::get<ReceivedRequest>(received).body, "text=hurt");
}

TEST_F(ConnectionTest, SaysNothingToWhoSaysNothing) {
  EXPECT_EQ(refusal({.head_ms = 50}), 0);
  hang_up();
  EXPECT_EQ(refusal(), 0);
}

TEST_F(ConnectionTest, IsSilentWhenTheOtherEndsHalfway) {
  say("GET / HTTP/1.1\r\nHo");
  hang_up();
  EXPECT_EQ(refusal(), 0);
}

TEST_F(ConnectionTest, IsSilentWhenTheBodyEndsHalfway) {
  say(std::string(kPost) + "text");
  hang_up();
  EXPECT_EQ(refusal(), 0);
}

TEST_F(ConnectionTest, CutsOffLateHeads) {
  say("GET / HTTP/1.1\r\n");
  EXPECT_EQ(refusal({.head_ms = 50}), 408);
}

TEST_F(ConnectionTest, CutsOffLateBodies) {
  say(std::string(kPost) + "text");
  EXPECT_EQ(refusal({.body_ms = 50}), 408);
}

TEST_F(ConnectionTest, HeadsHaveAnEnd) {
  say("GET / HTTP/1.1\r\na: " + std::string(20000, 'x'));
  EXPECT_EQ(refusal(), 431);
}

TEST_F(ConnectionTest, BodiesAreNotAwaitedWhenTheyAreTooLarge) {
  say("POST / HTTP/1.1\r\nHost: desk\r\nContent-Length: 100\r\n\r\n");
  EXPECT_EQ(refusal({.body_bytes = 99}), 413);
}

TEST_F(ConnectionTest, StopsWhenToldTo) {
  std::thread stopper([&] { stop_ = true; });
  EXPECT_EQ(refusal({.head_ms = 600000}), 0);
  stopper.join();
  EXPECT_FALSE(ours_->write("x", 1, in(-1))) << "a deadline that is over";
}

TEST_F(ConnectionTest, WritesUntilItIsLate) {
  const std::string much(64U << 20U, 'x');  // more than the machine buffers
  EXPECT_FALSE(ours_->write(much.data(), much.size(), in(100))) << "nobody reads";
  hang_up();
  EXPECT_FALSE(ours_->write(much.data(), much.size(), in(10000))) << "nobody is there";
}

TEST_F(ConnectionTest, AnswersArriveAlthoughMoreIsOnItsWay) {
  say("GET / HTTP/1.1\r\nHost: desk\r\n\r\nand much that nobody asked for");
  EXPECT_EQ(refusal(), 200);
  EXPECT_TRUE(ours_->write("answer", 6, in(1000)));
  std::thread finisher([&] {
    ours_->finish();
    ours_.reset();
  });
  std::string got;
  char piece[64];
  for (ssize_t count = 0; (count = ::recv(theirs_, piece, sizeof piece, 0)) > 0;)
    got.append(piece, static_cast<std::size_t>(count));
  hang_up();
  finisher.join();
  EXPECT_EQ(got, "answer");
}

TEST_F(ConnectionTest, KnowsBothEnds) {
  EXPECT_EQ(ours_->remote_address(), "127.0.0.1");
  EXPECT_EQ(ours_->local_address(), "127.0.0.1");
  EXPECT_EQ(ours_->same_user(), ::access("/proc/net/tcp", R_OK) == 0);
  hang_up();
  EXPECT_FALSE(ours_->same_user()) << "a closed socket belongs to nobody";
}

}  // namespace
}  // namespace trocar::review::connection_test
