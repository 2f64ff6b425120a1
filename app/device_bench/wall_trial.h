// One press of the stylus into a flat wall on the plant: the trial of which the passivity, wall and Z-width studies are
// made.
//
// The hand leads the stylus along `direction` and aims some way beyond the wall; how fast it sets out is searched once,
// so that the stylus meets the wall at `speed` (within 3 %, on the plant without the wall). The prepared bench is
// copied for each law, so every law meets the same press to the bit. After a hold the hand leads the stylus out again:
// what a law has lent is given back then. Tool: a ball at the stylus origin, so the force has no moment. Times run from
// first touch. Frame W'. Thread: one owner.
#pragma once

#include <optional>
#include <vector>

#include "app/device_bench/comparison_laws.h"
#include "app/device_bench/plant_bench.h"

namespace trocar {

inline constexpr double kSettledBand = 0.1;  ///< N that a settled force may differ from its 50 ms mean (H5)

struct WallCase {
  /// Plant, rate, delay (of which the loop knows the fixed part), jitter, tremor, and the hand that presses.
  SimulatedDaqConfig device = nominal_device();
  double stiffness = 150;                  ///< N/m
  double gain = 1;                         ///< true amplifier gain over what the loop believes (the thesis had 5)
  double past_wall_m = 0.015;              ///< how far beyond the wall the hand aims (reference scenario)
  double speed = 0.45;                     ///< m/s of the stylus at first touch
  double speed_tolerance = 0.03;           ///< of it
  JointVector pose = JointVector::Zero();  ///< rad, where the hand sets out
  Vec3 direction = Vec3::UnitZ();          ///< unit, W', into the wall
  std::optional<double> stiffens_s;        ///< after touch the hand's grip turns firm ("the operator stabilises it")
  /// Most that a joint's motor gives for a short time over what the thesis drives; the amplifiers are set to it, and
  /// the loop knows.
  double peak = 1;
  bool compensated = true;  ///< weight and friction; with a gain that is not 1 compensation would be wrong by it
};

/// What may differ from press to press of one case.
struct WallPress {
  PassivityLaw law = PassivityLaw::kBudgeted;
  bool clamp = false;                         ///< contacts stiffer than K_max are weakened to it
  std::optional<double> stiffness = {};       ///< N/m, instead of the case's
  double damping_n_s_per_m = 0;               ///< of the wall at kDampingDepth: its force is k x (1 + 1.5 c v)
  std::optional<ComparisonLaw> instead = {};  ///< a law of another's in place of the loop's
};
inline constexpr double kDampingDepth = 0.002;  ///< m

struct WallTrace {
  std::vector<double> t, position_m, speed_m_s, force_n, observed_j, true_j;
  std::vector<double> net_j;     ///< true energy taken by the control, and by friction and cables of the arm
  std::vector<double> wanted_n;  ///< force of the spring as far as the motors can render it
};

struct WallOutcome {
  bool faulted = false;  ///< the loop shut down
  double touched_at_m_s = 0;
  double settled_s = 0;                 ///< last time at which |force - its centred 50 ms mean| >= kSettledBand
  int contacts = 0, late_contacts = 0;  ///< all; begun later than kSettleLimit and before the hand leaves
  double displayed = 0;        ///< rendered over commanded force at the end of the hold, as far as the motors can
  double shown_stiffness = 0;  ///< N/m, mean force over mean depth there
  double held_n = 0;           ///< mean force there
  double saturated = 0;        ///< share of that time in which the motors could not
  double least_true_j = 0;     ///< lowest true energy that the control had absorbed so far
  double least_net_j = 0;      ///< the same with what friction and cables of the arm took: below zero the hand was fed
  double law_step_n = 0;       ///< most that the force moved in a tick beyond the spring, saturated or not
  double shaking_n = 0;        ///< rms of the force above 30 Hz in the first second
  double overclaimed_j = 0;    ///< most that the observer, with sure friction, stood above the net energy
  double passive_share = 0;    ///< of the contact ticks in which the law acted
  double largest_step_n = 0;   ///< of the rendered force within one tick
  double k_max = 0;            ///< N/m, least that the loop worked out
  WallTrace trace;
  bool stable() const;
};
inline constexpr double kSettleLimit =
    0.5;  ///< s; a force that swings later, or more than two late contacts, is unstable
/// Stable, or no worse than a continuous wall before the same hand: settled at most 0.1 s later, no more late contacts.
bool stable_beside(const WallOutcome& ours, const WallOutcome& ideal);

/// The home orientation with the stylus drawn back until a press of `travel` along +-Y6 is comfortable: home itself is
/// nearly stretched (272 of 274 mm).
JointVector near_home(double travel_m);

/// A pose from which all of `travel` along the direction is comfortable: inside the joint limits, det A >= 0.35.
bool comfortable(const JointVector& pose, const Vec3& direction, double travel_m);

/// Way that a press needs from its pose on, m.
double press_travel(const WallCase& c);

class WallRig {
 public:
  /// Homes, goes to the pose, finds the reach; a speed beyond the hand's is replaced by its fastest.
  /// @throws BenchFault, std::invalid_argument for an uncomfortable path.
  explicit WallRig(const WallCase& c);

  /// Presses once from the prepared state. @param seconds after touch until the hand sets out to leave.
  WallOutcome press(const WallPress& how, double seconds) const;
  /// The same press into a continuous wall that pushes on the stylus itself, no harder than the motors could.
  WallOutcome press_ideal(double seconds) const;

  const WallCase& the_case() const { return case_; }
  double reach_s() const { return reach_s_; }

 private:
  WallOutcome press(PlantBench& bench, bool ideal, double seconds) const;
  Vec3 wall_point() const;
  Pose goal_at(double share) const;
  double speed_at_wall(double reach_s) const;

  WallCase case_;
  std::optional<PlantBench> ready_;
  Pose start_;
  double run_up_m_ = 0, reach_s_ = 0;
};

}  // namespace trocar
