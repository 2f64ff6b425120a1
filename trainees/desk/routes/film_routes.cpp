// The film of an attempt: its page, making it, its bytes in parts.
#include "haptics/input_error.h"
#include "trainees/desk/pages/film_page.h"
#include "trainees/desk/pages/pages.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/desk/routes/page_routes.h"
#include "trainees/records/attempt_store.h"

namespace trocar::review {
namespace {

std::string attempt_of(const Request& request, Desk& desk) {
  return AttemptStore(desk.database).find(argument(request.arguments, "attempt")).uuid;
}

Response film_answer(const Request& request, Desk& desk) {
  Response out;
  out.body = film_page(film_view(desk, attempt_of(request, desk)), frame_of(request, desk));
  return out;
}

/// Begun twice it goes on once.
Response make(const Request& request, Desk& desk) {
  const std::string uuid = attempt_of(request, desk);
  if (!desk.sources.film.make)
    throw InputError(desk.sources.no_film.empty() ? "this desk makes no films" : desk.sources.no_film);
  desk.sources.film.make(uuid);
  return see("/attempt/" + url_part(uuid) + "/film");
}

Response bytes(const Request& request, Desk& desk) {
  const std::string uuid = attempt_of(request, desk);
  const FilmState film = desk.sources.film.state ? desk.sources.film.state(uuid) : FilmState{};
  if (film.stage != FilmState::Stage::kReady || film.bytes == 0)
    throw InputError("attempt " + uuid + ": there is no film of it yet");
  Response out;
  out.type = "video/mp4";
  out.accept_ranges = true;
  bool whole = true;
  const std::optional<ByteRange> range = asked_range(request.range, film.bytes, whole);
  if (!range) {
    out.status = 416;
    out.content_range = "bytes */" + std::to_string(film.bytes);
    return out;
  }
  out.body = desk.sources.film.part(uuid, range->from, range->count);
  if (!whole) {
    out.status = 206;
    out.content_range = "bytes " + std::to_string(range->from) + "-" +
                        std::to_string(range->from + out.body.size() - 1) + "/" + std::to_string(film.bytes);
  }
  if (!argument(request.query, "save").empty()) out.download = "attempt-" + uuid.substr(0, 8) + ".mp4";
  return out;
}

}  // namespace

std::vector<Route> film_routes() {
  const auto route = [](const std::string& method, const std::string& path, int status,
                        Response (*action)(const Request&, Desk&)) {
    return Route{method, path, Audience::kOwnData, [action, status](const Request& r, Desk& d) {
                   return answered(r, d, status, [&] { return action(r, d); });
                 }};
  };
  return {route("GET", "/attempt/{attempt}/film", 404, film_answer),
          route("POST", "/attempt/{attempt}/film", 409, make), route("GET", "/attempt/{attempt}/film.mp4", 404, bytes)};
}

}  // namespace trocar::review
