// What a person's hand is at, for Steering: what it touches, whether something is to be gripped, and the ground that
// the tip glides over. Where instruments are worked in tissue the jaws are no matter of the act button.
//
// Before the clock runs the ground is the height of the start ball, so that two directions find it. Then, where the
// level lets a pointer glide: the organ from above, the height of the lit pen's tip, and over a board with blocks a
// height at which they are carried, from which the tip goes down by itself over the lit block and within its ring.
// Frame T, m. Thread: the window's.
#pragma once

#include <memory>

#include "app/session/run_moment.h"
#include "app/session/setup/scene.h"
#include "app/window/input/steering.h"

namespace trocar {

class Surroundings {
 public:
  /// @param scene outlives this.
  explicit Surroundings(const Scene& scene);
  ~Surroundings();

  /// @param hand where the hand has got to. The ground is this object's, until the next call.
  AtHand around(const RunMoment& moment, const HandIntent& hand);
  /// Point of what lies below, organ, board or block, but for a block that is held: what a shadow falls on.
  Vec3 below(const Vec3& p_T) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
