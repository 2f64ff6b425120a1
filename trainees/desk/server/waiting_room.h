// Where connections wait for the network: until a request is whole, until an answer is taken, until the other side has
// ended. One thread watches all of them, so that whoever is slow costs a place and no thread; only whole requests go to
// those who serve.
//
// An address has so many places; when they are taken, the one that has stood still longest yields to a new one, whether
// it asks or takes its answer, so that slow visitors never keep out others, not even from their own address. The same
// holds for all places together, where one of an address that holds most of them yields. Thread: enter() and send() may
// come from any.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <variant>

#include "trainees/desk/server/connection.h"
#include "trainees/desk/server/request_head.h"

namespace trocar::review {

struct ReceivedRequest {
  RequestHead head;
  std::string body;
};
using Received = std::variant<ReceivedRequest, Refusal>;

struct RoomLimits {
  RequestLimits request = {};
  std::size_t places = 256, of_one_address = 16;
};

class WaitingRoom {
 public:
  /// Called by the room's thread with a whole request, or with why there is none; must not wait. The connection comes
  /// back by send().
  using Serve = std::function<void(std::shared_ptr<Connection>, Received)>;

  WaitingRoom(const RoomLimits& limits, Serve serve);
  /// Ends all connections that wait.
  ~WaitingRoom();
  WaitingRoom(const WaitingRoom&) = delete;
  WaitingRoom& operator=(const WaitingRoom&) = delete;

  void enter(std::shared_ptr<Connection> connection);
  /// Sends what is left of an answer within the limit, and ends the connection so that it arrives. @param bytes empty:
  /// it ends without a word.
  void send(std::shared_ptr<Connection> connection, std::string bytes);

 private:
  struct Room;
  std::unique_ptr<Room> room_;
};

}  // namespace trocar::review
