// How a person holds a force: a slow integrator of the felt error. Used for pressing (intent moves into the tissue) and
// for squeezing (intent closes the jaws).
//
// Felt force comes back after about 0.1 s and is smoothed; the integrator's crossover is about 0.5 Hz when the world
// (tissue in series with the hand) is as stiff as expected, so the loop keeps a margin up to twice that with foresight
// and three times without.
#pragma once

#include "scenarios/hands/hand_random.h"

namespace trocar {

class ForceGrip {
 public:
  struct Tuning {
    double expected_stiffness_n_per_m = 100;  ///< force per metre of intent
    double crossover_rad_per_s = 3;
    double fastest_mps = 0.04;
    double bias = 1, cv = 0;  ///< of the force aimed at
    double foresight_s = 0;   ///< how far ahead a change of the felt force is reckoned with
  };
  explicit ForceGrip(const Tuning& tuning) : tuning_(tuning) {}

  /// Starts a new hold: draws the force aimed at.
  void begin(double low_n, double high_n, HandRandom& random);
  /// Speed of the intent into the resistance, m/s. A force outside the band for long makes the person think again:
  /// the bias fades and a new goal is drawn; a force that comes and goes counts too, half the time inside is forgiven.
  double speed(double felt_n, double dt_s, HandRandom& random);
  /// Attention goes elsewhere and comes back: the goal is drawn anew, with what has been learnt so far.
  void shift_attention(HandRandom& random) { draw_goal(random); }
  double goal_n() const { return goal_n_; }

 private:
  void draw_goal(HandRandom& random);

  Tuning tuning_;
  double low_n_ = 0, high_n_ = 0, goal_n_ = 0;
  double outside_s_ = 0, wander_ = 0;
  double last_n_ = 0, rate_n_per_s_ = 0;  ///< of the felt force
  int thoughts_ = 0;
};

}  // namespace trocar
