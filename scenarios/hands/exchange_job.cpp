#include "scenarios/hands/exchange_job.h"

#include <algorithm>

namespace trocar {
namespace {

constexpr double kSwitchDown = 0.100, kSwitchUp = 0.35;  // s of a press of the exchange switch, to the next press
constexpr double kClearOfAll = 0.030;                    // m over the place that is asked for next
constexpr double kOutWithin = 0.020;                     // m, about
constexpr double kOpensAt = 0.030, kOpened = 0.012;      // m/s, m of jaws that let go of what they have

}  // namespace

bool ExchangeSwitch::press(const Percept& percept, double dt_s, HandIntent& intent) {
  since_press_s_ += dt_s;
  intent.exchange = intent.exchange && since_press_s_ < kSwitchDown;
  if (since_press_s_ < kSwitchUp) return false;
  if (!percept.asked_instrument || percept.instrument == *percept.asked_instrument) return true;
  since_press_s_ = 0;
  intent.exchange = true;
  return false;
}

void ExchangeJob::begin(const Percept& percept, const HandIntent& intent, HandRandom&) {
  const double up = std::max(0.0, percept.target_T.z() + kClearOfAll - percept.tip_T.z());
  plan_ = ReachPlan(intent.X_TI.p, intent.X_TI.p + up * Vec3::UnitZ(),
                    {0, Vec3::Zero(), 0, reach_time_s(up, kOutWithin, skill_.speed_factor)});
  in_step_s_ = 0;
}

void ExchangeJob::update(const Percept& percept, const HandSenses&, double dt_s, HandIntent& intent, HandRandom&) {
  in_step_s_ += dt_s;
  intent.pedal = false;
  intent.jaw_opening_m += std::clamp(kOpened - intent.jaw_opening_m, -kOpensAt * dt_s, kOpensAt * dt_s);
  intent.X_TI.p = plan_.at(in_step_s_);
  if (in_step_s_ > plan_.duration_s()) switch_.press(percept, dt_s, intent);
}

}  // namespace trocar
