// Why attempts fail: where the points go, which gates are not met, what is grave; by exercise, level, input and rubric.
//
// Of each person their newest few attempts, so that it says where people stand and not where they once stood. By the
// scores: what a person decided changes none of these. Thread: the Database's.
#pragma once

#include <string>
#include <vector>

#include "scenarios/scoring/attempt_result.h"
#include "trainees/desk/queries/desk_queries.h"

namespace trocar {

struct LostSubscore {
  Subscore part = {};      ///< its anchors; raw: median over the attempts that have one; value: mean
  double points_lost = 0;  ///< mean over the graded attempts
  int gate_failed = 0;     ///< attempts in which it was a safety gate that was not met
  double gate_below = 0;   ///< share of the part that meets the gate; 0 while none failed
};

struct Losses {
  CurveKey key = {};
  int people = 0, attempts = 0;                ///< looked at
  int graded = 0, passed = 0, unfinished = 0;  ///< of them; passed by the score
  std::vector<LostSubscore> parts = {};        ///< most points lost first
  std::vector<HarmfulEvents> critical = {};    ///< most first
};

/// Somebody's newest attempts on a curve, at most kRowsForLosses.
struct NewestAttempts {
  CurveKey key = {};
  std::vector<std::int64_t> rows = {};
};
std::vector<NewestAttempts> newest_attempts(const std::vector<CohortLine>& lines);
/// One for each curve, in the order of the keys.
std::vector<Losses> losses_of(Database& database, const std::vector<NewestAttempts>& of);

/// How a measure goes with the attempts of a cohort: quartiles by attempt number, as cohort_curve() has them.
struct MetricCohort {
  std::string unit = {};
  std::vector<CohortPoint> points = {};
};
MetricCohort metric_cohort(Database& database, const CurveKey& key, const std::string& metric);

/// Measures that the attempt's score has, in the record's order. @param row of an attempt.
std::vector<std::string> metrics_of_attempt(Database& database, std::int64_t row);

}  // namespace trocar
