#include "haptics/control/homing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "haptics/device/index_mark.h"

namespace trocar {
namespace {

constexpr int kRoll = kArmJoints - 1;
constexpr std::uint8_t kAllJoints = (1u << kArmJoints) - 1;
constexpr double kRested_s = 0.1;  // still for so long: what moves then disturbs

}  // namespace

void Homing::begin() {
  report_ = {};
  place_.setZero(), offset_.setZero(), mark_.setZero();
  marked_ = 0;
  waited_s_ = beam_s_ = unlit_s_ = still_s_ = 0;
  roll_sign_ = entered_sign_ = 0;
  dark_seen_ = always_lit_ = false;
  upward_ = downward_ = {};
}

bool Homing::still(const Counts& delta) const {
  for (std::size_t i = 0; i < kChannels; ++i)
    if (std::abs(std::int64_t{delta[i]}) > limits_.still_counts[i]) return false;
  return true;
}

void Homing::follow(const DaqSample& in, const Counts& delta) {
  for (int i = 0; i < kChannels; ++i) place_[i] += delta[static_cast<std::size_t>(i)];
  if (const int joint = marked_joint(in.digital_in); joint >= 0 && joint < kArmJoints) {
    mark_[joint] = place_[joint];
    marked_ = static_cast<std::uint8_t>(marked_ | 1u << joint);
  }
  const std::int32_t roll = delta[kRoll];
  if (roll != 0) roll_sign_ = roll > 0 ? 1 : -1;
}

void Homing::see_light(bool beam) {
  if (beam && beam_s_ == 0) {
    lit_from_ = lit_to_ = place_;
    lit_place_ = place_[kRoll];
    entered_sign_ = dark_seen_ ? roll_sign_ : 0;
  }
  if (!beam && unlit_s_ == 0 && beam_s_ >= limits_.debounce_s) entered_sign_ = 0;
  beam_s_ = beam ? beam_s_ + period_s_ : 0;
  unlit_s_ = beam ? 0 : unlit_s_ + period_s_;
  if (unlit_s_ >= limits_.debounce_s) {
    dark_seen_ = true;
    always_lit_ = false;
  }
  if (!beam) return;
  if (report_.step == HomingStep::kMarks) lit_from_ = lit_to_ = place_;  // joint 5 turns about the light itself
  lit_from_ = lit_from_.cwiseMin(place_), lit_to_ = lit_to_.cwiseMax(place_);
  always_lit_ = always_lit_ || (lit_to_ - lit_from_).head<kArmJoints>().maxCoeff() > limits_.lit_travel;
  if (beam_s_ >= limits_.debounce_s && entered_sign_ != 0) {
    (entered_sign_ > 0 ? upward_ : downward_) = {true, lit_place_};
    entered_sign_ = 0;
  }
}

void Homing::see_motion(const Counts& delta) {
  if (still(delta)) {
    still_s_ += period_s_;
    return;
  }
  if (report_.step == HomingStep::kStill && still_s_ >= kRested_s) {
    std::size_t moved = 0;
    while (moved + 1 < kChannels && std::abs(std::int64_t{delta[moved]}) <= limits_.still_counts[moved]) ++moved;
    tell(HomingTrouble::kMoved, static_cast<int>(moved), delta[moved]);
  }
  still_s_ = 0;
}

HomingStep Homing::next_step() const {
  if (model_.method == HomingMethod::kIndex && (marked_ & kAllJoints) != kAllJoints) return HomingStep::kMarks;
  const bool needs_dark = model_.see_dark || model_.method == HomingMethod::kEdges;
  if (beam_s_ == 0 || always_lit_) return HomingStep::kJig;
  if (needs_dark && !dark_seen_) return HomingStep::kRoll;
  if (model_.method == HomingMethod::kEdges && !(upward_.seen && downward_.seen)) return HomingStep::kRoll;
  return HomingStep::kStill;
}

void Homing::find_trouble() {
  const HomingTrouble now = report_.trouble;
  const bool dark = unlit_s_ >= limits_.dark_s;
  if (always_lit_) return tell(HomingTrouble::kAlwaysLit, -1, 0);
  if (dark) return tell(HomingTrouble::kDark, -1, unlit_s_);
  if (now == HomingTrouble::kAlwaysLit || now == HomingTrouble::kDark ||
      (now == HomingTrouble::kMoved && report_.step != HomingStep::kStill))
    tell(HomingTrouble::kNone, -1, 0);
  if (waited_s_ >= limits_.limit_s && report_.trouble == HomingTrouble::kNone)
    tell(HomingTrouble::kTimeout, -1, waited_s_);
}

/// Where home lies, from what was seen. @return nothing speaks against it.
bool Homing::settle() {
  offset_.setZero();
  if (model_.method == HomingMethod::kEdges) {
    const double wide = downward_.place - upward_.place;
    if (wide < limits_.window_least || wide > limits_.window_most) {
      tell(wide == 0 ? HomingTrouble::kDeadChannel : HomingTrouble::kWrongPose, kRoll, wide);
      upward_ = downward_ = {};  // to be turned through anew
      return false;
    }
    offset_[kRoll] = place_[kRoll] - 0.5 * (downward_.place + upward_.place);
  }
  if (model_.method != HomingMethod::kIndex) return true;
  for (int i = 0; i < kArmJoints; ++i) {
    const double home = mark_[i] - model_.index_counts[static_cast<std::size_t>(i)];
    offset_[i] = std::remainder(place_[i] - home, limits_.index_turn);
    if (std::abs(offset_[i]) <= (i == kRoll ? limits_.roll_counts : limits_.jig_counts)) continue;
    tell(HomingTrouble::kWrongPose, i, offset_[i]);
    return false;
  }
  return true;
}

bool Homing::update(const DaqSample& in, const Counts& delta) {
  waited_s_ += period_s_;
  follow(in, delta);
  see_light(in.digital_in & kHomeBeam);
  see_motion(delta);
  report_.step = next_step();
  report_.missing = model_.method == HomingMethod::kIndex ? static_cast<std::uint8_t>(kAllJoints & ~marked_) : 0;
  find_trouble();
  const bool ready = report_.step == HomingStep::kStill && beam_s_ >= limits_.beam_s && still_s_ >= limits_.still_s;
  if (!ready || !settle()) return false;
  report_ = {.step = HomingStep::kHomed};
  return true;
}

ChannelVector Homing::marks() const {
  ChannelVector out = ChannelVector::Constant(std::numeric_limits<double>::quiet_NaN());
  for (int i = 0; i < kChannels; ++i)
    if (marked_ >> i & 1) out[i] = std::remainder(mark_[i] - (place_[i] - offset_[i]), limits_.index_turn);
  return out;
}

}  // namespace trocar
