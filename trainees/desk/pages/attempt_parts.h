// Parts of the pages about one attempt: verdict, moment, tables, ratings. Shared by the attempt's page and the
// comparison. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "trainees/desk/pages/page_frame.h"
#include "trainees/desk/queries/views.h"

namespace trocar::review {

/// The one reason of a verdict, in the order of the trainee's debrief: critical event, failed gate that cost most,
/// undone, score; of a pass the part on which most points went. "" for nothing to say.
/// @param times the moment of a critical event; not where the recording's beginning is not known.
std::string verdict_reason(const AttemptView& view, bool times = true);
/// 100 w (1 - s).
double points_lost(const Subscore& part);
/// Whether a smaller value of that metric is the better one by the attempt's rubric; empty when the rubric does not use
/// it.
std::optional<bool> less_is_better(const AttemptView& view, const std::string& metric);
/// "force_max_n" as "Force max": the unit stands beside the value.
std::string metric_title(const std::string& name);
/// Moment of the largest force, s after the beginning; 0 without a trace.
double peak_moment_s(const AttemptView& view);

/// What helped a hand without a device, of AttemptResult::assists.
std::string help_words(const std::string& assists);

std::string verdict_band(const AttemptView& view);
std::string moment_section(const AttemptView& view);
std::string path_section(const AttemptView& view);
std::string heat_section(const AttemptView& view);
std::string event_table(const AttemptView& view);
std::string subscore_table(const AttemptView& view);
std::string metric_table(const AttemptView& view);
std::string device_facts(const AttemptView& view);
/// The loop's receipt of a live attempt, with its histograms; "" in lockstep.
std::string pace_section(const AttemptView& view);
/// What people say of the replay on a scale (rating_scales.h), and for who may write the form for it. "" where there is
/// neither.
std::string rating_section(const AttemptView& view, const Frame& frame);

/// What a signer should have seen, read from the attempt: finished, critical events, safety gates, device, record; in
/// that order.
struct SignCheck {
  bool fine = false;
  std::string words = {};
};
std::vector<SignCheck> sign_checks(const AttemptView& view);
std::string sign_checklist(const AttemptView& view);

std::string origin_facts(const AttemptView& view);

}  // namespace trocar::review
