// Parts of pages that say why attempts fail: tables of lost points, and a measure by attempt. Thread: any.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "trainees/desk/queries/views.h"

namespace trocar::review {

/// A table for each exercise, level, input and rubric.
std::string loss_tables(const std::vector<LossLine>& lines);
/// Which measure is drawn. @param kept what else the address holds.
std::string metric_form(const std::string& action_html, const std::vector<std::pair<std::string, std::string>>& kept,
                        const std::vector<std::string>& choices, const std::string& chosen);
/// @param points of the curve; empty for a cohort alone.
std::string metric_figure(const MetricCurve& metric, const std::vector<CurvePoint>& points);

}  // namespace trocar::review
