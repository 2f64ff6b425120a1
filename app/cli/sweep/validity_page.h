// The validity of a sweep as a page, a table and JSON: what the scores of scripted hands show, and what they cannot.
//
// Functions of values; same sweep, same bytes. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "app/cli/sweep/sweep_row.h"
#include "scenarios/scoring/validity/cell_validity.h"
#include "trainees/desk/print/report.h"

namespace trocar {

/// One exercise at one level on the arms that the seeds drew.
struct ReportedCell {
  std::string title;  ///< "E01 reach-and-orient, L2"
  SweepKey key;       ///< exercise, level, organ and tissue of it
  std::string exercise_version, rubric_sha256;
  Rubric rubric;
  ValidityScope scope;
  std::vector<ScoredAttempt> attempts;
  CellValidity found;
};

printed::Report validity_report(const std::vector<ReportedCell>& cells, const std::string& program);
std::string validity_json(const std::vector<ReportedCell>& cells, const std::string& program);
/// Every attempt with every sub-score and metric, worse arms too (RFC 4180). @param rows in the order of the table.
std::string attempts_csv(const std::vector<const SweepRow*>& rows);

}  // namespace trocar
