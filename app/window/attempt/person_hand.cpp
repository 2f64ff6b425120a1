#include "app/window/attempt/person_hand.h"

#include <algorithm>

namespace trocar {
namespace {

/// Scissors, clips and needles take all the force that there is.
bool can_squeeze_too_hard(InstrumentKind kind) {
  return kind == InstrumentKind::kGrasper || kind == InstrumentKind::kProbe;
}

double share_of(double way, double longest) { return way > longest ? longest / way : 1; }

}  // namespace

void PersonHand::follow(const HandIntent& wanted, const Percept& percept, double dt_s) {
  const Vec3 way = wanted.X_TI.p - intent_.X_TI.p;
  Vec3 step = share_of(way.norm(), kSpeed * dt_s) * way;
  const double felt_n = percept.felt_force_T.norm();
  if (entry_T_ && felt_n > 0) {
    const Vec3 out = percept.felt_force_T / felt_n;
    const double deeper = -step.dot(out), most = careful_.speed(felt_n) * dt_s;
    if (deeper > most) step += (deeper - most) * out;
    careful_.go(std::min(deeper, most));
  } else {
    careful_.leave();
  }
  intent_.X_TI.p += step;
  const Eigen::AngleAxisd turn(Mat3(wanted.X_TI.R * intent_.X_TI.R.transpose()));
  const double share = share_of(turn.angle(), kTurnSpeed * dt_s);
  if (share < 1)
    intent_.X_TI.R = Eigen::AngleAxisd(share * turn.angle(), turn.axis()).toRotationMatrix() * intent_.X_TI.R;
  else
    intent_.X_TI.R = wanted.X_TI.R;
  const double close = wanted.jaw_opening_m - intent_.jaw_opening_m;
  const bool gently = entry_T_ && percept.felt_grip_n > 0 && can_squeeze_too_hard(percept.instrument);
  const double closing = gently ? kFingerPress : kFingerSpeed;
  intent_.jaw_opening_m += std::clamp(close, -closing * dt_s, kFingerSpeed * dt_s);
  intent_.clutch = wanted.clutch;
  intent_.pedal = wanted.pedal;
  intent_.exchange = wanted.exchange;
}

/// @return whether the hand takes up the instrument again after a pause.
bool PersonHand::takes_up(double dt_s) {
  if (!pause_) return false;
  if (const std::int64_t stood_ns = pause_->stood_ns(); stood_ns != stood_ns_) {
    stood_ns_ = stood_ns;
    takes_up_s_ = kTakesUp;
  }
  takes_up_s_ -= dt_s;
  return takes_up_s_ > 0;
}

HandIntent PersonHand::update(const Percept& percept, double dt_s) {
  const bool ready = link_.ready.load(std::memory_order_relaxed);
  if (!holding_ || (!ready && percept.device_ready)) {
    intent_.X_TI = {percept.R_TI, percept.device_ready && entry_T_ ? *entry_T_ : percept.tip_T};
    if (!holding_) intent_.jaw_opening_m = percept.jaw_opening_m;
  }
  holding_ = true;
  if (!ready && percept.device_ready) link_.ready.store(true, std::memory_order_release);
  link_.felt.store(taken_, std::memory_order_release);  // the tick of the previous call is over
  if (ready) {
    const SteeredIntent& wanted = link_.wanted.read();
    if (takes_up(dt_s))
      intent_.clutch = true;
    else if (wanted.number > 0)
      follow(wanted.intent, percept, dt_s);
    taken_ = wanted.number;
  }
  link_.target.write(intent_);
  return intent_;
}

}  // namespace trocar
