#include "scenarios/kinds/palpate/palpate_job.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kRasterFinest = 0.0035, kRasterShare = 0.0068;  // m of pitch, and as much more times settle_share
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
constexpr double kApart = 0.013;                     // m from what was marked
constexpr double kLumpWidth = 0.007;                 // m from its middle at which a lump is felt by 1/e of the most
constexpr double kLumpStep = 0.002;                  // m, of the places that are thought of
constexpr double kFeltEnough = 0.3;  // of one press right over it, below which nothing is known of a place
constexpr double kOnPlace = 0.002;   // m off the place that needs no correction before a mark
constexpr double kFeelOpenJaw = 0.018, kFeelTightestJaw = -0.010;  // m
constexpr double kFeelJawSpeed = 0.030, kFeelClosing = 0.012;      // m/s, free and until the pad is felt
constexpr double kPinchLow = 0.8, kPinchHigh = 1.6;                // N, well above what marks
constexpr double kPinchFelt = 0.12;                                // N
constexpr double kLongestPinch = 6;                                // s
constexpr double kFeelSideGain = 4;                                // 1/s
constexpr int kBesides = 4;
constexpr std::size_t kTries = 3;  // places that are felt more closely before any is marked

constexpr double kLeastDepth = 0.001;  // m

/// Terms of a curved surface over the region.
Eigen::Matrix<double, 6, 1> curved(const Vec3& at_T, const Vec3& middle_T, double half_m) {
  const double x = (at_T - middle_T).x() / half_m, y = (at_T - middle_T).y() / half_m;
  return Eigen::Matrix<double, 6, 1>(std::array{1.0, x, y, x * x, x * y, y * y}.data());
}

/// One number a press.
using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, PalpateJob::kMostFelt, 1>;

/// What a plane and lumps explain of what all presses felt: an orthonormal basis of them.
class Explained {
 public:
  Column without(Column column) const {
    for (std::size_t i = 0; i < count_; ++i) column -= known_[i].dot(column) * known_[i];
    return column;
  }
  void add(const Column& column) {
    const Column rest = without(column);
    if (rest.norm() > 1e-6) known_[count_++] = rest.normalized();
  }

 private:
  std::array<Column, 3 + PalpateJob::kMostLumps> known_;
  std::size_t count_ = 0;
};

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

/// Single touches err by a millimetre, a tenth of the depth: the hand knows the surface from all of them.
PalpateJob::Curved PalpateJob::touched_surface(const Vec3& middle_T, double half_m) const {
  Eigen::Matrix<double, 6, 6> sums = 1e-9 * Eigen::Matrix<double, 6, 6>::Identity();
  Curved heights = Curved::Zero();
  for (std::size_t i = 0; i < felt_count_; ++i) {
    const Curved at = curved(felt_[i].place_T, middle_T, half_m);
    sums += at * at.transpose();
    heights += felt_[i].touched_z_m * at;
  }
  return sums.ldlt().solve(heights);
}

/// Greedily, as in orthogonal matching pursuit: what explains most of what the plane and the lumps before leave over.
Vec3 PalpateJob::next_lump(const Places& known, const Percept& percept) const {
  const Vec3& middle_T = percept.object.X_TO.p;
  const double half_m = percept.object.size_m.x() / 2;
  const auto over_presses = [&](const auto& value) {
    Column column(static_cast<Eigen::Index>(felt_count_));
    for (std::size_t i = 0; i < felt_count_; ++i) column[static_cast<Eigen::Index>(i)] = value(felt_[i]);
    return column;
  };
  const auto lump_at = [&](const Vec3& at) {
    return over_presses([&](const Felt& felt) {
      return std::exp(-(felt.place_T - at).head<2>().squaredNorm() / (kLumpWidth * kLumpWidth));
    });
  };
  const auto apart_from = [](const Places& others, const Vec3& at) {
    return std::none_of(others.at.begin(), others.at.begin() + static_cast<std::ptrdiff_t>(others.count),
                        [&](const Vec3& other) { return (other - at).head<2>().norm() < kApart; });
  };
  Explained explained;
  explained.add(over_presses([](const Felt&) { return 1.0; }));
  explained.add(over_presses([&](const Felt& felt) { return (felt.place_T - middle_T).x() / half_m; }));
  explained.add(over_presses([&](const Felt& felt) { return (felt.place_T - middle_T).y() / half_m; }));
  const Curved surface = touched_surface(middle_T, half_m);
  const Column felt = over_presses([&](const Felt& one) {
    return std::log(one.force_n /
                    std::max(kLeastDepth, surface.dot(curved(one.place_T, middle_T, half_m)) - one.place_T.z()));
  });

  Places lumps;
  for (;;) {
    const Column left = explained.without(felt);
    Vec3 best = middle_T;
    double most = 0;
    const auto think_of = [&](const Vec3& at) {
      const Column lump = explained.without(lump_at(at));
      if (lump.norm() < kFeltEnough || lump.dot(left) <= most * lump.norm() || !apart_from(lumps, at)) return;
      best = at;
      most = lump.dot(left) / lump.norm();
    };
    const double felt_m = half_m - pitch_m_ / 2;  // farther out a lump and the plane would be taken for each other
    for (double x = -felt_m; x <= felt_m; x += kLumpStep)
      for (double y = -felt_m; y <= felt_m; y += kLumpStep) think_of(middle_T + Vec3(x, y, 0));
    for (double step = kLumpStep / 2; step > kLumpStep / 8; step /= 2) {
      const Vec3 coarse = best;
      for (const double x : {-step, 0.0, step})
        for (const double y : {-step, 0.0, step}) think_of(coarse + Vec3(x, y, 0));
    }
    if (apart_from(known, best) || lumps.count + 1 == kMostLumps) return best;
    lumps.add(best);
    explained.add(lump_at(best));
  }
}

/// From what has just been felt to what is felt next.
void PalpateJob::next(const Percept& percept, const HandIntent& intent, HandRandom& random) {
  corrections_ = 0;
  if (aim_ == Aim::kRaster && raster_ < side_ * side_)
    return go_to(raster_place(percept, raster_++), percept, intent, random);
  const bool all_tried = skill_.max_corrections < 2 || (tried_.count == kTries && beside_ == kBesides);
  if (all_tried) {
    aim_ = Aim::kMark;
    chosen_T_ = next_lump(marked_, percept);
    return go_to(chosen_T_, percept, intent, random);
  }
  if (aim_ == Aim::kRaster || beside_ == kBesides) {
    aim_ = Aim::kBeside;
    beside_ = 0;
    chosen_T_ = next_lump(tried_, percept);
    tried_.add(chosen_T_);
  }
  const Vec3 side = beside_ % 2 == 0 ? Vec3::UnitX() : Vec3::UnitY();
  go_to(chosen_T_ + (beside_++ < 2 ? 0.5 : -0.5) * pitch_m_ * side, percept, intent, random);
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
  const double force = force_sum_ / judged_ * random.log_normal(kFeelJudgement * skill_.force_cv);
  if (felt_count_ < kMostFelt) felt_[felt_count_++] = {place_sum_ / judged_, touched_T_.z(), force};
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
        force_sum_ = judged_s_ = 0;
        place_sum_.setZero();
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
      place_sum_ += percept.tip_T;
      ++judged_;
      judged_s_ += dt_s;
      if (judged_s_ < kLook) return;
      judge(random);
      if (aim_ != Aim::kMark) return next(percept, intent, random);
      marked_.add(chosen_T_);
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
      if (in_step_s_ > skill_.reaction_s && percept.jaw_opening_m > 0.013) next(percept, intent, random);
  }
}

}  // namespace trocar
