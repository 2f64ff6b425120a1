#include "scenarios/kinds/palpate/palpate_job.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kRasterFinest = 0.0052, kRasterShare = 0.0048;  // m of pitch, and as much more times settle_share
constexpr double kFeelAimReference = 0.060, kFeelAimFloor = 0.15;
constexpr double kClear = 0.008;        // m over the tissue between presses
constexpr double kFeelSeenLate = 0.16;  // s: the eyes are that late
constexpr double kFeelTouch = 0.15;     // N that counts as feeling the tissue ...
constexpr double kMostRelief = 0.015;   // m of the tissue over and under the region's middle, as it is seen
constexpr double kSetOff = 0.15;        // s of coming down before: what the arm needs to set off is not the tissue
constexpr double kDeepest = 0.035;      // m of coming down without meeting any
constexpr double kGoodGoal = 0.15;      // of the force aimed at: near enough to be judged
constexpr double kLongestPress = 1.6, kLook = 0.25;  // s, before speed_factor; s of judging
constexpr double kFeelJudgement = 0.25;              // of the force CV: error of the judged stiffness
constexpr double kApart = 0.013;                     // m from what was marked, or felt to be nothing
constexpr double kAbout = 0.010;                     // m round a place whose presses say where it is stiffest
constexpr double kStiffer = 1.04;                    // over what is usual: worth a mark
constexpr double kOnPlace = 0.002;                   // m off the place that needs no correction before a mark
constexpr double kFeelOpenJaw = 0.018, kFeelTightestJaw = -0.010;  // m
constexpr double kFeelJawSpeed = 0.030, kFeelClosing = 0.012;      // m/s, free and until the pad is felt
constexpr double kPinchLow = 0.8, kPinchHigh = 1.6;                // N, well above what marks
constexpr double kPinchFelt = 0.12;                                // N
constexpr double kLongestPinch = 6;                                // s
constexpr double kFeelSideGain = 4;                                // 1/s
constexpr int kBesides = 4;

}  // namespace

PalpateJob::PalpateJob(const HandSkill& skill)
    : skill_(skill),
      press_({60, 3.5, 0.04, skill.force_bias, skill.force_cv, 0.08}),
      pinch_({200, 3, 0.02, skill.force_bias, skill.force_cv}) {}

void PalpateJob::enter(Step step) {
  step_ = step;
  in_step_s_ = 0;
}

Vec3 PalpateJob::raster_place(const Percept& percept, int index) const {
  const int row = index / side_, along = index % side_, column = row % 2 == 0 ? along : side_ - 1 - along;
  const Vec3& size = percept.object.size_m;
  return percept.object.X_TO.p +
         Vec3(((column + 0.5) / side_ - 0.5) * size.x(), ((row + 0.5) / side_ - 0.5) * size.y(), 0);
}

/// Up from where the tip is, across, and to a hand's breadth over the place.
void PalpateJob::go_to(const Vec3& place_T, const Percept& percept, const HandIntent& intent, HandRandom& random) {
  goal_T_ = Vec3(place_T.x(), place_T.y(), surface_z_ + kClear);
  const Vec3 way = goal_T_ - percept.tip_T;
  const double distance = way.head<2>().norm(), k = skill_.speed_factor;
  ReachPlan::Shape shape;
  shape.travel_time_s = std::max(0.1, reach_time_s(distance, 0.006, k));
  shape.lift_m = std::max(0.0, kClear / 2 - std::max(0.0, way.z()));
  shape.sunk_m = std::max(0.0, percept.tip_T.z() - intent.X_TI.p.z());
  shape.lift_time_s = shape.lift_m > 0 ? reach_time_s(kClear, 0.008, k) : 0;
  const Vec3 across = Vec3::UnitZ().cross(way);
  if (across.norm() > 1e-6)
    shape.bulge = across.normalized() * (skill_.path_bulge * distance * (random.uniform() < 0.5 ? -1 : 1));
  const double noise = std::sqrt(std::min(1.0, distance / kFeelAimReference) + kFeelAimFloor);
  const Vec3 error = noise * skill_.aim_lateral_m * Vec3(random.normal(), random.normal(), 0);
  Vec3 to = goal_T_ + error;
  to.head<2>() += (intent.X_TI.p - percept.tip_T).head<2>();
  plan_ = ReachPlan(intent.X_TI.p, to, shape);
  enter(Step::kReach);
}

