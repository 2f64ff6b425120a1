#include "app/executor/state_hash.h"

#include <cstdio>

namespace trocar {

void StateHash::add(const TickRecord& r) {
  const StylusState& s = r.stylus;
  for (const auto count : r.in.counts) add(static_cast<std::uint64_t>(count));
  for (const auto code : r.out.codes) add(static_cast<std::uint64_t>(code));
  add(std::uint64_t{r.in.elapsed_periods} << 32 | std::uint64_t{r.in.valid} << 24 | r.in.digital_in);
  add(std::uint64_t{r.amplifiers_armed} | std::uint64_t(s.loop) << 8 | std::uint64_t(s.fault.code) << 16 |
      std::uint64_t{s.contact} << 24 | std::uint64_t{s.saturated} << 25 | std::uint64_t{s.passivity_active} << 26);
  add(r.q);
  add(r.qd);
  add(r.torque);
  add(s.X_TI.R);
  add(s.X_TI.p);
  add(s.F_I_T.force);
  add(s.F_I_T.moment);
  add(s.rendered_force_T);
  for (const double value : {r.winding_c, r.det_a, s.t_s, s.jaw_opening_m, s.grip_force_n, s.depth_m, s.energy_j}) {
    add(value);
  }
}

void StateHash::add(const ContactPatch& patch) {
  add(patch.stamp);
  add(static_cast<std::uint64_t>(patch.count) << 32 | static_cast<std::uint32_t>(patch.dropped));
  for (int i = 0; i < patch.count; ++i) add(static_cast<std::uint64_t>(patch.triangle[i].id));
  add(patch.stiffness_n_per_m);
  add(patch.grip.thickness_m);
  add(patch.grip.stiffness_n_per_m);
}

void StateHash::add(const DirectorStatus& status) {
  add(std::uint64_t(status.phase) | std::uint64_t(status.cue) << 8 |
      static_cast<std::uint64_t>(status.targets_done) << 16 | static_cast<std::uint64_t>(status.wrong_places) << 32);
  add(static_cast<std::uint64_t>(status.target_index + 1) << 32 | static_cast<std::uint64_t>(status.excess_forces));
  add(status.run_time_s);
  add(status.hold_progress);
  add(status.peak_force_n);
}

std::string StateHash::hex() const {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(state_));
  return digits;
}

}  // namespace trocar
