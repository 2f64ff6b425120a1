// Writes an answer to a connection, by cpp-httplib. Thread: the one that serves the connection.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "trainees/desk/routes/route.h"
#include "trainees/desk/server/connection.h"

namespace trocar::review {

/// @param headers beside type, length and "Connection: close". @param head_only of a HEAD request: without the body.
/// @returns all was taken.
bool send_answer(Connection& connection, const Response& response,
                 const std::vector<std::pair<std::string, std::string>>& headers, bool head_only, Deadline until);

}  // namespace trocar::review