/// The plane through what has been felt: an organ is firmer towards one side than towards the other.
double PalpateJob::usual_stiffness(const Vec3& place_T) const {
  Mat3 sums = 1e-9 * Mat3::Identity();
  Vec3 felt = Vec3::Zero();
  for (std::size_t i = 0; i < felt_count_; ++i) {
    const Vec3 at(1, 1e2 * felt_[i].place_T.x(), 1e2 * felt_[i].place_T.y());
    sums += at * at.transpose();
    felt += felt_[i].stiffness * at;
  }
  return Vec3(1, 1e2 * place_T.x(), 1e2 * place_T.y()).dot(Vec3(sums.ldlt().solve(felt)));
}

Vec3 PalpateJob::middle_of(const Vec3& place_T) const {
  Vec3 sum = Vec3::Zero();
  double weight = 0;
  for (std::size_t i = 0; i < felt_count_; ++i) {
    if ((felt_[i].place_T - place_T).head<2>().norm() > kAbout) continue;
    const double more = std::max(0.0, felt_[i].stiffness - usual_stiffness(felt_[i].place_T));
    sum += more * more * more * felt_[i].place_T;
    weight += more * more * more;
  }
  return weight > 0 ? Vec3(sum / weight) : place_T;
}

/// The stiffest place that is not left; when everything is left, the stiffest of all is what remains.
void PalpateJob::choose(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  const Felt* best = nullptr;
  double most = 0;
  for (std::size_t i = 0; i < felt_count_; ++i) {
    const auto near = [&](const Vec3& place) { return (felt_[i].place_T - place).head<2>().norm() < kApart; };
    const bool left = std::any_of(left_.begin(), left_.begin() + static_cast<std::ptrdiff_t>(left_count_), near);
    const double more = felt_[i].stiffness / usual_stiffness(felt_[i].place_T);
    if (left || more <= most) continue;
    best = &felt_[i];
    most = more;
  }
  if (best == nullptr) {
    left_count_ = 0;
    raster_ = 1;
    aim_ = Aim::kRaster;
    return go_to(raster_place(percept, 0), percept, intent, random);
  }
  chosen_T_ = best->place_T;
  beside_ = 0;
  aim_ = skill_.max_corrections > 1 ? Aim::kBeside : Aim::kMark;
  next(percept, intent, random);
}

/// From what has just been felt to what is felt next.
void PalpateJob::next(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  corrections_ = 0;
  if (aim_ == Aim::kRaster) {
    if (raster_ < side_ * side_) return go_to(raster_place(percept, raster_++), percept, intent, random);
    return choose(percept, intent, random);
  }
  if (aim_ == Aim::kBeside && beside_ < kBesides) {
    const Vec3 side = beside_ % 2 == 0 ? Vec3::UnitX() : Vec3::UnitY();
    return go_to(chosen_T_ + (beside_++ < 2 ? 0.5 : -0.5) * pitch_m_ * side, percept, intent, random);
  }
  if (aim_ == Aim::kBeside) chosen_T_ = middle_of(chosen_T_);
  aim_ = Aim::kMark;
  go_to(chosen_T_, percept, intent, random);
}

void PalpateJob::begin(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  if (begun_) return;
  begun_ = true;
  const double pitch = kRasterFinest + kRasterShare * skill_.settle_share;
  side_ = std::max(2, static_cast<int>(std::ceil(percept.object.size_m.x() / pitch)));
  pitch_m_ = percept.object.size_m.x() / side_;
  surface_z_ = percept.object.X_TO.p.z() + kClear / 2;
  next(percept, intent, random);
}

void PalpateJob::judge(HandRandom& random) {
  const double depth = std::max(0.001, depth_sum_ / judged_);
  const double stiffness = force_sum_ / judged_ / depth * random.log_normal(kFeelJudgement * skill_.force_cv);
  if (felt_count_ < kMostFelt)
    felt_[felt_count_++] = {Vec3(place_sum_x_ / judged_, place_sum_y_ / judged_, touched_T_.z()), stiffness};
}

