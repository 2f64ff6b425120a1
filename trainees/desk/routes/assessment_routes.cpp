#include "haptics/input_error.h"
#include "trainees/desk/pages/pages.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/desk/routes/page_routes.h"
#include "trainees/records/attempt_store.h"
#include "trainees/records/rating_scales.h"
#include "trainees/store/disk_full.h"

namespace trocar::review {
namespace {

std::string commented_attempt(const Request& request, Desk& desk) {
  return AttemptStore(desk.database).find(argument(request.arguments, "attempt")).uuid;
}

constexpr const char* kDiskFull =
    "the disk of this machine is full: nothing was written. Make room on it, then send this again; all that is there "
    "can "
    "be read on";

Frame refused_frame(const Request& request, Desk& desk, const std::string& form, const std::string& why) {
  Frame frame = frame_of(request, desk);
  frame.refused = {form, why, request.form};
  return frame;
}

/// What an attempt's form does; refused, the attempt's page comes back with the form as it was sent.
Response on_attempt(const Request& request, Desk& desk, const std::string& form,
                    const std::function<Response(const std::string& uuid)>& act) {
  const std::string uuid = commented_attempt(request, desk);
  try {
    if (request.disk_full) throw DiskFull(kDiskFull);
    return act(uuid);
  } catch (const InputError& error) {
    return {.status = 400,
            .body = attempt_page(attempt_view(desk, request, uuid), refused_frame(request, desk, form, error.what()))};
  } catch (const DiskFull&) {
    return {.status = 507,
            .body = attempt_page(attempt_view(desk, request, uuid), refused_frame(request, desk, form, kDiskFull))};
  }
}

/// The same of what binds somebody: the password was given again, and was right.
Response on_signed_attempt(const Request& request, Desk& desk, const std::string& form,
                           const std::function<Response(const std::string& uuid)>& act) {
  return on_attempt(request, desk, form, [&](const std::string& uuid) {
    require_confirmed(request);
    return act(uuid);
  });
}

/// The same of a form on a trainee's page.
Response on_trainee(const Request& request, Desk& desk, const std::string& code, const std::string& form,
                    const std::function<void()>& act, const std::string& after) {
  Request asked = request;
  asked.arguments["code"] = code;
  try {
    if (request.disk_full) throw DiskFull(kDiskFull);
    act();
  } catch (const InputError& error) {
    return {.status = 400,
            .body = trainee_page(trainee_view(desk, asked), refused_frame(request, desk, form, error.what()))};
  } catch (const DiskFull&) {
    return {.status = 507,
            .body = trainee_page(trainee_view(desk, asked), refused_frame(request, desk, form, kDiskFull))};
  }
  return see("/trainee/" + url_part(code) + after);
}

Response note_on_trainee(const Request& request, Desk& desk) {
  const std::string code = argument(request.arguments, "code");
  const auto add = [&] {
    AssessmentStore(desk.database).add_note(code, "", argument(request.form, "text"), author_of(request));
  };
  return on_trainee(request, desk, code, "note", add, "#notes");
}

Response note_on_attempt(const Request& request, Desk& desk) {
  return on_attempt(request, desk, "note", [&](const std::string& uuid) {
    const AttemptSummary attempt = AttemptStore(desk.database).find(uuid);
    AssessmentStore(desk.database).add_note(attempt.trainee, uuid, argument(request.form, "text"), author_of(request));
    return see("/attempt/" + url_part(uuid) + "#notes");
  });
}

Response sign(const Request& request, Desk& desk) {
  return on_signed_attempt(request, desk, "sign", [&](const std::string& uuid) {
    AssessmentStore(desk.database)
        .sign(uuid, argument(request.form, "meaning"), argument(request.form, "note"), author_of(request));
    return see("/attempt/" + url_part(uuid) + "#sign");
  });
}

Response override_verdict(const Request& request, Desk& desk) {
  return on_signed_attempt(request, desk, "override", [&](const std::string& uuid) {
    const std::string passed = argument(request.form, "passed");
    if (passed != "yes" && passed != "no") throw InputError("decision: say passed or not passed");
    AssessmentStore(desk.database)
        .override_verdict(uuid, passed == "yes", argument(request.form, "reason"), author_of(request));
    return see("/attempt/" + url_part(uuid) + "#sign");
  });
}

/// An item left at "not rated" sends an empty value.
Response rate(const Request& request, Desk& desk) {
  return on_attempt(request, desk, "rate", [&](const std::string& uuid) {
    const RatingScale& scale = rating_scale(argument(request.form, "scale"));
    std::map<std::string, double> values;
    for (const RatingItem& item : scale.items) {
      const std::string text = argument(request.form, item.name);
      if (text.empty()) continue;
      if (text.size() != 1 || text[0] < '0' || text[0] > '9')
        throw InputError("rating " + scale.name + ", " + item.name + ": choose a value");
      values[item.name] = text[0] - '0';
    }
    AssessmentStore(desk.database).rate(uuid, scale.name, values, author_of(request));
    return see("/attempt/" + url_part(uuid) + "#ratings");
  });
}

/// The evidence is looked at again: what the form was made from may be hours old.
Response certify(const Request& request, Desk& desk) {
  return on_signed_attempt(request, desk, "certify", [&](const std::string& uuid) {
    const AttemptView view = attempt_view(desk, request, uuid);
    if (!view.ready) {
      std::string why = "no certificate.";
      for (const std::string& condition : view.missing) why += " " + sentence(condition);
      throw InputError(why);
    }
    AssessmentStore(desk.database)
        .certify(view.result.trainee, view.result.exercise_id, view.result.level, view.ready->rule_version,
                 certificate_evidence(desk.database, view), author_of(request));
    return see("/trainee/" + url_part(view.result.trainee) + "#certificates");
  });
}

Response revoke(const Request& request, Desk& desk) {
  AssessmentStore assessments(desk.database);
  const std::string uuid = argument(request.arguments, "certificate");
  for (const Certificate& certificate : assessments.certificates_of(""))
    if (certificate.uuid == uuid) {
      const auto act = [&] {
        require_confirmed(request);
        assessments.revoke(uuid, argument(request.form, "reason"), author_of(request));
      };
      return on_trainee(request, desk, certificate.trainee, "revoke-" + uuid, act, "#certificates");
    }
  throw InputError("there is no such certificate in this record");
}

/// A form's address asked for as a page, as after signing in again: the page that has the form.
Route assessment_form(const std::string& path, const std::string& kind, const std::string& argument_name,
                      const std::string& after) {
  return {"GET", path, Audience::kOwnData, [=](const Request& request, Desk&) {
            return see("/" + kind + "/" + url_part(argument(request.arguments, argument_name)) + after);
          }};
}

using Action = Response (*)(const Request&, Desk&);

Route post(const std::string& path, Action action) {
  Route out{"POST", path, Audience::kInstructors, [action](const Request& request, Desk& desk) {
              return answered(request, desk, 400, [&] { return action(request, desk); });
            }};
  out.keeps_form = true;
  return out;
}

Route signed_post(const std::string& path, Action action) {
  Route out = post(path, action);
  out.asks_password = true;
  return out;
}

}  // namespace

std::vector<Route> assessment_routes() {
  std::vector<Route> out = {post("/trainee/{code}/note", note_on_trainee),
                            post("/attempt/{attempt}/note", note_on_attempt),
                            post("/attempt/{attempt}/rate", rate),
                            signed_post("/attempt/{attempt}/sign", sign),
                            signed_post("/attempt/{attempt}/override", override_verdict),
                            signed_post("/attempt/{attempt}/certify", certify),
                            signed_post("/certificate/{certificate}/revoke", revoke)};
  out.push_back(assessment_form("/trainee/{code}/note", "trainee", "code", "#notes"));
  out.push_back(assessment_form("/attempt/{attempt}/note", "attempt", "attempt", "#notes"));
  out.push_back(assessment_form("/attempt/{attempt}/rate", "attempt", "attempt", "#ratings"));
  for (const char* form : {"sign", "override", "certify"})
    out.push_back(assessment_form(std::string("/attempt/{attempt}/") + form, "attempt", "attempt", "#sign"));
  return out;
}

}  // namespace trocar::review
