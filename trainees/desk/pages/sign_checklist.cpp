#include <algorithm>

#include "trainees/desk/pages/attempt_parts.h"
#include "trainees/markup/html.h"
#include "trainees/markup/pacing.h"

namespace trocar::review {
namespace {

SignCheck finished(const AttemptResult& result) {
  const bool done = result.grade.status == AttemptStatus::kCompleted;
  return {done, done ? "Finished" : "Not finished: " + std::string(status_name(result.grade.status))};
}

SignCheck critical_events(const AttemptResult& result) {
  const auto count = std::count_if(result.events.begin(), result.events.end(),
                                   [](const Event& event) { return event.severity == Severity::kCritical; });
  return {count == 0, count == 0 ? "No critical event" : plural(count, "critical event", "critical events")};
}

SignCheck safety_gates(const Grade& grade) {
  const auto failed =
      std::count_if(grade.caps.begin(), grade.caps.end(), [](const Cap& cap) { return cap.kind == CapKind::kGate; });
  const bool any =
      std::any_of(grade.subscores.begin(), grade.subscores.end(), [](const Subscore& part) { return part.gate; });
  if (failed > 0) return {false, plural(failed, "safety gate", "safety gates") + " not met"};
  return {true, any ? "Safety gates met" : "This exercise has no safety gate"};
}

SignCheck device(const RunReport& run_report, double late_share) {
  if (!run_report.fault.empty()) return {false, "The device reported a fault: " + run_report.fault};
  if (run_report.force_not_rendered())
    return {false, "Forces were not all felt: the device was at its limit in over 5 % of the contact"};
  const double missed = static_cast<double>(run_report.overruns), ticks = static_cast<double>(run_report.ticks);
  const std::string words = std::to_string(run_report.overruns) + " of " +
                            plural(static_cast<std::int64_t>(run_report.ticks), "tick", "ticks") + " missed";
  if (missed > late_share * ticks) return {false, "Device late: " + words};
  if (!soft_real_time(run_report).empty()) return {false, "Soft real time: no priority for the loop (" + words + ")"};
  return {true, "Device on time (" + words + "), forces rendered"};
}

SignCheck record(const AttemptView& view) {
  if (!view.result.integrity.empty()) return {false, "Remark in the record: " + view.result.integrity};
  if (!view.trace) return {false, "No recording to look at" + (view.no_trace.empty() ? "" : ": " + view.no_trace)};
  return {true, "Recording there, no remark in the record"};
}

}  // namespace

std::vector<SignCheck> sign_checks(const AttemptView& view) {
  const AttemptResult& result = view.result;
  return {finished(result), critical_events(result), safety_gates(result.grade), device(result.device, view.late_share),
          record(view)};
}

std::string sign_checklist(const AttemptView& view) {
  std::string out;
  for (const SignCheck& check : sign_checks(view))
    out += "<li" + std::string(check.fine ? "" : " class=\"bad\"") + ">" + shape(check.fine ? "pass" : "fail") +
           "<span class=\"unseen\">" + (check.fine ? "in order: " : "look at this: ") + "</span>" +
           escape_html(check.words) + "</li>";
  return "<h3>Before you sign</h3><ul class=\"checks\">" + out + "</ul>";
}

}  // namespace trocar::review
