#include "app/desk/report_command.h"

#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/cli/records/open_database.h"
#include "app/desk/desk_sources.h"
#include "haptics/input_error.h"
#include "trainees/desk/queries/report_views.h"
#include "trainees/exchange/export/pending_export.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/demo_record.h"

namespace trocar {
namespace {

using review::ReportFormat;

ReportFormat format_of(const std::filesystem::path& out) {
  const std::string ending = out.extension().string();
  if (ending == ".pdf") return ReportFormat::kPdf;
  if (ending == ".html" || ending == ".htm") return ReportFormat::kHtml;
  throw InputError("-o " + out.string() + ": its name ends in .pdf or .html");
}

void check_subject(const ReviewReportOptions& o) {
  const int asked =
      (o.trainee.empty() ? 0 : 1) + (o.cohort ? 1 : 0) + (o.attempt.empty() ? 0 : 1) + (o.certificate.empty() ? 0 : 1);
  if (asked != 1) throw InputError("of what? Give one of --trainee CODE, --cohort, --attempt ID, --certificate UUID");
  if (!o.group.empty() && !o.cohort) throw InputError("--group goes with --cohort");
}

/// A desk's page is told to come again while the run is replayed; a command waits.
std::string patient_picture(DeskPictures& pictures, const std::string& uuid, double t_s, int width) {
  constexpr int kTimes = 40;
  for (int i = 1;; ++i) {
    try {
      return pictures.png(uuid, t_s, width);
    } catch (const EnvironmentError& error) {
      if (i == kTimes || std::string(error.what()).find("again in a moment") == std::string::npos) throw;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
}

std::string made(const ReviewReportOptions& o, review::Desk& desk) {
  const review::ReportQuestion question{format_of(o.out), o.notes, utc_now()};
  if (!o.trainee.empty()) return review::trainee_file(desk, o.trainee, question);
  if (o.cohort) return review::cohort_file(desk, {{"group", o.group}}, question);
  if (!o.attempt.empty()) return review::attempt_file(desk, o.attempt, question);
  return review::certificate_file(desk, o.certificate, question);
}

}  // namespace

int review_report(const ReviewReportOptions& options, std::ostream& out, std::ostream& err) {
  check_subject(options);
  format_of(options.out);
  PendingExport pending(
      options.out, PendingExport::Shape::kFile,
      options.force ? PendingExport::Existing::kReplaced : PendingExport::Existing::kKept);  // before the work
  Database database = open_database(options.database, OpenMode::kExisting, err);
  review::DeskSources sources = desk_sources();
  const auto pictures = options.attempt.empty() ? nullptr : desk_pictures(database.file(), err);
  if (pictures)
    sources.picture = [&](const std::string& uuid, double t_s, int width) {
      return patient_picture(*pictures, uuid, t_s, width);
    };
  review::Desk desk{database, std::move(sources), is_demo(database)};
  const std::string bytes = made(options, desk);
  pending.file().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  pending.commit();
  out << options.out.string() << '\n';
  return 0;
}

void add_review_report(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<ReviewReportOptions>();
  ReviewReportOptions& o = *given;
  CLI::App* report =
      add_command(parent, "report", "A report as PDF or HTML: of a trainee, a cohort, an attempt, or a certificate",
                  chosen, [given] { return review_report(*given, std::cout, std::cerr); });
  report->add_option("--trainee", o.trainee, "Code of the trainee");
  report->add_flag("--cohort", o.cohort, "Everybody, or a group");
  report->add_option("--group", o.group, "With --cohort: one group only");
  report->add_option("--attempt", o.attempt, "Number of the attempt, or its beginning");
  report->add_option("--certificate", o.certificate, "Number of the certificate");
  report->add_option("-o,--out", o.out, "File to be made, NAME.pdf or NAME.html; for its owner alone to read")
      ->required();
  report->add_flag("--notes", o.notes, "With the instructors' notes");
  report->add_flag("--force", o.force, "A file of that name gives way");
  report->add_option("--db", o.database, "Database file");
}

}  // namespace trocar
