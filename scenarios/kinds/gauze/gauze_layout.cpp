#include "scenarios/kinds/gauze/gauze_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "haptics/least_turn.h"
#include "scenarios/kinds/gauze/cut_line.h"
#include "scenarios/layout/board_random.h"
#include "scenarios/layout/sheet_frame.h"

namespace trocar {
namespace {

constexpr std::size_t kMostSteps = 32;  // DirectorStatus::done
constexpr double kWithin = 0.010;       // m that gauze is moved at most by who cuts it; what moves further has come off
constexpr double kDrawnIn = 0.003;      // m: the free edge draws in so far as the gauze is spread; no line begins there
constexpr double kMostRoll = 2 * std::numbers::pi / 3;  // rad either way, well within what a stylus rolls

Mat3 unrolled_at(const ExerciseLevel& level, const Mat3& R_TI_rest, const Vec3& place_T) {
  if (level.mapping != Mapping::kFulcrum) return R_TI_rest;
  return least_turn(R_TI_rest.col(2), place_T - level.port_m).toRotationMatrix() * R_TI_rest;
}

}  // namespace

Vec3 on_gauze_now_T(const std::vector<Target>& steps, const std::bitset<32>& done, const TissueFrame* frame,
                    const Vec3& drawn_T, double share) {
  const auto count = static_cast<std::int32_t>(steps.size());
  if (!frame || frame->place_count < count) return drawn_T;
  const double step = std::clamp(share * count - 0.5, 0.0, count - 1.0);
  const auto before = static_cast<std::size_t>(step), behind = std::min(before + 1, steps.size() - 1);
  const auto moved = [&](std::size_t n) -> Vec3 {
    const Vec3 way = frame->place[n].point_T - steps[n].centre_T;
    return way.norm() < kWithin ? way : Vec3(Vec3::Zero());
  };
  // What is cut already gapes, and says nothing of what lies ahead.
  const double onward = done[before] ? 1 : step - static_cast<double>(before);
  return drawn_T + (1 - onward) * moved(before) + onward * moved(behind);
}

Mat3 blades_along(const ExerciseLevel& level, const Mat3& R_TI_rest, const Vec3& place_T, const Vec3& along_T,
                  double& turned_rad) {
  const Mat3 R_TI = unrolled_at(level, R_TI_rest, place_T);
  const Vec3 shaft = R_TI.col(2), hinge = R_TI.col(0), wanted = shaft.cross(along_T);
  const double least = std::atan2(hinge.cross(wanted).dot(shaft), hinge.dot(wanted));
  // Either way round cuts the same: the one that is nearer to how it was.
  double best = 0, gap = 1e9;
  for (const double half_turns : {-2, -1, 0, 1, 2}) {
    const double roll = least + half_turns * std::numbers::pi;
    if (std::abs(roll) > kMostRoll || std::abs(roll - turned_rad) >= gap) continue;
    gap = std::abs(roll - turned_rad);
    best = roll;
  }
  turned_rad = best;
  return Eigen::AngleAxisd(best, shaft).toRotationMatrix() * R_TI;
}

Board lay_out_gauze(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place) {
  const GauzeRules& rules = own_rules<GauzeRules>(exercise);
  const GauzeLevel& asked = own_rules<GauzeLevel>(level);
  const SheetPlan& plan = exercise.sheets.front();
  const HeightField organ(place.organ_T);
  const SheetFrame frame(plan, organ);
  const double length = plan.along_m.norm();
  BoardRandom random(board);
  GauzeBoard own;
  own.middle_T =
      frame.at({length / 2 + random.either_way(rules.shift_m), plan.across_m / 2 + random.either_way(rules.shift_m)});
  own.R_TI_rest = place.R_TI_rest;
  GauzeLine& line = own.line;
  line.long_m = asked.long_m / 2;
  line.across_m = asked.across_m / 2;
  line.turned_rad = std::numbers::pi * random.uniform();
  line.from_rad = -std::numbers::pi / 2 + random.either_way(rules.way_in_rad);
  line.sense = random.uniform() < 0.5 ? 1 : -1;
  const double edge_y = frame.at({length / 2, plan.across_m}).y();
  const CutLine round(line, asked.off_m);
  const double met = round.at(0).at.norm();
  line.way_in_m = (own.middle_T.y() - edge_y) / -std::sin(line.from_rad) - met - kDrawnIn;
  const CutLine whole(line, asked.off_m);
  Board out;
  out.centre_T = own.middle_T;
  out.start_T = own.middle_T + exercise.start_above_m;
  const double all = whole.way_in_m() + whole.round_m();
  const auto steps = std::min(kMostSteps, static_cast<std::size_t>(std::ceil(all / rules.step_m)));
  double turned = 0;
  for (std::size_t n = 0; n < steps; ++n) {
    const LinePlace at = whole.at(all * (static_cast<double>(n) + 0.5) / static_cast<double>(steps));
    const Vec3 place_T = own.middle_T + Vec3(at.at.x(), at.at.y(), 0);
    const Mat3 R_TI = blades_along(level, place.R_TI_rest, place_T, {at.along.x(), at.along.y(), 0}, turned);
    out.targets.push_back({place_T, -R_TI.col(2), asked.off_m, {}, R_TI});
  }
  out.own = std::make_shared<const GauzeBoard>(own);
  return out;
}

}  // namespace trocar
