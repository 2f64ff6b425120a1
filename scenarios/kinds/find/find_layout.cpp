#include "scenarios/kinds/find/find_layout.h"

#include <algorithm>
#include <numeric>

#include "haptics/input_error.h"
#include "scenarios/kinds/find/find_rules.h"
#include "scenarios/layout/board_random.h"
#include "scenarios/layout/height_field.h"

namespace trocar {
namespace {

constexpr double kPlacesShare = 0.6;  // of the free edge, that places are spread over
constexpr double kAlongFrom = 0.2;    // of the flap's length and width, where pins may lie: not at its rim,
constexpr double kAcrossFrom = 0.3;   // and not in the fold at the hinge ...
constexpr double kAlongTo = 0.8, kAcrossTo = 0.7;  // ... nor where the jaws press

/// From 'from' to 'to'.
double between(double from, double to, BoardRandom& random) { return from + (to - from) * random.uniform(); }

/// The flap as it lies, seen from above.
struct Flap {
  const SheetPlan& plan;
  const HeightField& organ;
  const std::string& exercise;

  SurfacePoint at(double along_m, double across_m) const {
    const Eigen::Vector2d along = plan.along_m.normalized();
    const Eigen::Vector2d place = plan.corner_m + along_m * along + across_m * Eigen::Vector2d(-along.y(), along.x());
    const auto top = organ.top(place.x(), place.y());
    if (!top)
      throw InputError("exercise '" + exercise + "': the organ is not all beneath the sheet '" + plan.name +
                       "': choose another organ");
    return *top;
  }
};

std::array<Vec3, kMostAnswers> answer_row(const Flap& flap, const FindRules& rules, BoardRandom& random) {
  std::vector<int> order(kMostAnswers);
  std::iota(order.begin(), order.end(), 0);
  random.shuffle(order);
  const double length = flap.plan.along_m.norm();
  std::array<Vec3, kMostAnswers> row;
  double top = 0;
  for (int n = 0; n < kMostAnswers; ++n) {
    Vec3& place = row[static_cast<std::size_t>(order[static_cast<std::size_t>(n)])];
    const double along = length / 2 + (n - (kMostAnswers - 1) / 2.0) * rules.answers_apart_m;
    place = flap.at(along, flap.plan.across_m + rules.answers_before_m).position;
    top = n == 0 ? place.z() : std::max(top, place.z());
  }
  for (Vec3& place : row) place.z() = top + rules.answers_above_m;
  return row;
}

}  // namespace

Board lay_out_find(const TriangleSurface& organ_T, const Exercise& exercise, const ExerciseLevel& level, int board) {
  const FindRules& rules = own_rules<FindRules>(exercise);
  const HeightField field(organ_T);
  const Flap flap{exercise.sheets.front(), field, exercise.id};
  const double length = flap.plan.along_m.norm(), width = flap.plan.across_m;
  BoardRandom random(board);
  Board out;
  out.centre_T = flap.at(length / 2, width / 2).position;
  out.start_T = out.centre_T + exercise.start_above_m;
  const auto count = static_cast<std::size_t>(exercise.layout.count);
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  random.shuffle(order);
  FindBoard own;
  own.thickness_m = flap.plan.thickness_m;
  own.hinge_T = flap.at(0, 0).position;
  own.along_T = (flap.at(length, 0).position - own.hinge_T).normalized();
  for (const std::size_t n : order) {
    const double share = count > 1 ? static_cast<double>(n) / static_cast<double>(count - 1) - 0.5 : 0;
    const SurfacePoint place = flap.at(length * (0.5 + kPlacesShare * share), width - rules.edge_m);
    out.targets.push_back(
        {place.position, place.normal, exercise.layout.radius_m, level.bands.front(), Mat3::Identity()});
    const double along = length * between(kAlongFrom, kAlongTo, random);
    const SurfacePoint pin = flap.at(along, width * between(kAcrossFrom, kAcrossTo, random));
    own.pins.push_back({pin.position, pin.normal, static_cast<std::int32_t>(random.index(kMostAnswers))});
  }
  own.answers_T = answer_row(flap, rules, random);
  out.own = std::make_shared<const FindBoard>(std::move(own));
  return out;
}

}  // namespace trocar
