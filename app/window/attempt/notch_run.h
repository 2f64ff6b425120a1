// The notch scene, live: the haptic loop on the simulated device, the walls, a hand that the window steers. Nothing is
// graded or kept.
//
//   NotchRun run(assets, seed);
//   while (open) { run.steer(intent); draw(run.newest()); }
//
// The walls are there from the moment the tip first rests in the middle of the slot. Threads: all members from the
// window's; the run owns the others.
#pragma once

#include <functional>
#include <memory>

#include "app/session/run_moment.h"
#include "app/window/attempt/notch_scene.h"
#include "scenarios/hands/hand.h"

namespace trocar {

class NotchRun {
 public:
  /// @throws InputError.
  NotchRun(const AssetRoots& assets, std::int64_t seed, const Notch& notch = {});
  /// Torque off, then the end.
  ~NotchRun();

  const Scene& scene() const;
  const Notch& notch() const;
  const RunMoment& newest();
  void steer(const HandIntent& intent);
  /// Whether the hand moves: the device is active.
  bool ready() const;
  void set_stiffness(double n_per_m);
  double stiffness() const;
  void pause(bool paused);
  /// The device has stopped by itself; why, in words, or empty.
  bool finished() const;
  std::string fault() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The same in simulated time, for tests and pictures. @param observe after each step of the walls, 100 a second.
void run_notch(const Scene& scene, double stiffness_n_per_m, std::unique_ptr<Hand> hand, double seconds,
               const std::function<void(const RunMoment&)>& observe);

}  // namespace trocar
