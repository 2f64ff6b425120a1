#include "trainees/desk/server/waiting_room.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <list>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace trocar::review {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// What is still on its way is taken for a moment: closing over it would throw the answer away at the other side.
constexpr milliseconds kPatience{500};
constexpr std::size_t kMostTaken = 4U << 20U;

enum class State : std::uint8_t { kGreeting, kHead, kBody, kServed, kSending, kLeaving };

struct Guest {
  std::shared_ptr<Connection> connection;
  std::string address;
  State state = State::kGreeting;
  Deadline until;
  bool for_writing = false;  ///< what it waits for
  std::string bytes = {};    ///< read so far, or to be sent
  RequestHead head = {};
  std::size_t done = 0;  ///< of the bytes to be sent; of what was taken while leaving
  /// It came, or took something of its answer: what of a request dribbles in is no progress.
  Deadline stands_since = Clock::now();

  bool waits() const { return state != State::kServed; }
};

}  // namespace

struct WaitingRoom::Room {
  Room(const RoomLimits& given, Serve serve) : limits(given), serve_request(std::move(serve)) {
    thread = std::thread([this] { watch(); });
  }
  ~Room() {
    ends = true;
    wake();
    thread.join();
    ::close(bell);
  }

  void wake() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const ssize_t written = ::write(bell, &one, sizeof one);
  }

  void watch() {
    std::vector<pollfd> watched;
    std::vector<Guest*> whose;
    while (!ends) {
      watched.assign(1, {bell, POLLIN, 0});
      whose.assign(1, nullptr);
      Deadline next = Clock::now() + milliseconds(1000);
      for (Guest& guest : guests) {
        if (!guest.waits()) continue;
        watched.push_back({guest.connection->socket(), static_cast<short>(guest.for_writing ? POLLOUT : POLLIN), 0});
        whose.push_back(&guest);
        next = std::min(next, guest.until);
      }
      const auto left = std::max<milliseconds>(std::chrono::ceil<milliseconds>(next - Clock::now()), milliseconds(0));
      if (::poll(watched.data(), watched.size(), static_cast<int>(left.count())) < 0) continue;  // a signal
      const Deadline now = Clock::now();
      for (std::size_t i = 1; i < watched.size(); ++i) {
        if (whose[i]->until <= now)  // however busily it dribbles
          too_late(*whose[i]);
        else if (watched[i].revents != 0)
          go_on(*whose[i]);
      }
      guests.remove_if([](const Guest& guest) { return !guest.connection; });
      if (watched[0].revents != 0) take_in();
    }
  }

  /// Those who came, and those whose answers are ready.
  void take_in() {
    std::uint64_t rings = 0;
    [[maybe_unused]] const ssize_t read = ::read(bell, &rings, sizeof rings);
    std::vector<Guest> came;
    std::vector<std::pair<std::shared_ptr<Connection>, std::string>> answers;
    {
      const std::scoped_lock lock(mutex);
      came.swap(arrived);
      answers.swap(answered);
    }
    for (auto& [connection, bytes] : answers) {
      const auto at = std::find_if(guests.begin(), guests.end(),
                                   [&, &c = connection](const Guest& guest) { return guest.connection == c; });
      if (at != guests.end()) begin_sending(*at, std::move(bytes));
    }
    for (Guest& guest : came) {
      if (!make_place(guest.address)) continue;  // it ends here
      guests.push_back(std::move(guest));
      go_on(guests.back());
    }
    guests.remove_if([](const Guest& guest) { return !guest.connection; });
  }

  /// Who has stood still longest yields, of the addresses that hold most places; who is served does not.
  /// @returns false: all are.
  bool make_place(const std::string& address) {
    std::map<std::string, std::size_t> taken;
    std::size_t all = 0;
    for (const Guest& guest : guests) {
      if (!guest.connection) continue;
      ++taken[guest.address];
      ++all;
    }
    const bool own = taken[address] >= limits.of_one_address;
    if (!own && all < limits.places) return true;
    Guest* yields = nullptr;
    for (Guest& guest : guests) {
      if (!guest.connection || !guest.waits() || (own && guest.address != address)) continue;
      const std::size_t held = taken[guest.address], most = yields ? taken[yields->address] : 0;
      if (held > most || (held == most && guest.stands_since < yields->stands_since)) yields = &guest;
    }
    if (!yields) return false;
    yields->connection.reset();
    return true;
  }

  void go_on(Guest& guest) {
    switch (guest.state) {
      case State::kGreeting: {
        const long done = guest.connection->greet();
        if (again(guest, done)) return;
        if (done <= 0) return guest.connection.reset();
        guest.state = State::kHead;
        return read_head(guest);
      }
      case State::kHead:
        return read_head(guest);
      case State::kBody:
        return read_body(guest);
      case State::kSending:
        return send_more(guest);
      case State::kLeaving:
        return leave(guest);
      case State::kServed:
        return;
    }
  }

  void too_late(Guest& guest) {
    const bool began = guest.state == State::kBody || (guest.state == State::kHead && !guest.bytes.empty());
    if (guest.state == State::kHead || guest.state == State::kBody)
      hand_over(guest, began ? Refusal{408, "The request took too long to arrive."} : Refusal{0, ""});
    else
      guest.connection.reset();
  }

  /// It is not its turn yet: it waits for what it needs.
  static bool again(Guest& guest, long done) {
    if (done != Connection::kAgainToRead && done != Connection::kAgainToWrite) return false;
    guest.for_writing = done == Connection::kAgainToWrite;
    return true;
  }

  void hand_over(Guest& guest, Received received) {
    guest.state = State::kServed;
    serve_request(guest.connection, std::move(received));
  }

  void read_head(Guest& guest) {
    char piece[4096];
    std::size_t end = std::string::npos;
    while (end == std::string::npos) {
      if (guest.bytes.size() > limits.request.head_bytes)
        return hand_over(guest, Refusal{431, "The head of the request is too large."});
      const long count = guest.connection->take(piece, sizeof piece);
      if (again(guest, count)) return;
      if (count <= 0) return hand_over(guest, Refusal{0, ""});
      const std::size_t from = guest.bytes.size() < 3 ? 0 : guest.bytes.size() - 3;
      guest.bytes.append(piece, static_cast<std::size_t>(count));
      end = guest.bytes.find("\r\n\r\n", from);
    }
    auto head = parse_head(std::string_view(guest.bytes).substr(0, end + 4), limits.request);
    if (auto* refusal = std::get_if<Refusal>(&head)) return hand_over(guest, std::move(*refusal));
    guest.head = std::get<RequestHead>(std::move(head));
    guest.bytes.erase(0, end + 4);
    guest.state = State::kBody;
    guest.until = Clock::now() + milliseconds(limits.request.body_ms);
    read_body(guest);
  }

  void read_body(Guest& guest) {
    char piece[16384];
    while (guest.bytes.size() < guest.head.content_length) {
      const long count =
          guest.connection->take(piece, std::min(sizeof piece, guest.head.content_length - guest.bytes.size()));
      if (again(guest, count)) return;
      if (count <= 0) return hand_over(guest, Refusal{0, ""});
      guest.bytes.append(piece, static_cast<std::size_t>(count));
    }
    guest.bytes.resize(guest.head.content_length);  // one request a connection: what comes behind it is not read
    hand_over(guest, ReceivedRequest{std::move(guest.head), std::move(guest.bytes)});
  }

  void begin_sending(Guest& guest, std::string bytes) {
    if (bytes.empty()) return guest.connection.reset();
    guest.bytes = std::move(bytes);
    guest.done = 0;
    guest.state = State::kSending;
    guest.stands_since = Clock::now();
    guest.until = Clock::now() + milliseconds(limits.request.write_ms);
    send_more(guest);
  }

  void send_more(Guest& guest) {
    while (guest.done < guest.bytes.size()) {
      const long count = guest.connection->put(guest.bytes.data() + guest.done, guest.bytes.size() - guest.done);
      if (again(guest, count)) return;
      if (count <= 0) return guest.connection.reset();
      guest.done += static_cast<std::size_t>(count);
      guest.stands_since = Clock::now();
    }
    guest.connection->end();
    guest.bytes.clear();
    guest.done = 0;
    guest.for_writing = false;
    guest.state = State::kLeaving;
    guest.until = Clock::now() + kPatience;
  }

  void leave(Guest& guest) {
    const long count = guest.connection->drop();
    if (count == Connection::kAgainToRead) return;
    guest.done += static_cast<std::size_t>(std::max(count, 0L));
    if (count <= 0 || guest.done > kMostTaken) guest.connection.reset();
  }

  RoomLimits limits;
  Serve serve_request;
  int bell = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  std::atomic<bool> ends{false};
  std::list<Guest> guests = {};  ///< of the room's thread alone, longest here first
  std::mutex mutex = {};
  std::vector<Guest> arrived = {};
  std::vector<std::pair<std::shared_ptr<Connection>, std::string>> answered = {};
  std::thread thread = {};
};

WaitingRoom::WaitingRoom(const RoomLimits& limits, Serve serve)
    : room_(std::make_unique<Room>(limits, std::move(serve))) {}

WaitingRoom::~WaitingRoom() = default;

void WaitingRoom::enter(std::shared_ptr<Connection> connection) {
  Guest guest{std::move(connection), "", State::kGreeting, Clock::now() + milliseconds(room_->limits.request.head_ms)};
  guest.address = guest.connection->remote_address();
  {
    const std::scoped_lock lock(room_->mutex);
    room_->arrived.push_back(std::move(guest));
  }
  room_->wake();
}

void WaitingRoom::send(std::shared_ptr<Connection> connection, std::string bytes) {
  {
    const std::scoped_lock lock(room_->mutex);
    room_->answered.emplace_back(std::move(connection), std::move(bytes));
  }
  room_->wake();
}

}  // namespace trocar::review
