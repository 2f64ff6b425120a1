#include "app/session/lanes/keyframe_tap.h"

#include <algorithm>
#include <cmath>

namespace trocar {
KeyframeTap::KeyframeTap(KeyframeRings* rings, const KeyframeRule& rule, double step_hz)
    : rings_(rings),
      rule_(rule),
      every_(static_cast<std::uint64_t>(std::max(1.0, std::round(step_hz / rule.rate_hz)))) {}

bool KeyframeTap::runs_on_from_last(const StylusState& seen, const DirectorStatus& status,
                                    const TissueFrame& tissue) const {
  if (!last_) return false;
  const StylusState& was = last_->seen;
  return seen.contact == was.contact && seen.tip_contact == was.tip_contact && seen.clutched == was.clutched &&
         seen.port_held == was.port_held && seen.fault.code == was.fault.code && runs_on(last_->status, status) &&
         runs_on(last_->tissue, tissue);
}

void KeyframeTap::tell(const StylusState& seen, const DirectorStatus& status, const World& world) {
  if (!rings_) return;
  const TissueShape shape = world.shape();
  for (; changes_told_ < shape.changes.size(); ++changes_told_)
    rings_->changes.push({seen.period, shape.changes[changes_told_]});
  const bool deforms = !shape.nodes_T.empty();
  if (seen.period == 0 || !(deforms || rule_.always)) return;
  const bool due = steps_++ % every_ == 0 || (deforms && shape.topology != topology_);
  if (!due && runs_on_from_last(seen, status, world.frame())) return;
  auto keyframe = std::make_shared<TissueKeyframe>();
  keyframe->period = seen.period;
  keyframe->status = status;
  keyframe->tissue = world.frame();
  last_ = {seen, status, world.frame()};
  if (due && deforms) {
    keyframe->shaped = true;
    keyframe->topology = topology_ = shape.topology;
    keyframe->nodes_T.assign(shape.nodes_T.begin(), shape.nodes_T.end());
    keyframe->fields.assign(shape.fields.begin(), shape.fields.end());
  }
  rings_->keyframes.push(keyframe);
}

}  // namespace trocar
