#include "app/executor/recorder_task.h"

#include <span>

namespace trocar {

TraceSample trace_sample(const StylusState& state) {
  TraceSample sample;
  sample.t_s = state.t_s;
  sample.tip_T = state.X_TI.p;
  sample.shaft_T = state.X_TI.R.col(2);
  sample.force_T = state.F_I_T.force;
  sample.rendered_n = state.rendered_force_T.norm();
  sample.grip_n = state.grip_force_n;
  sample.jaw_opening_m = state.jaw_opening_m;
  sample.contact = state.contact;
  sample.saturated = state.saturated;
  sample.passivity_active = state.passivity_active;
  return sample;
}

void RecorderTask::run(std::uint64_t) {
  const TickRecord& record = haptic_.record();
  writer_.append(quantise(record.stylus.period, record.in, trace_sample(record.stylus), record.stylus.loop,
                          static_cast<std::uint8_t>(director_.status().phase)));
  append_new_events();
}

void RecorderTask::append_new_events() {
  const auto& events = director_.events();
  if (events.size() == events_written_) return;
  writer_.append_events(std::span(events).subspan(events_written_));
  events_written_ = events.size();
}

}  // namespace trocar
