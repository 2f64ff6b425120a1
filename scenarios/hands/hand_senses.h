// What a hand makes of its percept: forces late and smoothed, and a cue noticed only after the reaction time.
// Fixed memory; does not allocate.
#pragma once

#include <array>

#include "scenarios/hands/hand.h"

namespace trocar {

/// A signal that arrives `delay_s` later, smoothed over `smooth_s`.
class LateSignal {
 public:
  LateSignal(double delay_s, double smooth_s) : delay_s_(delay_s), smooth_s_(smooth_s) {}
  double update(double value, double dt_s);
  double value() const { return value_; }

 private:
  static constexpr int kSlots = 512;
  std::array<double, kSlots> ring_{};
  double delay_s_, smooth_s_, value_ = 0;
  int head_ = 0;
};

/// What the person is busy with; reaching, pressing and easing off one disc are one task.
struct HandJob {
  enum class Kind : std::uint8_t {
    kNothing,
    kStart,
    kDisc,
    kPen,
    kGrip,
    kBlock,
    kSearch,
    kLift,
    kAnswer,
    kClips,
    kSnips,
    kSewing,
    kHooking,
    kExchange,
    kFinished
  } kind = Kind::kNothing;
  static constexpr std::size_t kKinds = static_cast<std::size_t>(Kind::kFinished) + 1;
  std::int32_t target = -1;
  bool operator==(const HandJob&) const = default;
};

class HandSenses {
 public:
  explicit HandSenses(double reaction_s) : reaction_s_(reaction_s) {}
  void update(const Percept& percept, double pause_s, double dt_s);
  /// The task that has been noticed and thought over.
  const HandJob& task() const { return task_; }
  /// What the screen asks for now, perhaps not noticed yet.
  const HandJob& seen() const { return seen_; }
  /// Contact force against the target as judged for control: the bar, else the fingers.
  double force_n() const { return force_.value(); }
  /// Contact force against the target as felt, quick, for noticing contact: more than the arm asks for anyhow.
  double touch_n() const { return touch_.value() - free_n_; }
  /// A bar has told how the felt force is to be taken.
  bool knows_bar() const { return knows_bar_; }
  /// Until said otherwise: is what is felt that of the arm alone? Then the fingers get used to it.
  void set_used_to_it(bool used) { gets_used_ = used; }
  double grip_n() const { return grip_.value(); }

 private:
  double reaction_s_, noticed_for_s_ = 0;
  HandJob task_, seen_;
  LateSignal force_{0.12, 0.05}, touch_{0.06, 0.02}, grip_{0.08, 0.04};
  double free_n_ = 0;     ///< what the arm's weight and friction make the fingers feel
  double missing_n_ = 0;  ///< what the bar has shown more than the fingers felt
  bool gets_used_ = true, knows_bar_ = false;
  bool pulls_ = false;  ///< what is felt is tissue that is held, not tissue that is pressed
};

}  // namespace trocar
