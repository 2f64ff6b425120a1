// Waiting for the network: requests in any pieces, within limits, and never longer than they may take; answers that
// arrive; and places that the slow yield to others.
#include "trainees/desk/server/waiting_room.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

namespace trocar::review::waiting_room_test {
namespace {

using std::chrono::milliseconds;

constexpr const char* kGet = "GET / HTTP/1.1\r\nHost: desk\r\n\r\n";

/// A room that listens on a loopback port, and one visitor who has just come.
class WaitingRoomTest : public testing::Test {
 protected:
  WaitingRoomTest() {
    listener_ = ::socket(AF_INET, SOCK_STREAM, 0);
    at_.sin_family = AF_INET;
    at_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof at_;
    ::bind(listener_, reinterpret_cast<sockaddr*>(&at_), size);
    ::listen(listener_, 64);
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&at_), &size);
  }
  ~WaitingRoomTest() override {
    room_.reset();
    for (const int socket : theirs_) ::close(socket);
    ::close(listener_);
  }

  void open(const RoomLimits& limits = {}) {
    room_ = std::make_unique<WaitingRoom>(limits, [this](std::shared_ptr<Connection> connection, Received received) {
      ++served_;
      const std::scoped_lock lock(mutex_);
      whole_.emplace_back(std::move(connection), std::move(received));
      came_.notify_one();
    });
  }
  /// @param from address on this machine. @returns the visitor's number.
  std::size_t come(const char* from = "127.0.0.1") {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in mine{};
    mine.sin_family = AF_INET;
    ::inet_pton(AF_INET, from, &mine.sin_addr);
    ::bind(socket, reinterpret_cast<sockaddr*>(&mine), sizeof mine);
    EXPECT_EQ(::connect(socket, reinterpret_cast<sockaddr*>(&at_), sizeof at_), 0);
    room_->enter(std::make_shared<Connection>(::accept(listener_, nullptr, nullptr), nullptr));
    theirs_.push_back(socket);
    return theirs_.size() - 1;
  }
  void say(const std::string& bytes, std::size_t who = 0) const {
    EXPECT_EQ(::send(theirs_[who], bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
  }
  void hang_up() const { ::shutdown(theirs_[0], SHUT_RDWR); }
  /// All until the other side ends it.
  std::string rest(std::size_t who = 0) const {
    std::string out;
    char piece[4096];
    for (ssize_t count = 0; (count = ::recv(theirs_[who], piece, sizeof piece, 0)) > 0;)
      out.append(piece, static_cast<std::size_t>(count));
    return out;
  }
  /// The next request; last_ is its connection.
  Received received() {
    std::unique_lock lock(mutex_);
    came_.wait(lock, [&] { return !whole_.empty(); });
    Received out = std::move(whole_.front().second);
    last_ = std::move(whole_.front().first);
    whole_.pop_front();
    return out;
  }
  /// A visitor who asks, is answered with more than the machine buffers, and takes nothing of it.
  std::size_t stand(const char* from) {
    const std::size_t who = come(from);
    say(kGet, who);
    received();
    room_->send(std::move(last_), std::string(64U << 20U, 'x'));
    return who;
  }
  /// Status of the refusal, 200 for a request. @param words that the visitor says; then it ends, or does not.
  int refusal(const std::string& words, const RequestLimits& limits = {}, bool ends = false) {
    RoomLimits given;
    given.request = limits;
    open(given);
    come();
    if (!words.empty()) say(words);
    if (ends) hang_up();
    const Received got = received();
    const auto* refused = std::get_if<Refusal>(&got);
    return refused ? refused->status : 200;
  }

  int listener_ = -1;
  sockaddr_in at_{};
  std::vector<int> theirs_;
  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<std::pair<std::shared_ptr<Connection>, Received>> whole_;
  std::shared_ptr<Connection> last_;
  std::atomic<int> served_{0};
  std::unique_ptr<WaitingRoom> room_;
};

constexpr const char* kPost = "POST /note HTTP/1.1\r\nHost: desk\r\nContent-Length: 9\r\n\r\n";

TEST_F(WaitingRoomTest, ReadsARequestInOnePiece) {
  open();
  come();
  say(std::string(kPost) + "text=hurt");
  const auto got = std::get<ReceivedRequest>(received());
  EXPECT_EQ(got.head.path, "/note");
  EXPECT_EQ(got.body, "text=hurt");
}

TEST_F(WaitingRoomTest, ReadsARequestByteByByte) {
  open();
  come();
  for (const char c : std::string(kPost) + "text=hurt") say(std::string(1, c));
  EXPECT_EQ(std::get<ReceivedRequest>(received()).body, "text=hurt");
}

TEST_F(WaitingRoomTest, ReadsNoFurtherThanTheBody) {
  open();
  come();
  say(std::string(kPost) + "text=hurtGET /admin HTTP/1.1\r\n\r\n");
  EXPECT_EQ(std::get<ReceivedRequest>(received()).body, "text=hurt");
}

TEST_F(WaitingRoomTest, SaysNothingToWhoSaysNothing) { EXPECT_EQ(refusal("", {.head_ms = 50}), 0); }
TEST_F(WaitingRoomTest, SaysNothingToWhoLeaves) { EXPECT_EQ(refusal("", {}, true), 0); }
TEST_F(WaitingRoomTest, IsSilentWhenTheOtherEndsHalfway) { EXPECT_EQ(refusal("GET / HTTP/1.1\r\nHo", {}, true), 0); }
TEST_F(WaitingRoomTest, IsSilentWhenTheBodyEndsHalfway) {
  EXPECT_EQ(refusal(std::string(kPost) + "text", {}, true), 0);
}
TEST_F(WaitingRoomTest, CutsOffLateHeads) { EXPECT_EQ(refusal("GET / HTTP/1.1\r\n", {.head_ms = 50}), 408); }
TEST_F(WaitingRoomTest, CutsOffLateBodies) { EXPECT_EQ(refusal(std::string(kPost) + "text", {.body_ms = 50}), 408); }
TEST_F(WaitingRoomTest, HeadsHaveAnEnd) { EXPECT_EQ(refusal("GET / HTTP/1.1\r\na: " + std::string(20000, 'x')), 431); }
TEST_F(WaitingRoomTest, BodiesAreNotAwaitedWhenTheyAreTooLarge) {
  EXPECT_EQ(refusal("POST / HTTP/1.1\r\nHost: desk\r\nContent-Length: 100\r\n\r\n", {.body_bytes = 99}), 413);
}

TEST_F(WaitingRoomTest, EndsWhileSomebodyWaits) {
  open();
  come();
  say("GET / HTTP/1.1\r\n");
  room_.reset();
  EXPECT_EQ(rest(), "");
}

TEST_F(WaitingRoomTest, AnswersArriveAlthoughMoreIsOnItsWay) {
  EXPECT_EQ(refusal("GET / HTTP/1.1\r\nHost: desk\r\n\r\nand much that nobody asked for"), 200);
  room_->send(std::move(last_), "answer");
  say("still more");
  EXPECT_EQ(rest(), "answer");
}

TEST_F(WaitingRoomTest, AnswersArriveWhole) {
  EXPECT_EQ(refusal("GET / HTTP/1.1\r\nHost: desk\r\n\r\n"), 200);
  room_->send(std::move(last_), std::string(64U << 20U, 'x'));  // more than the machine buffers
  EXPECT_EQ(rest().size(), 64U << 20U);
}

TEST_F(WaitingRoomTest, AnAnswerThatNobodyTakesIsGivenUp) {
  EXPECT_EQ(refusal("GET / HTTP/1.1\r\nHost: desk\r\n\r\n", {.write_ms = 100}), 200);
  room_->send(std::move(last_), std::string(64U << 20U, 'x'));
  std::this_thread::sleep_for(milliseconds(300));
  EXPECT_LT(rest().size(), 64U << 20U);
}

TEST_F(WaitingRoomTest, TheLongestWaitingOfAnAddressYields) {
  RoomLimits limits;
  limits.of_one_address = 3;
  open(limits);
  const std::size_t first = come(), second = come(), third = come(), elsewhere = come("127.0.0.2"), fourth = come();
  EXPECT_EQ(rest(first), "");
  for (const std::size_t who : {second, third, elsewhere}) say("GET / HTTP/1.1\r\n", who);
  EXPECT_EQ(served_, 0) << "the others wait on";
  say("GET / HTTP/1.1\r\nHost: desk\r\n\r\n", fourth);
  EXPECT_TRUE(std::holds_alternative<ReceivedRequest>(received()));
}

TEST_F(WaitingRoomTest, WhoIsServedDoesNotYield) {
  RoomLimits limits;
  limits.of_one_address = 1;
  open(limits);
  say("GET / HTTP/1.1\r\nHost: desk\r\n\r\n", come());
  EXPECT_TRUE(std::holds_alternative<ReceivedRequest>(received()));
  EXPECT_EQ(rest(come()), "") << "there is no place";
  room_->send(std::move(last_), "answer");
  EXPECT_EQ(rest(), "answer");
}

TEST_F(WaitingRoomTest, AllPlacesTogetherAreBoundedToo) {
  RoomLimits limits;
  limits.places = 2;
  open(limits);
  const std::size_t first = come("127.0.0.2");
  come("127.0.0.3");
  const std::size_t third = come("127.0.0.4");
  EXPECT_EQ(rest(first), "");
  say("GET / HTTP/1.1\r\nHost: desk\r\n\r\n", third);
  EXPECT_TRUE(std::holds_alternative<ReceivedRequest>(received()));
}

TEST_F(WaitingRoomTest, WhoTakesNothingOfAnAnswerYieldsTheLongestStandingFirst) {
  RoomLimits limits;
  limits.of_one_address = 2;
  open(limits);
  const std::size_t first = stand("127.0.0.1");
  std::this_thread::sleep_for(milliseconds(20));
  const std::size_t second = stand("127.0.0.1");
  const std::size_t third = come();
  say(kGet, third);
  received();
  room_->send(std::move(last_), "answer");
  EXPECT_EQ(rest(third), "answer");
  EXPECT_LT(rest(first).size(), 64U << 20U) << "it had stood longest";
  EXPECT_EQ(rest(second).size(), 64U << 20U) << "slow, and there is room";
}

TEST_F(WaitingRoomTest, AddressesThatHoldMostPlacesYieldBeforeOthers) {
  RoomLimits limits;
  limits.places = 4;
  limits.of_one_address = 3;
  open(limits);
  const std::size_t honest = stand("127.0.0.2");
  std::this_thread::sleep_for(milliseconds(20));
  for (int i = 0; i < 3; ++i) stand("127.0.0.3");
  for (int i = 0; i < 3; ++i) {
    const std::size_t who = come("127.0.0.4");
    say(kGet, who);
    received();
    room_->send(std::move(last_), "answer");
    EXPECT_EQ(rest(who), "answer");
  }
  EXPECT_EQ(rest(honest).size(), 64U << 20U) << "it stood longest, and takes its answer now";
}

TEST_F(WaitingRoomTest, KnowsBothEnds) {
  EXPECT_EQ(refusal("GET / HTTP/1.1\r\nHost: desk\r\n\r\n"), 200);
  EXPECT_EQ(last_->remote_address(), "127.0.0.1");
  EXPECT_EQ(last_->local_address(), "127.0.0.1");
  EXPECT_EQ(last_->same_user(), ::access("/proc/net/tcp", R_OK) == 0);
  ::close(theirs_[0]);
  theirs_.clear();
  EXPECT_FALSE(last_->same_user()) << "a closed socket belongs to nobody";
}

}  // namespace
}  // namespace trocar::review::waiting_room_test
