// One request on its way through the gate. Internal to desk_gate.cpp and desk_sign_in.cpp.
#pragma once

#include "trainees/desk/server/desk_gate.h"

namespace trocar::review {

struct DeskGate::RequestContext {
  const IncomingRequest& incoming;
  Desk& desk;
  DeskTime now;
  std::string number = {};  ///< of the visitor's cookie, "" without one
  std::string cookie = {};  ///< to set
  RouteTable::Found found = {};
  Request request = {};

  bool posts() const { return incoming.head.method == "POST"; }
};

}  // namespace trocar::review
