#include "app/session/grading/stiffness_report.h"

#include <algorithm>

namespace trocar {

StiffnessReport stiffness_report(std::span<const RecordedTick> rows, bool clamped) {
  StiffnessReport report;
  report.clamped = clamped;
  std::uint64_t above = 0;
  for (const RecordedTick& row : rows) {
    if (row.stiffness == kNotRepresentable || row.k_max == kNotRepresentable) continue;
    report.recorded = true;
    if (row.stiffness <= 0 || row.k_max <= 0) continue;
    const double asked = row.stiffness * kStiffnessQuantum, k_max = row.k_max * kStiffnessQuantum;
    const bool first = report.contact_ticks++ == 0;
    report.k_max_min_n_per_m = first ? k_max : std::min(report.k_max_min_n_per_m, k_max);
    report.k_max_max_n_per_m = std::max(report.k_max_max_n_per_m, k_max);
    report.asked_max_n_per_m = std::max(report.asked_max_n_per_m, asked);
    report.share_min = std::min(report.share_min, k_max / asked);
    above += asked > k_max ? 1 : 0;
  }
  if (report.contact_ticks > 0)
    report.above_share = static_cast<double>(above) / static_cast<double>(report.contact_ticks);
  return report;
}

}  // namespace trocar
