#include "app/session/lanes/recorder_task.h"

#include <span>
#include <utility>

namespace trocar {

TraceSample trace_sample(const TickRecord& record) {
  const StylusState& state = record.stylus;
  TraceSample sample;
  sample.t_s = state.t_s;
  sample.tip_T = state.X_TI.p;
  sample.shaft_T = state.X_TI.R.col(2);
  sample.force_T = state.F_I_T.force;
  sample.commanded_n = state.commanded_force_T.norm();
  sample.rendered_n = state.rendered_force_T.norm();
  sample.grip_n = state.grip_force_n;
  sample.jaw_opening_m = state.jaw_opening_m;
  sample.contact = state.contact;
  sample.saturated = state.saturated;
  sample.passivity_active = state.passivity_active;
  sample.pedal = state.pedal;
  sample.instrument = state.instrument;
  sample.stiffness_n_per_m = record.stiffness_n_per_m;
  if (record.stiffness_n_per_m > 0) sample.k_max_n_per_m = record.k_max_n_per_m;
  return sample;
}

void RecorderTask::drain() {
  // Ticks before steps: the step that made a patch is in its ring before any tick can see the patch.
  for (TickRecord record; rings_.ticks.pop(record);) waiting_.push_back(record);
  for (TissueStep step; rings_.steps.pop(step);) {
    unused_.push_back(step);
    writer_.append_step(step.seen_period);
    seen_period_ = step.seen_period;
  }
  for (std::shared_ptr<TissueKeyframe> keyframe; rings_.tissue.keyframes.pop(keyframe);)
    keyframes_.push_back(std::move(keyframe));
  for (TopologyEvent change; rings_.tissue.changes.pop(change);) writer_.append_change(std::move(change));
  for (Event event; rings_.events.pop(event);) writer_.append_events(std::span(&event, 1));
}

void RecorderTask::write(const TickRecord& record) {
  const StylusState& state = record.stylus;
  for (; !unused_.empty() && unused_.front().seen_period <= state.period; unused_.pop_front()) {
    phase_ = unused_.front().phase;
  }
  if (record.patch_stamp != patch_stamp_) writer_.append_patch({state.period, record.patch_stamp});
  patch_stamp_ = record.patch_stamp;
  for (; !keyframes_.empty() && keyframes_.front()->period <= state.period; keyframes_.pop_front()) {
    keyframes_.front()->instrument = detail_of(record);
    writer_.append_keyframe(std::move(*keyframes_.front()));
  }
  writer_.append(quantise(state.period, record.in, trace_sample(record), state.loop, phase_));
}

void RecorderTask::run(std::uint64_t) {
  drain();
  for (; !waiting_.empty() && waiting_.front().stylus.period <= seen_period_; waiting_.pop_front()) {
    write(waiting_.front());
  }
}

void RecorderTask::stop() {
  drain();
  for (; !waiting_.empty(); waiting_.pop_front()) write(waiting_.front());
}

}  // namespace trocar
