#include "scenarios/kinds/dissect/dissect_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "haptics/input_error.h"
#include "haptics/least_turn.h"
#include "scenarios/kinds/dissect/dissect_rules.h"
#include "scenarios/layout/board_random.h"
#include "scenarios/layout/height_field.h"
#include "scenarios/layout/shaft_room.h"

namespace trocar {
namespace {

constexpr int kBedDraws = 200, kVesselDraws = 60;
constexpr int kColumns = 3, kMostRows = 2;
constexpr int kArcPoints = 9;            // of a strand's path
constexpr double kColumnShare = 0.4;     // of the bed's width, between two columns of strands
constexpr double kRowShare = 0.5;        // of its length, between the two rows
constexpr double kScatter = 0.001;       // m of a strand's middle, either way
constexpr double kEdge = 0.003;          // m from the bed's edge to a vessel
constexpr double kLeastSpanShare = 0.7;  // of the span that must be left between vertices

/// Across the foot of the hook at a place, seen from above: the way of the foot and that of the strands.
struct BedAxes {
  Eigen::Vector2d along, across;
};

class DissectionPlan {
 public:
  DissectionPlan(const Exercise& exercise, const BoardPlace& place, const HeightField& organ, const BedAxes& axes,
                 BoardRandom& random)
      : rules_(own_rules<DissectRules>(exercise)),
        layout_(exercise.layout),
        place_(place),
        organ_(organ),
        axes_(axes),
        random_(random),
        middle_(random_.either_way(rules_.shift_m), random_.either_way(rules_.shift_m)) {}

  /// Adds strands and vessels to the board; false: one finds no place.
  bool fill(Board& board) {
    std::vector<int> slots(static_cast<std::size_t>(kColumns * rows()));
    std::iota(slots.begin(), slots.end(), 0);
    random_.shuffle(slots);
    for (int strand = 0; strand < rules_.strands; ++strand)
      if (!add_strand(slots[static_cast<std::size_t>(strand)], board)) return false;
    for (int draw = 0; draw < kVesselDraws && static_cast<int>(board.targets.size()) < layout_.count; ++draw)
      add_vessel(board);
    return static_cast<int>(board.targets.size()) == layout_.count;
  }

 private:
  int rows() const { return rules_.strands > kColumns ? kMostRows : 1; }
  Eigen::Vector2d at(double along_m, double across_m) const {
    return middle_ + along_m * axes_.along + across_m * axes_.across;
  }
  std::optional<SurfacePoint> ground(const Eigen::Vector2d& at) const {
    const auto top = organ_.top(at.x(), at.y());
    return top && top->slope_rad < layout_.max_slope_rad ? top : std::nullopt;
  }
  bool reached(const SurfacePoint& point) const {
    return place_.behind_tip == nullptr || place_.behind_tip->free(point.position, point.normal);
  }
  Vec3 nearest_vertex(const Vec3& to) const {
    return *std::min_element(
        place_.organ_T.vertices.begin(), place_.organ_T.vertices.end(),
        [&](const Vec3& a, const Vec3& b) { return (a - to).squaredNorm() < (b - to).squaredNorm(); });
  }

