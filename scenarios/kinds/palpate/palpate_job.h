// How a simulated person feels an organ for what is hidden in it: presses it at the points of a raster, one after the
// other, with about the same force; judges at each how stiff it is, the felt force over the depth under the surface
// that all touches tell; puts together what all presses say, for single ones err by as much as a nodule changes them;
// presses beside the likeliest places, thinks again after each, and marks the middles of the likeliest by a long pinch,
// until the exercise has enough.
//
// A finer raster is that of a hand that is content with little error (HandSkill::settle_share); who corrects more feels
// more often beside a place before marking it. Knows nothing but the Percept. Frame T, m, N. Thread: the hand task's,
// once a loop period; does not allocate.
#pragma once

#include <array>

#include "scenarios/hands/force_grip.h"
#include "scenarios/hands/hand_script.h"
#include "scenarios/hands/hand_work.h"
#include "scenarios/hands/minimum_jerk.h"

namespace trocar {

class PalpateJob : public HandWork {
 public:
  static constexpr std::size_t kMostFelt = 160, kMostLumps = 8;

  explicit PalpateJob(const HandSkill& skill);

  void begin(const Percept& percept, const HandIntent& intent, HandRandom& random) override;
  void update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
              HandRandom& random) override;
  bool touches() const override { return step_ == Step::kPress || step_ == Step::kPinch || step_ == Step::kLetGo; }

 private:
  enum class Step : std::uint8_t { kReach, kLook, kDescend, kPress, kPinch, kLetGo };
  enum class Aim : std::uint8_t { kRaster, kBeside, kMark };

  /// A place that was pressed.
  struct Felt {
    Vec3 place_T = Vec3::Zero();  ///< of the tip while it presses
    double touched_z_m = 0;
    double force_n = 0;  ///< as judged
  };
  struct Places {
    std::array<Vec3, kMostLumps> at{};
    std::size_t count = 0;
    void add(const Vec3& place_T) {
      if (count < kMostLumps) at[count++] = place_T;
    }
  };
  void enter(Step step);
  void go_to(const Vec3& place_T, const Percept& percept, const HandIntent& intent, HandRandom& random);
  void next(const Percept& percept, const HandIntent& intent, HandRandom& random);
  Vec3 raster_place(const Percept& percept, int index) const;
  void judge(HandRandom& random);
  /// Middle of the lump that explains most of what was felt, beside those that are known: over a plane, for an organ is
  /// firmer towards one side than towards the other, lie lumps of a known width; none farther out than was pressed.
  Vec3 next_lump(const Places& known, const Percept& percept) const;
  using Curved = Eigen::Matrix<double, 6, 1>;  ///< 1, x, y, x^2, xy, y^2, and factors of them
  Curved touched_surface(const Vec3& middle_T, double half_m) const;

  HandSkill skill_;
  ForceGrip press_, pinch_;
  ReachPlan plan_;
  Step step_ = Step::kReach;
  Aim aim_ = Aim::kRaster;
  int side_ = 1, raster_ = 0, beside_ = 0, corrections_ = 0;
  double pitch_m_ = 0;
  Vec3 goal_T_ = Vec3::Zero(), chosen_T_ = Vec3::Zero(), touched_T_ = Vec3::Zero();
  double surface_z_ = 0;
  bool begun_ = false;
  double in_step_s_ = 0, judged_s_ = 0, force_sum_ = 0;
  Vec3 place_sum_ = Vec3::Zero();
  int judged_ = 0;
  std::array<Felt, kMostFelt> felt_;
  std::size_t felt_count_ = 0;
  Places tried_, marked_;
  double marks_share_ = 0;  ///< as seen when the pinch began
};

}  // namespace trocar
