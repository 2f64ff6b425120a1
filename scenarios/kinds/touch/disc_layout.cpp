#include "scenarios/kinds/touch/disc_layout.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "haptics/input_error.h"
#include "scenarios/layout/board_random.h"
#include "scenarios/layout/target_ground.h"

namespace trocar {
namespace {

constexpr double kCloserBy = 0.001;  // m by which targets on a small organ may move together, step by step
constexpr int kDraws = 3000, kRestarts = 8;
constexpr double kWantedLeg = 0.035;     // m, travel between neighbours in the order of lighting
constexpr double kLegClearance = 0.004;  // m between the ideal path and the surface

/// One round of dart throwing; may return fewer targets than wanted.
std::vector<Target> throw_darts(const TargetGround& ground, const TargetLayout& layout, BoardRandom& random) {
  std::vector<Target> targets;
  const double margin = layout.radius_m + layout.wrong_place_m;
  const double span_x = layout.region_x_m - 2 * margin, span_y = layout.region_y_m - 2 * margin;
  for (int draw = 0; draw < kDraws && static_cast<int>(targets.size()) < layout.count; ++draw) {
    const double x = (random.uniform() - 0.5) * span_x, y = (random.uniform() - 0.5) * span_y;
    const bool crowded = std::any_of(targets.begin(), targets.end(), [&](const Target& t) {
      return std::hypot(t.centre_T.x() - x, t.centre_T.y() - y) < layout.min_spacing_m;
    });
    if (crowded) continue;
    const auto point = ground.field.top(x, y);
    if (point && ground.carries(*point))
      targets.push_back({point->position, point->normal, layout.radius_m, {}, Mat3::Identity()});
  }
  return targets;
}

/// The best of several rounds.
std::vector<Target> best_throw(const TargetGround& ground, const TargetLayout& layout, BoardRandom& random) {
  std::vector<Target> best;
  for (int restart = 0; restart < kRestarts && static_cast<int>(best.size()) < layout.count; ++restart) {
    std::vector<Target> targets = throw_darts(ground, layout, random);
    if (targets.size() > best.size()) best = std::move(targets);
  }
  return best;
}

/// Points of a hexagonal lattice of random place and turn that qualify: denser than darts, for organs with little room.
std::vector<Target> lattice_throw(const TargetGround& ground, const TargetLayout& layout, BoardRandom& random) {
  const double margin = layout.radius_m + layout.wrong_place_m, pitch = layout.min_spacing_m;
  const double half_x = layout.region_x_m / 2 - margin, half_y = layout.region_y_m / 2 - margin;
  const Eigen::Rotation2Dd turn(random.uniform() * M_PI / 3);
  const Eigen::Vector2d shift(random.uniform() * pitch, random.uniform() * pitch);
  const int reach = static_cast<int>(std::hypot(half_x, half_y) / pitch) + 2;
  std::vector<Target> targets;
  for (int row = -reach; row <= reach; ++row)
    for (int column = -reach; column <= reach; ++column) {
      const Eigen::Vector2d at =
          turn * Eigen::Vector2d(pitch * (column + 0.5 * (row & 1)), pitch * std::sqrt(0.75) * row) + shift;
      if (std::abs(at.x()) > half_x || std::abs(at.y()) > half_y) continue;
      const auto point = ground.field.top(at.x(), at.y());
      if (point && ground.carries(*point))
        targets.push_back({point->position, point->normal, layout.radius_m, {}, Mat3::Identity()});
    }
  while (static_cast<int>(targets.size()) > layout.count)
    targets.erase(targets.begin() + static_cast<std::ptrdiff_t>(random.index(targets.size())));
  return targets;
}

/// The exercise's spacing where the organ has room; else closer together, down to where the wrong-place rims touch.
std::vector<Target> place_targets(const TargetGround& ground, TargetLayout& layout, BoardRandom& random) {
  constexpr int kLattices = 1000;
  std::vector<Target> best = best_throw(ground, layout, random);
  const double closest = closest_spacing(layout);
  while (static_cast<int>(best.size()) < layout.count && layout.min_spacing_m > closest) {
    layout.min_spacing_m = std::max(closest, layout.min_spacing_m - kCloserBy);
    for (int n = 0; n < kLattices && static_cast<int>(best.size()) < layout.count; ++n) {
      std::vector<Target> targets = lattice_throw(ground, layout, random);
      if (targets.size() > best.size()) best = std::move(targets);
    }
  }
  return best;
}

/// Is the straight way between two lifted targets free of the surface, for tip and shaft?
bool leg_is_free(const TargetGround& ground, const Target& a, const Target& b, double retract_m) {
  for (double share = 0.1; share < 0.95; share += 0.1) {
    const Vec3 point = a.centre_T + share * (b.centre_T - a.centre_T) + Vec3(0, 0, retract_m);
    const auto below = ground.field.top(point.x(), point.y());
    if (below && below->position.z() + kLegClearance > point.z()) return false;
    if (ground.room != nullptr && !ground.room->passes(point)) return false;
  }
  return true;
}

/// Orders targets so that neighbours lie about kWantedLeg apart and the way between them is free: exchange of pairs
/// until no exchange helps. Deterministic.
void order_targets(const TargetGround& ground, double retract_m, std::vector<Target>& targets) {
  const std::size_t n = targets.size();
  Eigen::MatrixXd cost(n, n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double distance = (targets[i].centre_T - targets[j].centre_T).norm();
      const auto row = static_cast<Eigen::Index>(i), col = static_cast<Eigen::Index>(j);
      const double blocked = leg_is_free(ground, targets[i], targets[j], retract_m) ? 0 : 1;
      cost(row, col) = std::pow(distance - kWantedLeg, 2) + blocked;
    }
  }
  std::vector<Eigen::Index> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = static_cast<Eigen::Index>(i);
  const auto total = [&] {
    double sum = 0;
    for (std::size_t i = 1; i < n; ++i) sum += cost(order[i - 1], order[i]);
    return sum;
  };
  double best = total();
  for (bool improved = true; improved;) {
    improved = false;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) {
        std::swap(order[i], order[j]);
        const double candidate = total();
        if (candidate < best - 1e-12) {
          best = candidate;
          improved = true;
        } else {
          std::swap(order[i], order[j]);
        }
      }
    }
  }
  std::vector<Target> ordered;
  for (const Eigen::Index index : order) ordered.push_back(targets[static_cast<std::size_t>(index)]);
  targets = ordered;
}

