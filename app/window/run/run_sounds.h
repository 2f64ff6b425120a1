// What is heard of an attempt: every sound stands for something that is seen as well. Thread: the window's.
#pragma once

#include "app/session/run_moment.h"
#include "app/window/sound/sound.h"

namespace trocar {

class RunSounds {
 public:
  /// Tones between the moment heard last and this one.
  void hear(const Scene& scene, const RunMoment& moment, Sound& sound);
  /// Nothing lasts: a pause, or the end.
  static void hush(Sound& sound) {
    sound.hold_force(0);
    sound.hold_cautery(0);
  }

 private:
  /// A force passes the end of its band, the port holds the instrument back, or an object was not done in its time.
  bool warns(const Scene& scene, const RunMoment& moment, double over);

  bool any_ = false, contact_ = false, fault_ = false, ended_ = false, over_ = false, held_ = false;
  int done_ = 0, errors_ = 0, timeouts_ = 0;
};

/// How far a force is over its band, 0 at its upper end, 1 at the hard limit and above; 0 where the level shows no
/// force during the run.
double force_tone(const Scene& scene, const RunMoment& moment);

}  // namespace trocar
