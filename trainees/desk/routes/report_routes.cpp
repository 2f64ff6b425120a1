// Reports for download. Who may see the page may have its file; notes are in it for staff only where they are asked for
// (?notes=yes).
#include "trainees/desk/queries/desk_views.h"
#include "trainees/desk/queries/report_views.h"
#include "trainees/desk/routes/page_routes.h"
#include "trainees/records/attempt_store.h"

namespace trocar::review {
namespace {

Response pdf(std::string body, const std::string& name) {
  Response out;
  out.type = "application/pdf";
  out.body = std::move(body);
  out.download = name + ".pdf";
  return out;
}

ReportQuestion question_of(const Request& request) {
  return {ReportFormat::kPdf, argument(request.query, "notes") == "yes", request.now_utc};
}

Response trainee(const Request& request, Desk& desk) {
  const std::string code = argument(request.arguments, "code");
  return pdf(trainee_file(desk, code, question_of(request)), "trainee-" + code);
}

Response cohort(const Request& request, Desk& desk) {
  const std::string group = argument(request.query, "group");
  return pdf(cohort_file(desk, request.query, question_of(request)), group.empty() ? "cohort" : "cohort-" + group);
}

Response attempt(const Request& request, Desk& desk) {
  const std::string uuid = AttemptStore(desk.database).find(argument(request.arguments, "attempt")).uuid;
  return pdf(attempt_file(desk, uuid, question_of(request)), "attempt-" + uuid);
}

Response certificate(const Request& request, Desk& desk) {
  const std::string uuid = argument(request.arguments, "certificate");
  return pdf(certificate_file(desk, uuid, question_of(request)), "certificate-" + uuid);
}

using ReportAnswer = Response (*)(const Request&, Desk&);

Route report_route(const std::string& path, Audience audience, ReportAnswer page) {
  return {"GET", path, audience, [page](const Request& request, Desk& desk) {
            return answered(request, desk, 404, [&] { return page(request, desk); });
          }};
}

}  // namespace

std::vector<Route> report_routes() {
  return {report_route("/report/trainee/{code}.pdf", Audience::kOwnData, trainee),
          report_route("/report/cohort.pdf", Audience::kInstructors, cohort),
          report_route("/report/attempt/{attempt}.pdf", Audience::kOwnData, attempt),
          report_route("/report/certificate/{certificate}.pdf", Audience::kOwnData, certificate)};
}

}  // namespace trocar::review