/// Gives each target its band: every band as often as the others, in a drawn order.
void deal_bands(const std::vector<WantedForce>& bands, BoardRandom& random, std::vector<Target>& targets) {
  std::vector<WantedForce> dealt;
  for (std::size_t i = 0; i < targets.size(); ++i) dealt.push_back(bands[i % bands.size()]);
  if (bands.size() > 1) random.shuffle(dealt);
  for (std::size_t i = 0; i < targets.size(); ++i) targets[i].band = dealt[i];
}

/// Why the targets do not fit: the organ is too small, or the instrument's shaft has no room.
[[noreturn]] void refuse(const TargetGround& ground, const Exercise& exercise, const ExerciseLevel& level, int board,
                         std::size_t found) {
  const std::string where = level.name.empty() ? "" : ", level " + level.name;
  std::string why = "board " + std::to_string(board) + " of exercise '" + exercise.id + "'" + where +
                    ": the organ has room for " + std::to_string(found) + " of " +
                    std::to_string(exercise.layout.count) + " targets (slope, relief and spacing limits";
  if (ground.room != nullptr) {
    BoardRandom random(board);
    TargetLayout tried = exercise.layout;
    const std::size_t tip_only =
        place_targets({ground.field, exercise.layout, ground.centre_z, nullptr}, tried, random).size();
    if (tip_only > found) {
      throw InputError(
          why + "); " + std::to_string(tip_only) +
          " where the tip alone had to reach, but there the instrument's shaft would press on the organ or on a "
          "neighbour:"
          " choose a level with another way in, a larger part of the organ, or the organ without its neighbours");
    }
  }
  throw InputError(why + "): choose a larger organ or an exercise with fewer or smaller targets");
}

}  // namespace

Board lay_out_discs(const TriangleSurface& organ_T, const Exercise& exercise, const ExerciseLevel& level, int board,
                    const ShaftRoom* room, std::span<const Vec3> strands_T) {
  const TargetLayout& layout = exercise.layout;
  const HeightField field(organ_T);
  const auto centre = field.top(0, 0);
  if (!centre) throw InputError("the organ does not lie under the middle of the board region: place it first");
  const TargetGround ground{field, layout, centre->position.z(), room, strands_T};
  BoardRandom random(board);
  TargetLayout tried = layout;
  std::vector<Target> best = place_targets(ground, tried, random);
  if (static_cast<int>(best.size()) < layout.count) refuse(ground, exercise, level, board, best.size());
  order_targets(ground, exercise.retract_height_m, best);
  deal_bands(level.bands, random, best);
  Board result;
  result.centre_T = centre->position;
  result.start_T = centre->position + exercise.start_above_m;
  result.spacing_m = tried.min_spacing_m;
  result.targets = std::move(best);
  return result;
}

}  // namespace trocar
