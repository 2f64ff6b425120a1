// The hand task: gives a scripted hand its percept, late and noisy, and hands its intent to the simulated device.
//
// What is seen, the jaws' opening too, lags by 150 ms and errs by 0.3 mm; felt forces err by 0.03 N and do not lag here
// (what a person makes of them late is the hand's part, hand_senses.h): design choices, named here. The force felt is
// the simulated device's own on the hand, with friction, inertia, saturation and whatever the amplifiers make of it. A
// person takes it for a force at the tip, in the newtons of the force bar: the instrument map is what practice has
// taught. Nothing of the world goes to the hand but the Percept. It is part of the simulated world: it runs beside the
// device, once a period of it, also in periods that the loop missed. Thread: the haptic task's, before it.
#pragma once

#include <memory>
#include <vector>

#include "app/session/lanes/exercise_frame.h"
#include "app/session/lanes/haptic_task.h"
#include "app/session/lanes/task.h"
#include "app/session/setup/scene.h"
#include "haptics/device/simulated_world.h"
#include "scenarios/hands/hand.h"
#include "scenarios/hands/hand_random.h"

namespace trocar {

class HandTask final : public Task {
 public:
  static constexpr double kEyeDelay_s = 0.150;
  static constexpr double kEyeError_m = 0.3e-3;  ///< SD on each axis, redrawn every 20 ms
  static constexpr double kTouchError_n = 0.03;  ///< SD
  static constexpr double kReadyAfter_s = 1.1;   ///< the lamp lights when the soft start is over
  static constexpr double kPressAfter_s = 0.2;   ///< from the lamp that says "homed" to the thumb on the deadman

  HandTask(const Scene& scene, const HapticTask& haptic, Inlet<ExerciseFrame>& frames, std::unique_ptr<Hand> hand,
           SimulatedWorld& world);

  std::uint32_t period() const override { return 1; }
  void run(std::uint64_t tick) override;
  /// The person goes on while the loop is late, and so does the device: period by period.
  void missed(std::uint64_t periods) override;

 private:
  Percept perceive(std::uint64_t tick);
  struct Seen {
    Pose X_TI;
    double jaw_opening_m = 0;
  };
  Seen see();
  Vec3 feel_T(const HandSense& sense);
  void draw_eye_error(const DirectorStatus& status);
  void press_deadman();

  const Scene& scene_;
  const HapticTask& haptic_;
  Inlet<ExerciseFrame>& frames_;
  std::unique_ptr<Hand> hand_;
  SimulatedWorld& world_;
  HandRandom random_;
  std::vector<Seen> past_;  ///< ring over the eye's delay
  Pose stylus_W_;           ///< where the hand wants the stylus
  std::vector<SeenObject> past_objects_;
  Vec3 eye_error_ = Vec3::Zero();
  double jaw_error_m_ = 0;
  std::uint64_t active_ticks_ = 0, homed_ticks_ = 0, periods_ = 0;
  std::uint64_t periods_of_target_ = 0;  ///< since what is shown changed
  Cue shown_ = Cue::kNone;
  int shown_target_ = -1;
  std::uint64_t targets_ = 0;
};

}  // namespace trocar
