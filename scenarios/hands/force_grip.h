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
    double patience_s = 1e9;  ///< inside the band as felt, and nothing comes of it: then another force is tried
  };
  explicit ForceGrip(const Tuning& tuning) : tuning_(tuning) {}

  /// Starts a new hold: draws the force aimed at.
  void begin(double low_n, double high_n, HandRandom& random);
  /// Speed of the intent into the resistance, m/s. A force outside the band for long makes the person think again:
  /// the bias fades and a new goal is drawn; a force that comes and goes counts too, half the time inside is forgiven.
  /// A force inside the band that brings no success has been felt wrongly: others are tried, below and above, further
  /// off each time.
  double speed(double felt_n, double dt_s, HandRandom& random);
  /// Attention goes elsewhere and comes back: the goal is drawn anew, with what has been learnt so far.
  void shift_attention(HandRandom& random) { draw_goal(random); }
  /// The hold was accepted: the felt force was, on the average, the middle of the band.
  void succeeded();
  double goal_n() const { return goal_n_; }
  /// Nothing helped: better to let go and begin afresh.
  bool gives_up() const { return trials_ > kMostTrials; }

 private:
  static constexpr int kMostTrials = 2;

  void draw_goal(HandRandom& random);
  void try_another(HandRandom& random);

  Tuning tuning_;
  double low_n_ = 0, high_n_ = 0, goal_n_ = 0;
  double outside_s_ = 0, inside_s_ = 0, wander_ = 0;
  double wrong_n_ = 0, taught_n_ = 0;     ///< what the felt force is believed to have too much, N; by what succeeded
  double last_n_ = 0, rate_n_per_s_ = 0;  ///< of the felt force
  int thoughts_ = 0, trials_ = 0, first_way_ = 1;
};

}  // namespace trocar
