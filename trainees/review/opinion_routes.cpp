#include "haptics/input_error.h"
#include "trainees/attempt_store.h"
#include "trainees/rating_scales.h"
#include "trainees/review/desk_views.h"
#include "trainees/review/page_routes.h"
#include "trainees/review/pages.h"

namespace trocar::review {
namespace {

std::string attempt_of(const Request& request, Desk& desk) {
  return AttemptStore(desk.database).find(argument(request.arguments, "attempt")).uuid;
}

Response note_on_trainee(const Request& request, Desk& desk) {
  const std::string code = argument(request.arguments, "code");
  OpinionStore(desk.database).add_note(code, "", argument(request.form, "text"), author_of(request));
  return see("/trainee/" + url_part(code) + "#notes");
}

Response note_on_attempt(const Request& request, Desk& desk) {
  const AttemptSummary attempt = AttemptStore(desk.database).find(argument(request.arguments, "attempt"));
  OpinionStore(desk.database).add_note(attempt.trainee, attempt.uuid, argument(request.form, "text"), author_of(request));
  return see("/attempt/" + url_part(attempt.uuid) + "#notes");
}

Response sign(const Request& request, Desk& desk) {
  const std::string uuid = attempt_of(request, desk);
  OpinionStore(desk.database).sign(uuid, argument(request.form, "meaning"), argument(request.form, "note"), author_of(request));
  return see("/attempt/" + url_part(uuid) + "#sign");
}

Response override_verdict(const Request& request, Desk& desk) {
  const std::string uuid = attempt_of(request, desk), passed = argument(request.form, "passed");
  if (passed != "yes" && passed != "no") throw InputError("passed: say yes or no");
  OpinionStore(desk.database).override_verdict(uuid, passed == "yes", argument(request.form, "reason"), author_of(request));
  return see("/attempt/" + url_part(uuid) + "#sign");
}

/// An item left at "not rated" sends an empty value.
Response rate(const Request& request, Desk& desk) {
  const std::string uuid = attempt_of(request, desk);
  const RatingScale& scale = rating_scale(argument(request.form, "scale"));
  std::map<std::string, double> values;
  for (const RatingItem& item : scale.items) {
    const std::string text = argument(request.form, item.name);
    if (text.empty()) continue;
    if (text.size() != 1 || text[0] < '0' || text[0] > '9') throw InputError("rating " + scale.name + ", " + item.name + ": choose a value");
    values[item.name] = text[0] - '0';
  }
  OpinionStore(desk.database).rate(uuid, scale.name, values, author_of(request));
  return see("/attempt/" + url_part(uuid) + "#ratings");
}

/// The evidence is looked at again: what the form was made from may be hours old.
Response certify(const Request& request, Desk& desk) {
  const AttemptView view = attempt_view(desk, request, attempt_of(request, desk));
  if (!view.ready) throw InputError("no certificate: competence at this exercise and level has not been shown, or one is held already");
  OpinionStore(desk.database)
      .certify(view.result.trainee, view.result.exercise_id, view.result.level, view.ready->rule_version, certificate_evidence(view),
               author_of(request));
  return see("/trainee/" + url_part(view.result.trainee) + "#certificates");
}

Response revoke(const Request& request, Desk& desk) {
  OpinionStore opinions(desk.database);
  const std::string uuid = argument(request.arguments, "certificate");
  opinions.revoke(uuid, argument(request.form, "reason"), author_of(request));
  for (const Certificate& certificate : opinions.certificates_of(""))
    if (certificate.uuid == uuid) return see("/trainee/" + url_part(certificate.trainee) + "#certificates");
  return see("/");
}

using Action = Response (*)(const Request&, Desk&);

Route post(const std::string& path, Action action) {
  return {"POST", path, Audience::kInstructors,
          [action](const Request& request, Desk& desk) { return answered(request, desk, 400, [&] { return action(request, desk); }); }};
}

}  // namespace

std::vector<Route> opinion_routes() {
  return {post("/trainee/{code}/note", note_on_trainee), post("/attempt/{attempt}/note", note_on_attempt),
          post("/attempt/{attempt}/sign", sign),         post("/attempt/{attempt}/override", override_verdict),
          post("/attempt/{attempt}/rate", rate),
          post("/attempt/{attempt}/certify", certify),   post("/certificate/{certificate}/revoke", revoke)};
}

}  // namespace trocar::review
