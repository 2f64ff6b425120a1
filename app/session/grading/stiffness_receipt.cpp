#include "app/session/grading/stiffness_receipt.h"

#include <algorithm>

namespace trocar {

StiffnessReceipt stiffness_receipt(std::span<const RecordedTick> rows, bool clamped) {
  StiffnessReceipt receipt;
  receipt.clamped = clamped;
  std::uint64_t above = 0;
  for (const RecordedTick& row : rows) {
    if (row.stiffness == kNotRepresentable || row.k_max == kNotRepresentable) continue;
    receipt.recorded = true;
    if (row.stiffness <= 0 || row.k_max <= 0) continue;
    const double asked = row.stiffness * kStiffnessQuantum, k_max = row.k_max * kStiffnessQuantum;
    const bool first = receipt.contact_ticks++ == 0;
    receipt.k_max_min_n_per_m = first ? k_max : std::min(receipt.k_max_min_n_per_m, k_max);
    receipt.k_max_max_n_per_m = std::max(receipt.k_max_max_n_per_m, k_max);
    receipt.asked_max_n_per_m = std::max(receipt.asked_max_n_per_m, asked);
    receipt.share_min = std::min(receipt.share_min, k_max / asked);
    above += asked > k_max ? 1 : 0;
  }
  if (receipt.contact_ticks > 0)
    receipt.above_share = static_cast<double>(above) / static_cast<double>(receipt.contact_ticks);
  return receipt;
}

}  // namespace trocar
