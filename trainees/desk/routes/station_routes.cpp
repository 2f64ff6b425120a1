// The live view and messages to who practises now.
#include "haptics/input_error.h"
#include "trainees/desk/pages/pages.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/desk/routes/page_routes.h"
#include "trainees/live/live_stations.h"

namespace trocar::review {
namespace {

LiveStations now_running(const Desk& desk) { return desk.sources.stations ? desk.sources.stations() : LiveStations{}; }

Response station_answer(std::string body) {
  Response out;
  out.body = std::move(body);
  return out;
}

/// What that trainee does now, in a line.
std::string station_now(const LiveStations& view, const std::string& trainee) {
  for (const LiveStation& station : view.stations) {
    const LiveMoment& now = station.told.moment;
    if (now.trainee != trainee || !now.hears || station.state == LiveStation::State::kEnded) continue;
    return now.attempt.empty() ? "Signed in, between attempts."
                               : now.exercise + " " + now.level + ", " + now.phase + ".";
  }
  return "Not at a station of this database now: the message is met at the next sign-in.";
}

/// Codes that are nobody's have no messages: the note would be anybody's to read. @throws InputError
std::string addressee(const std::string& trainee) {
  if (trainee.empty()) throw InputError("trainee: say to whom");
  if (trainee == "guest" || trainee == "demonstration")
    throw InputError(trainee + ": is nobody's code, so nobody can be written to");
  return trainee;
}

Response station(const Request& request, Desk& desk) {
  Frame frame = frame_of(request, desk);
  const std::string sent = argument(request.query, "sent");
  if (!sent.empty()) frame.notice = "Sent to " + sent + ".";
  return station_answer(station_page(now_running(desk), frame));
}

Response station_picture(const Request& request, Desk& desk) {
  const auto jpeg =
      desk.sources.station_picture ? desk.sources.station_picture(argument(request.arguments, "name")) : std::nullopt;
  if (!jpeg) throw InputError("there is no picture of that station now");
  Response out = station_answer(*jpeg);
  out.type = "image/jpeg";
  return out;
}

Response message_form(const Request& request, Desk& desk) {
  const std::string trainee = addressee(argument(request.query, "trainee"));
  return station_answer(
      station_message_page(trainee, station_now(now_running(desk), trainee), "", "", frame_of(request, desk)));
}

/// What was typed stays where it cannot be sent.
Response send(const Request& request, Desk& desk) {
  const std::string trainee = addressee(argument(request.form, "trainee")), text = argument(request.form, "text");
  try {
    AssessmentStore(desk.database).add_message(trainee, text, author_of(request));
  } catch (const InputError& error) {
    Response out = station_answer(station_message_page(trainee, station_now(now_running(desk), trainee), error.what(),
                                                       text, frame_of(request, desk)));
    out.status = 400;
    return out;
  }
  return see("/station?sent=" + url_part(trainee));
}

}  // namespace

std::vector<Route> station_routes() {
  const auto route = [](const std::string& method, const std::string& path, Response (*action)(const Request&, Desk&)) {
    return Route{method, path, Audience::kInstructors,
                 [action](const Request& r, Desk& d) { return answered(r, d, 400, [&] { return action(r, d); }); }};
  };
  return {route("GET", "/station", station), route("GET", "/station/picture/{name}", station_picture),
          route("GET", "/station/message", message_form), route("POST", "/station/message", send)};
}

}  // namespace trocar::review
