// A job with steps of its own: taking, carrying, searching, cutting. The skilled hand asks one of these for
// its intent while such a job is on; reaching, pressing and squeezing are its own.
//
// Each kind of exercise has its jobs in its room (scenarios/kinds). Frame T, SI units. Must not allocate after it is
// made.
#pragma once

#include "scenarios/hands/hand.h"
#include "scenarios/hands/hand_random.h"
#include "scenarios/hands/hand_senses.h"

namespace trocar {

class HandWork {
 public:
  virtual ~HandWork() = default;
  /// The job begins. @param intent what the hand wants at this moment.
  virtual void begin(const Percept& percept, const HandIntent& intent, HandRandom& random) = 0;
  /// One period: moves the intent.
  virtual void update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                      HandRandom& random) = 0;
  /// What is felt is the tissue's, as far as the person knows, and not the arm's alone.
  virtual bool touches() const { return false; }
};

}  // namespace trocar
