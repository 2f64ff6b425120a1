// All pages of the desk in one list; the server and its tests know no other.
#include "trainees/review/route.h"
#include "trainees/review/style.h"

namespace trocar::review {

std::vector<Route> desk_routes() {
  std::vector<Route> out;
  out.push_back({.method = "GET", .path = "/style.css", .audience = Audience::kEverybody, .answer = [](const Request&, Desk&) {
                   return Response{.type = "text/css; charset=utf-8", .body = style_sheet()};
                 }});
  return out;
}

}  // namespace trocar::review
