// Reports of the desk as values (trainees/desk/print/report.h): of a trainee, a cohort, an attempt, and certificates.
// Functions of plain views, like the pages. Every number stands with its unit, its n, its date or its rules. Nothing of
// a report tells when it was made: the same record makes the same bytes. Thread: any.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "trainees/desk/print/report.h"
#include "trainees/desk/queries/views.h"
#include "trainees/progress/rules.h"

namespace trocar::review {

/// What is common to all of them.
struct ReportSetting {
  bool demo = false;         ///< invented trainees: said on every page
  bool notes = false;        ///< notes of instructors too
  ProgressRules rules = {};  ///< in force, for the terms
};

struct TraineeReportView {
  TraineeView trainee = {};
  std::map<std::string, VerdictOverride> decisions = {};  ///< newest of each attempt, by its UUID
};
printed::Report trainee_report(const TraineeReportView& view, const ReportSetting& setting);

/// Attempts that no curve counts, or that count with a doubt.
struct Exclusion {
  std::string words = {};
  int attempts = 0, trainees = 0;
};
struct CohortReportView {
  CohortView cohort = {};
  std::vector<Benchmark> benchmarks = {};  ///< newest of each exercise, level and metric
  std::vector<Exclusion> exclusions = {};
  std::vector<Certificate> certificates = {};  ///< everybody's, withdrawn ones too
  ShakenCertificates shaken = {};
};
printed::Report cohort_report(const CohortReportView& view, const ReportSetting& setting);

struct AttemptReportView {
  AttemptView attempt = {};
  std::string picture_png = {}, no_picture = {};  ///< of the moment of the largest force; why there is none
};
printed::Report attempt_report(const AttemptReportView& view, const ReportSetting& setting);

struct CertifiedAttempt {
  std::string uuid = {}, utc = {}, status = {}, row_hash = {}, backend = {}, hand = {};
  std::int64_t chain_position = 0;
  std::optional<double> score = {};
  bool passed = false;
  std::string decided_by = {};     ///< who decided otherwise than the score; `passed` is that decision
  bool passed_now = false;         ///< as it counts today; `passed` is as it counted when the certificate was given
  std::string decided_since = {};  ///< who has decided since; "" nobody
  bool soft_real_time = false;     ///< its loop had no real-time priority
};
struct CertificateView {
  Certificate certificate = {};
  std::string name = {}, exercise = {};
  std::vector<CertifiedAttempt> attempts = {};  ///< oldest first, those of its curve before it was given
  std::string evidence = {};                    ///< the judgement's sentence
  int n = 0;                                    ///< that the judgement rested on; 0: not recorded
  std::optional<double> reliability = {};
  std::string in_question = {};  ///< why it may not stand; "" while all that it stands on holds
  std::string witness = {};      ///< the certificate's own entry of the audit trail and the key that signed it
};
printed::CertificateSheet certificate_sheet(const CertificateView& view, const ReportSetting& setting);

/// How each number of a report is made: the closing part.
enum class TermsOf : std::uint8_t { kTrainee, kCohort, kAttempt };
std::vector<printed::Block> report_terms(TermsOf report, const ProgressRules& rules);

/// Newest scores of a cohort, one band for each exercise, level and input: dots, quartiles, pass mark, benchmark.
struct ScoreBand {
  std::string title = {};
  std::vector<double> scores = {};
  double pass_at = 75;
  std::optional<double> benchmark = {};
};
std::string score_bands_svg(const std::vector<ScoreBand>& bands);

}  // namespace trocar::review
