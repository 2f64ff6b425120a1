// An answer as it goes over the wire, made by cpp-httplib. Pure. Thread: any.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "trainees/desk/routes/route.h"

namespace trocar::review {

/// @param headers beside type, length and "Connection: close". @param head_only of a HEAD request: without the body.
std::string answer_bytes(const Response& response, const std::vector<std::pair<std::string, std::string>>& headers,
                         bool head_only);

}  // namespace trocar::review
