// What a person's hand is at, for Steering: what it touches, whether something is to be gripped, and the ground that
// the tip glides over.
//
// Before the clock runs the ground is the height of the start ball, so that two directions find it. Then, where the
// level lets a pointer glide: the organ from above, the board under blocks, the height of the lit pen's tip. Frame T,
// m. Thread: the window's.
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
  AtHand around(const TickRecord& record, const DirectorStatus& status, const HandIntent& hand);
  /// Point of what lies below, seen from above: what a shadow falls on.
  Vec3 below(const Vec3& p_T) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
