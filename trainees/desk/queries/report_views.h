// From the database to a report's bytes: what the desk's routes and `trocar review report` share. Thread: that of the
// Database.
#pragma once

#include <cstdint>
#include <string>

#include "trainees/desk/reports/reports.h"
#include "trainees/desk/routes/route.h"

namespace trocar::review {

enum class ReportFormat : std::uint8_t { kPdf, kHtml };

struct ReportQuestion {
  ReportFormat format = ReportFormat::kPdf;
  bool notes = false;
  std::string now_utc = {};  ///< for what is due
};

/// Each throws InputError for a name that is not in the database, EnvironmentError where a font is missing.
std::string trainee_file(Desk& desk, const std::string& code, const ReportQuestion& question);
/// @param filters as the cohort's page takes them: group, exercise, level, state, sort.
std::string cohort_file(Desk& desk, const std::map<std::string, std::string>& filters, const ReportQuestion& question);
/// @param name number or its beginning, as AttemptStore::find takes it.
std::string attempt_file(Desk& desk, const std::string& name, const ReportQuestion& question);
std::string certificate_file(Desk& desk, const std::string& uuid, const ReportQuestion& question);

TraineeReportView trainee_report_view(Desk& desk, const std::string& code, const std::string& now_utc);
CohortReportView cohort_report_view(Desk& desk, const std::map<std::string, std::string>& filters,
                                    const std::string& now_utc);
AttemptReportView attempt_report_view(Desk& desk, const std::string& name, const std::string& now_utc);
CertificateView certificate_view(Desk& desk, const std::string& uuid);

/// Routes of the files: /report/trainee/CODE.pdf, /report/cohort.pdf, /report/attempt/N.pdf,
/// /report/certificate/UUID.pdf.
std::vector<Route> report_routes();

}  // namespace trocar::review
