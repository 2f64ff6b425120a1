// All pages of the desk in one list; the server and its tests know no other.
#include "trainees/desk/pages/style.h"
#include "trainees/desk/queries/report_views.h"
#include "trainees/desk/routes/page_routes.h"

namespace trocar::review {
namespace {

/// What browsers ask for and show in the tab: an instrument through its port.
constexpr const char* kIcon =
    "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 32 32\"><rect width=\"32\" height=\"32\" rx=\"6\" "
    "fill=\"#1d2935\"/>"
    "<path d=\"M6 5 24 25\" stroke=\"#fff\" stroke-width=\"3\" stroke-linecap=\"round\"/><circle cx=\"14.5\" "
    "cy=\"14.5\" r=\"5.5\" "
    "fill=\"none\" stroke=\"#56b4e9\" stroke-width=\"3\"/></svg>\n";

}  // namespace

std::vector<Route> desk_routes() {
  std::vector<Route> out;
  out.push_back(
      {.method = "GET", .path = "/style.css", .audience = Audience::kEverybody, .answer = [](const Request&, Desk&) {
         return Response{.type = "text/css; charset=utf-8", .body = style_sheet()};
       }});
  out.push_back(
      {.method = "GET", .path = "/icon.svg", .audience = Audience::kEverybody, .answer = [](const Request&, Desk&) {
         return Response{.type = "image/svg+xml", .body = kIcon};
       }});
  for (const auto& part : {page_routes(), opinion_routes(), curriculum_routes(), report_routes(), admin_routes(),
                           station_routes(), film_routes()})
    out.insert(out.end(), part.begin(), part.end());
  return out;
}

}  // namespace trocar::review
