#include "app/session/lanes/haptic_task.h"

namespace trocar {

void HapticTask::run(std::uint64_t tick) {
  const DaqSample sample = daq_.read();
  const ContactPatch& patch = ports_.patch.newest(tick);
  const DacFrame codes = loop_.tick(sample, patch, record_);
  daq_.arm(record_.amplifiers_armed);
  daq_.write(codes);
  record_.patch_stamp = patch.stamp;

  account_.add(record_);
  if (record_.stylus.loop == LoopState::kFault) since_fault_s_ += 1 / loop_.config().daq.rate_hz;
  hash_.add(record_);
  HapticState& state = ports_.tissue.begin(tick);
  state.stylus = record_.stylus;
  state.contacts = loop_.contacts();
  ports_.tissue.commit();
  if (ports_.observer) ports_.observer->write(tick, record_);
  if (ports_.recorder) ports_.recorder->push(record_);
  if (ports_.motors) ports_.motors->write(tick, loop_.motors());
}

bool HapticTask::finished() const { return since_fault_s_ > kAfterFault_s || record_.stylus.t_s > longest_s_; }

}  // namespace trocar
