// All pages of the desk in one list; the server and its tests know no other.
#include "trainees/desk/assets/assets.h"
#include "trainees/desk/queries/report_views.h"
#include "trainees/desk/routes/page_routes.h"

namespace trocar::review {
std::vector<Route> desk_routes() {
  std::vector<Route> out;
  out.push_back(
      {.method = "GET", .path = "/style.css", .audience = Audience::kEverybody, .answer = [](const Request&, Desk&) {
         return Response{.type = "text/css; charset=utf-8", .body = style_sheet()};
       }});
  out.push_back(
      {.method = "GET", .path = "/icon.svg", .audience = Audience::kEverybody, .answer = [](const Request&, Desk&) {
         return Response{.type = "image/svg+xml", .body = desk_icon()};
       }});
  for (const auto& part : {page_routes(), assessment_routes(), curriculum_routes(), roster_routes(), programme_routes(),
                           report_routes(), password_routes(), admin_routes(), station_routes(), film_routes()})
    out.insert(out.end(), part.begin(), part.end());
  return out;
}

}  // namespace trocar::review