  bool add_strand(int slot, Board& board) {
    const double row = slot / kColumns - (rows() - 1) / 2.0, column = slot % kColumns - (kColumns - 1) / 2.0;
    const Eigen::Vector2d middle = at(row * kRowShare * rules_.bed_along_m + random_.either_way(kScatter),
                                      column * kColumnShare * rules_.bed_across_m + random_.either_way(kScatter));
    const Eigen::Vector2d way = Eigen::Rotation2Dd(random_.either_way(rules_.turn_rad)) * axes_.along;
    std::array<Vec3, 2> ends;
    for (std::size_t end = 0; end < 2; ++end) {
      const auto top = ground(middle + (end == 0 ? -0.5 : 0.5) * rules_.span_m * way);
      if (!top) return false;
      ends[end] = nearest_vertex(top->position);
    }
    const Eigen::Vector2d from = ends[0].head<2>(), to = ends[1].head<2>();
    const auto under = ground((from + to) / 2);
    if (!under || !reached(*under) || (to - from).norm() < kLeastSpanShare * rules_.span_m) return false;
    std::vector<Vec3> path;
    for (int i = 0; i < kArcPoints; ++i) {
      const double share = static_cast<double>(i) / (kArcPoints - 1);
      const Eigen::Vector2d over = from + share * (to - from);
      const auto top = organ_.top(over.x(), over.y());
      if (!top) return false;
      path.push_back(top->position + rules_.bow_m * std::sin(std::numbers::pi * share) * under->normal);
    }
    path.front() = ends[0];
    path.back() = ends[1];
    board.ducts_T.push_back(std::move(path));
    board.targets.push_back({under->position, under->normal, layout_.radius_m});
    return true;
  }

  void add_vessel(Board& board) {
    const Eigen::Vector2d drawn =
        at(random_.either_way(rules_.bed_along_m / 2 - kEdge), random_.either_way(rules_.bed_across_m / 2 - kEdge));
    const auto top = ground(drawn);
    if (!top || !reached(*top)) return;
    const bool crowded = std::any_of(
        board.targets.begin() + rules_.strands, board.targets.end(),
        [&](const Target& other) { return (other.centre_T - top->position).norm() < layout_.min_spacing_m; });
    if (!crowded) board.targets.push_back({top->position, top->normal, layout_.radius_m});
  }

  const DissectRules& rules_;
  const TargetLayout& layout_;
  const BoardPlace& place_;
  const HeightField& organ_;
  BedAxes axes_;
  BoardRandom& random_;
  Eigen::Vector2d middle_;
};

/// The foot points along -y of I (tissue/thin/rod_hook.h).
BedAxes bed_axes(const ExerciseLevel& level, const Mat3& R_TI_rest, const Vec3& centre_T) {
  Mat3 R = R_TI_rest;
  if (level.mapping == Mapping::kFulcrum) R = least_turn(R.col(2), centre_T - level.port_m).toRotationMatrix() * R;
  const Eigen::Vector2d foot = -R.col(1).head<2>().normalized();
  return {{-foot.y(), foot.x()}, foot};
}

}  // namespace

std::vector<BleederSetup> bleeders_of(const Exercise& exercise, const Board& board) {
  std::vector<BleederSetup> out;
  for (std::size_t i = 0; i < exercise.stages.size(); ++i)
    for (const BleederSetup& bleeder : bleeders_of(*exercise.stages[i].exercise, board.stages[i]))
      out.push_back(bleeder);
  if (exercise.kind != ExerciseKind::kDissect) return out;
  const DissectRules& rules = own_rules<DissectRules>(exercise);
  for (auto i = static_cast<std::size_t>(rules.strands); i < board.targets.size(); ++i)
    out.push_back({board.targets[i].centre_T, rules.vessel_radius_m, rules.feed_m});
  return out;
}

Board lay_out_dissection(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place) {
  const HeightField organ(place.organ_T);
  const auto centre = organ.top(0, 0);
  if (!centre) throw InputError("the organ does not lie under the middle of the board region: place it first");
  const BedAxes axes = bed_axes(level, place.R_TI_rest, centre->position);
  BoardRandom random(board);
  for (int draw = 0; draw < kBedDraws; ++draw) {
    Board out;
    if (!DissectionPlan(exercise, place, organ, axes, random).fill(out)) continue;
    out.centre_T = centre->position;
    out.start_T = centre->position + exercise.start_above_m;
    out.spacing_m = exercise.layout.min_spacing_m;
    return out;
  }
  throw InputError("board " + std::to_string(board) + " of exercise '" + exercise.id +
                   "': the organ has no bed that is even and large enough for the strands: choose a larger one");
}

}  // namespace trocar
