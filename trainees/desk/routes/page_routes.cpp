#include "trainees/desk/routes/page_routes.h"

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "haptics/input_error.h"
#include "trainees/desk/assets/assets.h"
#include "trainees/desk/pages/pages.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/desk/server/path_redaction.h"
#include "trainees/exchange/export/certificate_export.h"
#include "trainees/records/attempt_store.h"

namespace trocar::review {
namespace {

constexpr int kPictureWidth = 800;

Response html_answer(std::string body) {
  Response out;
  out.body = std::move(body);
  return out;
}

/// Certificates of whoever has an attempt, or of a group's, as export writes them.
Response certificates(const Request& request, Desk& desk) {
  ExportFilter filter;
  filter.group = argument(request.query, "group");
  std::ostringstream out;
  write_certificates_csv(chosen_certificates(desk.database, choose_attempts(desk.database, filter)), out);
  return csv_file(out.str(), "certificates.csv");
}

Response refused(const Request& request, Desk& desk, int status, const std::string& title, const std::string& words) {
  Response out =
      html_answer(message_page(title, without_folders(words, desk.database.file()), frame_of(request, desk)));
  out.status = status;
  return out;
}

Response picture(const Request& request, Desk& desk) {
  const std::string text = argument(request.query, "t");
  char* end = nullptr;
  const double t = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || !std::isfinite(t) || t < 0)
    throw InputError("t: seconds from the beginning are needed, such as 12.5");
  if (!desk.sources.picture) throw InputError("this desk runs without graphics: it makes no pictures");
  Response out;
  out.type = "image/png";
  try {
    out.body = desk.sources.picture(AttemptStore(desk.database).find(argument(request.arguments, "attempt")).uuid, t,
                                    kPictureWidth);
  } catch (const EnvironmentError& error) {
    return refused(request, desk, 503, "No picture yet", sentence(error.what()));
  }
  return out;
}

Response heat(const Request& request, Desk& desk) {
  const std::string of = argument(request.query, "of", "time"), from = argument(request.query, "view", "scope");
  if ((of != "time" && of != "force") || (from != "scope" && from != "overview"))
    throw InputError("a map is of=time or of=force, view=scope or view=overview");
  if (!desk.sources.heat) throw InputError("this desk runs without graphics: it makes no pictures");
  Response out;
  out.type = "image/png";
  try {
    out.body = desk.sources.heat(AttemptStore(desk.database).find(argument(request.arguments, "attempt")).uuid,
                                 {of == "force", from == "overview"}, kPictureWidth);
  } catch (const EnvironmentError& error) {
    return refused(request, desk, 503, "No picture yet", error.what());
  }
  return out;
}

/// Both attempts must be the trainee's own; the server has looked at the first only.
Response compare(const Request& request, Desk& desk) {
  const CompareView view = compare_view(desk, request);
  const std::string own = frame_of(request, desk).own_code;
  if (!is_staff(request) && (view.left.result.trainee != own || view.right.result.trainee != own))
    return refused(request, desk, 403, "Not allowed", "One of these attempts is not yours.");
  return html_answer(compare_page(view, frame_of(request, desk)));
}

Response compare_by_name(const Request& request, Desk& desk) {
  const AttemptStore store(desk.database);
  const std::string first = store.find(argument(request.query, "attempt")).uuid;
  try {
    return see("/compare/" + url_part(first) + "/" + url_part(store.find(argument(request.query, "other")).uuid));
  } catch (const InputError& error) {
    Frame frame = frame_of(request, desk);
    frame.refused = {"compare", error.what(), request.query};
    return {.status = 404, .body = attempt_page(attempt_view(desk, request, first), frame)};
  }
}

using PageAnswer = Response (*)(const Request&, Desk&);

Route page_route(const std::string& path, Audience audience, PageAnswer page) {
  return {"GET", path, audience, [page](const Request& request, Desk& desk) {
            return answered(request, desk, 404, [&] { return page(request, desk); });
          }};
}

}  // namespace

Response see(const std::string& location) {
  Response out;
  out.status = 303;
  out.location = location;
  return out;
}

Response csv_file(std::string body, const std::string& name) {
  Response out;
  out.type = "text/csv; charset=utf-8";
  out.body = std::move(body);
  out.download = name;
  return out;
}

void require_confirmed(const Request& request) {
  if (!request.unconfirmed.empty()) throw InputError(request.unconfirmed);
}

Response answered(const Request& request, Desk& desk, int status, const std::function<Response()>& action) {
  try {
    return action();
  } catch (const InputError& error) {
    return refused(request, desk, status, status == 404 ? "Not found" : "Not done", sentence(error.what()));
  }
}

std::vector<Route> page_routes() {
  std::vector<Route> out;
  out.push_back(page_route("/", Audience::kInstructors, [](const Request& r, Desk& d) {
    return html_answer(cohort_page(cohort_view(d, r), frame_of(r, d)));
  }));
  out.push_back(page_route("/why", Audience::kInstructors, [](const Request& r, Desk& d) {
    return html_answer(why_page(why_view(d, r), frame_of(r, d)));
  }));
  out.push_back(page_route("/cohort.csv", Audience::kInstructors, [](const Request& r, Desk& d) {
    return csv_file(cohort_csv(cohort_view(d, r)), "cohort.csv");
  }));
  out.push_back(page_route("/certificates.csv", Audience::kInstructors, certificates));
  out.push_back(page_route("/trainee/{code}", Audience::kOwnData, [](const Request& r, Desk& d) {
    return html_answer(trainee_page(trainee_view(d, r), frame_of(r, d)));
  }));
  out.push_back(page_route("/trainee/{code}/attempts.csv", Audience::kOwnData, [](const Request& r, Desk& d) {
    return csv_file(trainee_csv(trainee_view(d, r)), "attempts-" + argument(r.arguments, "code") + ".csv");
  }));
  out.push_back(page_route("/attempt/{attempt}", Audience::kOwnData, [](const Request& r, Desk& d) {
    return html_answer(attempt_page(attempt_view(d, r, argument(r.arguments, "attempt")), frame_of(r, d)));
  }));
  out.push_back(page_route("/attempt/{attempt}/attempt.csv", Audience::kOwnData, [](const Request& r, Desk& d) {
    return csv_file(attempt_csv(attempt_view(d, r, argument(r.arguments, "attempt"))),
                    "attempt-" + argument(r.arguments, "attempt") + ".csv");
  }));
  out.push_back(page_route("/attempt/{attempt}/picture.png", Audience::kOwnData, picture));
  out.push_back(page_route("/attempt/{attempt}/heat.png", Audience::kOwnData, heat));
  out.push_back(page_route("/compare/{attempt}/{other}", Audience::kOwnData, compare));
  out.push_back(page_route("/compare", Audience::kInstructors, compare_by_name));
  out.push_back({"GET", "/desk.js", Audience::kEverybody, [](const Request&, Desk&) {
                   Response script;
                   script.type = "text/javascript; charset=utf-8";
                   script.body = desk_script();
                   return script;
                 }});
  return out;
}

}  // namespace trocar::review
