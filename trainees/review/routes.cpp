// All pages of the desk in one list; the server and its tests know no other.
#include "trainees/review/page_routes.h"
#include "trainees/review/style.h"

namespace trocar::review {

std::vector<Route> desk_routes() {
  std::vector<Route> out;
  out.push_back({.method = "GET", .path = "/style.css", .audience = Audience::kEverybody, .answer = [](const Request&, Desk&) {
                   return Response{.type = "text/css; charset=utf-8", .body = style_sheet()};
                 }});
  for (const auto& part : {page_routes(), opinion_routes(), curriculum_routes(), station_routes(), film_routes()})
    out.insert(out.end(), part.begin(), part.end());
  return out;
}

}  // namespace trocar::review
