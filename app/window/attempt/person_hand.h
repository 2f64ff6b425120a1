// The hand of a person at mouse, keys, pad or SpaceMouse: goes where the newest intent says, no faster than a person
// could.
//
// It takes hold where the instrument is and rests there until the device is ready and a first intent has come. A leap
// of the intent (the pointer has crossed the window at once) becomes a movement at kSpeed, so that it cannot throw the
// arm; without a device it brings the instrument in and is careful with what it touches. The spring between this hand
// and the stylus is the plant's own (haptics/device/plant/hand_model.h). Frame T, SI. No allocation, no lock: wait-free
// on both sides. Threads: update() the haptic task's; the link's other ends belong to one more.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <utility>

#include "app/session/lanes/pause_switch.h"
#include "app/window/input/careful_press.h"
#include "haptics/exchange/latest.h"
#include "scenarios/hands/hand.h"

namespace trocar {

/// An intent and its number, counted from 1.
struct SteeredIntent {
  HandIntent intent;
  std::uint64_t number = 0;
};

/// Between the window and the hand; outlives both.
struct HandLink {
  Latest<SteeredIntent> wanted;        ///< window to hand
  Latest<HandIntent> target;           ///< hand to window: where the hand pulls to now
  std::atomic<bool> ready{false};      ///< the hand moves: the device is active and soft start is over
  std::atomic<std::uint64_t> felt{0};  ///< newest intent that a finished tick of the loop has had
};

class PersonHand final : public Hand {
 public:
  static constexpr double kSpeed =
      0.5;  ///< m/s: peak of fast reaches over 10 cm; keeps a leap of the pointer a movement
  static constexpr double kTurnSpeed = 6;       ///< rad/s
  static constexpr double kFingerSpeed = 0.05;  ///< m/s: fully open to closed in 0.4 s

  static constexpr double kTakesUp = 0.03;  ///< s: some steps of the director

  static constexpr double kFingerPress =
      0.0012;  ///< careful: of the fingers on what a grasper can crush, 0.36 N/s at 300 N/m

  /// @param link outlives the hand. @param entry_T without a device: where the hand brings the instrument in. Nothing
  /// pushes back then, and what is touched is pressed slowly, so that a force can be had by eye.
  /// @param pause outlives the hand. After each one the instrument is clutched for kTakesUp: a hold that was going on
  /// begins anew, so that a person cannot stop the world, look, and go on within it. As the clutch is recorded, so is
  /// this.
  explicit PersonHand(HandLink& link, std::optional<Vec3> entry_T = {}, const PauseSwitch* pause = nullptr)
      : link_(link), entry_T_(std::move(entry_T)), pause_(pause) {}
  HandIntent update(const Percept& percept, double dt_s) override;

 private:
  bool takes_up(double dt_s);
  void follow(const HandIntent& wanted, const Percept& percept, double dt_s);

  HandLink& link_;
  std::optional<Vec3> entry_T_;
  const PauseSwitch* pause_;
  std::int64_t stood_ns_ = 0;  ///< pauses that have been taken up
  double takes_up_s_ = 0;      ///< left of it
  HandIntent intent_;
  std::uint64_t taken_ = 0;  ///< number of the newest intent
  bool holding_ = false;
  CarefulPress careful_;
};

}  // namespace trocar