void PalpateJob::update(const Percept& percept, const HandSenses& senses, double dt_s, HandIntent& intent,
                        HandRandom& random) {
  in_step_s_ += dt_s;
  const double k = skill_.speed_factor;
  if (step_ != Step::kPinch) intent.jaw_opening_m = std::min(kFeelOpenJaw, intent.jaw_opening_m + kFeelJawSpeed * dt_s);
  if (touches()) {  // down, and held where the tissue was met: it is slippery, and it slopes
    intent.X_TI.p.z() -= press_.speed(senses.force_n(), dt_s, random) * dt_s;
    intent.X_TI.p.head<2>() += kFeelSideGain / k * dt_s * (touched_T_ - percept.tip_T).head<2>();
  }
  switch (step_) {
    case Step::kReach:
      intent.X_TI.p = plan_.at(in_step_s_);
      if (in_step_s_ > plan_.duration_s()) enter(Step::kLook);
      return;
    case Step::kLook:
      if (in_step_s_ < (aim_ == Aim::kMark ? kFeelSeenLate : 0.05)) return;
      if (aim_ == Aim::kMark && (goal_T_ - percept.tip_T).head<2>().norm() > kOnPlace &&
          corrections_ < skill_.max_corrections) {
        ++corrections_;
        return go_to(chosen_T_, percept, intent, random);
      }
      return enter(Step::kDescend);
    case Step::kDescend:
      intent.X_TI.p.z() -= skill_.approach_speed_mps / k * dt_s;
      if (senses.touch_n() > kFeelTouch && in_step_s_ > kSetOff) {
        touched_T_ = percept.tip_T;
        const double middle = percept.object.X_TO.p.z();
        surface_z_ = std::clamp(touched_T_.z(), middle - kMostRelief, middle + kMostRelief);
        press_.begin(percept.band_low_n, percept.band_high_n, random);
        force_sum_ = depth_sum_ = place_sum_x_ = place_sum_y_ = judged_s_ = 0;
        judged_ = 0;
        return enter(Step::kPress);
      }
      if (skill_.approach_speed_mps / k * in_step_s_ > kDeepest) next(percept, intent, random);
      return;
    case Step::kPress: {
      const bool there = std::abs(senses.force_n() - press_.goal_n()) < kGoodGoal * press_.goal_n();
      if (judged_ == 0 && !there && in_step_s_ < kLongestPress * k) return;
      if (judged_ == 0 && in_step_s_ < 0.4) return;
      force_sum_ += senses.force_n();
      depth_sum_ += touched_T_.z() - percept.tip_T.z();
      place_sum_x_ += percept.tip_T.x();
      place_sum_y_ += percept.tip_T.y();
      ++judged_;
      judged_s_ += dt_s;
      if (judged_s_ < kLook) return;
      judge(random);
      if (aim_ != Aim::kMark) return next(percept, intent, random);
      // Where it turns out to be as soft as elsewhere, a careful hand goes on searching.
      const bool nothing =
          felt_[felt_count_ - 1].stiffness < kStiffer * usual_stiffness(felt_[felt_count_ - 1].place_T);
      if (left_count_ < kMostPlaces) left_[left_count_++] = chosen_T_;
      if (nothing && skill_.max_corrections > 1 && left_count_ + 4 < kMostPlaces)
        return choose(percept, intent, random);
      pinch_.begin(kPinchLow, kPinchHigh, random);
      marks_share_ = percept.shown_share;
      return enter(Step::kPinch);
    }
    case Step::kPinch: {
      const bool felt = senses.grip_n() > kPinchFelt;
      const double closing = felt ? pinch_.speed(senses.grip_n(), dt_s, random) : kFeelClosing / k;
      intent.jaw_opening_m = std::clamp(intent.jaw_opening_m - closing * dt_s,
                                        std::min(kFeelTightestJaw, percept.jaw_opening_m), kFeelOpenJaw);
      if (percept.shown_share > marks_share_ || in_step_s_ > kLongestPinch) enter(Step::kLetGo);
      return;
    }
    case Step::kLetGo:
      if (in_step_s_ > skill_.reaction_s && percept.jaw_opening_m > 0.013) choose(percept, intent, random);
  }
}

}  // namespace trocar
