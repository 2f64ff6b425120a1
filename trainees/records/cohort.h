// The group at a glance: for every trainee, exercise, level and rubric what was tried and reached. Thread: that of the
// Database.
//
// Only completed and timed-out attempts are graded; means and the best run over those. Levels and rubrics are kept
// apart: a best score over L1 and L3, or over the shipped exercise and somebody's own of the same id, compares nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trainees/store/database.h"

namespace trocar {

/// Metrics that the overview takes means of, by their names in the catalogue of scenarios/scoring/metrics.h.
inline constexpr const char* kPeakForceMetric = "force_max_n";
inline constexpr const char* kTimeMetric = "time_s";

struct CohortRow {
  std::string trainee, exercise_id, level;
  int attempts = 0;  ///< finished, graded or not
  int graded = 0, passes = 0;
  std::optional<double> best, last;                      ///< scores, 0..100
  std::optional<double> mean_peak_force_n, mean_time_s;  ///< empty when no graded attempt has the metric
  std::string last_utc;                                  ///< start of the newest attempt
  std::string exercise_version, rubric_sha256;           ///< what it was graded by
};

/// How many people's training data were erased: cohorts and exports leave them out.
int people_erased(Database& database);

/// Rows by trainee code, exercise, level and first use of a rubric, without those whose training data were erased.
/// @param trainee only this code; empty: all, but for who is deactivated. @param deactivated those too.
std::vector<CohortRow> cohort(Database& database, const std::string& trainee = "", bool deactivated = false);

}  // namespace trocar
