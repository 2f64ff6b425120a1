#include "scenarios/board_layout.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "haptics/input_error.h"
#include "scenarios/height_field.h"
#include "tissue/theatre_frame.h"

namespace trocar {
namespace {

constexpr double kCell = 0.004;            // m, raster of the search for a region
constexpr double kSurroundings = 0.006;    // m round a target in which the surface must stay near its tangent plane
constexpr double kUnevenness = 0.003;      // m, "near"
constexpr double kCloserBy = 0.001;        // m by which targets on a small organ may move together, step by step
constexpr int kDraws = 3000, kRestarts = 8;
constexpr double kWantedLeg = 0.035;       // m, travel between neighbours in the order of lighting
constexpr double kLegClearance = 0.004;    // m between the ideal path and the surface

/// Uniform number in [0, 1) by an explicit formula: the same on every standard library.
double uniform(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1.0p-53; }

struct Raster {
  int nx = 0, ny = 0;
  Vec3 corner = Vec3::Zero();
  std::vector<double> z;      ///< NaN where the surface is missed or too steep

  double at(int ix, int iy) const {
    return z[static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(ix)];
  }
};

Raster raster_of(const HeightField& field, double max_slope_rad) {
  Raster raster;
  raster.corner = field.bounds().min();
  raster.nx = static_cast<int>(field.bounds().sizes().x() / kCell) + 1;
  raster.ny = static_cast<int>(field.bounds().sizes().y() / kCell) + 1;
  for (int iy = 0; iy < raster.ny; ++iy) {
    for (int ix = 0; ix < raster.nx; ++ix) {
      const auto point = field.top(raster.corner.x() + ix * kCell, raster.corner.y() + iy * kCell);
      raster.z.push_back(point && point->slope_rad <= max_slope_rad ? point->position.z() : std::nan(""));
    }
  }
  return raster;
}

/// Cells of the region round (cx, cy) that a target may use.
int usable_cells(const Raster& raster, int cx, int cy, const TargetLayout& layout) {
  const int half_x = static_cast<int>(layout.region_x_m / 2 / kCell);
  const int half_y = static_cast<int>(layout.region_y_m / 2 / kCell);
  const double centre = raster.at(cx, cy);
  int count = 0;
  for (int iy = std::max(0, cy - half_y); iy <= std::min(raster.ny - 1, cy + half_y); ++iy)
    for (int ix = std::max(0, cx - half_x); ix <= std::min(raster.nx - 1, cx + half_x); ++ix)
      if (std::abs(raster.at(ix, iy) - centre) <= layout.relief_m) ++count;  // false for NaN
  return count;
}

/// A point may carry a target when it is flat enough, and the surface goes on all round it.
bool qualifies(const HeightField& field, const SurfacePoint& point, double centre_z, const TargetLayout& layout) {
  if (point.slope_rad > layout.max_slope_rad || std::abs(point.position.z() - centre_z) > layout.relief_m) return false;
  if (std::acos(std::clamp(point.normal.z(), -1.0, 1.0)) > layout.max_slope_rad) return false;
  for (int k = 0; k < 8; ++k) {
    const double angle = k * M_PI / 4;
    const auto near = field.top(point.position.x() + kSurroundings * std::cos(angle),
                                point.position.y() + kSurroundings * std::sin(angle));
    if (!near || std::abs((near->position - point.position).dot(point.normal)) > kUnevenness) return false;
  }
  return true;
}

/// One round of dart throwing; may return fewer targets than wanted.
std::vector<Target> throw_darts(const HeightField& field, const TargetLayout& layout, double centre_z,
                                std::mt19937_64& generator) {
  std::vector<Target> targets;
  const double margin = layout.radius_m + layout.wrong_place_m;
  const double span_x = layout.region_x_m - 2 * margin, span_y = layout.region_y_m - 2 * margin;
  for (int draw = 0; draw < kDraws && static_cast<int>(targets.size()) < layout.count; ++draw) {
    const double x = (uniform(generator) - 0.5) * span_x, y = (uniform(generator) - 0.5) * span_y;
    const bool crowded = std::any_of(targets.begin(), targets.end(), [&](const Target& t) {
      return std::hypot(t.centre_T.x() - x, t.centre_T.y() - y) < layout.min_spacing_m;
    });
    if (crowded) continue;
    const auto point = field.top(x, y);
    if (point && qualifies(field, *point, centre_z, layout))
      targets.push_back({point->position, point->normal, layout.radius_m, {}, Mat3::Identity()});
  }
  return targets;
}

/// The best of several rounds.
std::vector<Target> best_throw(const HeightField& field, const TargetLayout& layout, double centre_z, std::mt19937_64& generator) {
  std::vector<Target> best;
  for (int restart = 0; restart < kRestarts && static_cast<int>(best.size()) < layout.count; ++restart) {
    std::vector<Target> targets = throw_darts(field, layout, centre_z, generator);
    if (targets.size() > best.size()) best = std::move(targets);
  }
  return best;
}

/// Points of a hexagonal lattice of random place and turn that qualify: denser than darts, for organs with little room.
std::vector<Target> lattice_throw(const HeightField& field, const TargetLayout& layout, double centre_z, std::mt19937_64& generator) {
  const double margin = layout.radius_m + layout.wrong_place_m, pitch = layout.min_spacing_m;
  const double half_x = layout.region_x_m / 2 - margin, half_y = layout.region_y_m / 2 - margin;
  const Eigen::Rotation2Dd turn(uniform(generator) * M_PI / 3);
  const Eigen::Vector2d shift(uniform(generator) * pitch, uniform(generator) * pitch);
  const int reach = static_cast<int>(std::hypot(half_x, half_y) / pitch) + 2;
  std::vector<Target> targets;
  for (int row = -reach; row <= reach; ++row)
    for (int column = -reach; column <= reach; ++column) {
      const Eigen::Vector2d at = turn * Eigen::Vector2d(pitch * (column + 0.5 * (row & 1)), pitch * std::sqrt(0.75) * row) + shift;
      if (std::abs(at.x()) > half_x || std::abs(at.y()) > half_y) continue;
      const auto point = field.top(at.x(), at.y());
      if (point && qualifies(field, *point, centre_z, layout))
        targets.push_back({point->position, point->normal, layout.radius_m, {}, Mat3::Identity()});
    }
  while (static_cast<int>(targets.size()) > layout.count)
    targets.erase(targets.begin() + static_cast<std::ptrdiff_t>(uniform(generator) * static_cast<double>(targets.size())));
  return targets;
}

/// The exercise's spacing where the organ has room; else closer together, down to where the wrong-place rims touch.
std::vector<Target> place_targets(const HeightField& field, TargetLayout& layout, double centre_z, std::mt19937_64& generator) {
  constexpr int kLattices = 1000;
  std::vector<Target> best = best_throw(field, layout, centre_z, generator);
  const double closest = 2 * (layout.radius_m + layout.wrong_place_m);
  while (static_cast<int>(best.size()) < layout.count && layout.min_spacing_m > closest) {
    layout.min_spacing_m = std::max(closest, layout.min_spacing_m - kCloserBy);
    for (int n = 0; n < kLattices && static_cast<int>(best.size()) < layout.count; ++n) {
      std::vector<Target> targets = lattice_throw(field, layout, centre_z, generator);
      if (targets.size() > best.size()) best = std::move(targets);
    }
  }
  return best;
}

/// Is the straight way between two lifted targets free of the surface?
bool leg_is_free(const HeightField& field, const Target& a, const Target& b, double retract_m) {
  for (double share = 0.1; share < 0.95; share += 0.1) {
    const Vec3 point = a.centre_T + share * (b.centre_T - a.centre_T) + Vec3(0, 0, retract_m);
    const auto below = field.top(point.x(), point.y());
    if (below && below->position.z() + kLegClearance > point.z()) return false;
  }
  return true;
}

/// Orders targets so that neighbours lie about kWantedLeg apart and the way between them is free: exchange of pairs
/// until no exchange helps. Deterministic.
void order_targets(const HeightField& field, double retract_m, std::vector<Target>& targets) {
  const std::size_t n = targets.size();
  Eigen::MatrixXd cost(n, n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double distance = (targets[i].centre_T - targets[j].centre_T).norm();
      const auto row = static_cast<Eigen::Index>(i), col = static_cast<Eigen::Index>(j);
      const double blocked = leg_is_free(field, targets[i], targets[j], retract_m) ? 0 : 1;
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

}  // namespace

Pose place_organ(const TriangleSurface& organ_RAS, const TargetLayout& layout) {
  const Pose turn{theatre_from_ras(), Vec3::Zero()};
  const TriangleSurface turned = organ_RAS.transformed(turn);
  const HeightField field(turned);
  int best = 0;
  Vec3 centre = Vec3::Zero();
  if (!turned.triangles.empty()) {
    const Raster raster = raster_of(field, layout.max_slope_rad);
    for (int iy = 0; iy < raster.ny; ++iy) {
      for (int ix = 0; ix < raster.nx; ++ix) {
        if (std::isnan(raster.at(ix, iy))) continue;
        const int count = usable_cells(raster, ix, iy, layout);
        if (count <= best) continue;
        best = count;
        centre = Vec3(raster.corner.x() + ix * kCell, raster.corner.y() + iy * kCell, raster.at(ix, iy));
      }
    }
  }
  if (best == 0)
    throw InputError("the organ has no surface that faces forward within the slope limit: no room for a board");
  return {turn.R, -centre};
}

namespace {

/// Gives each target its band: every band as often as the others, in a drawn order (Fisher and Yates).
void deal_bands(const std::vector<WantedForce>& bands, std::mt19937_64& generator, std::vector<Target>& targets) {
  for (std::size_t i = 0; i < targets.size(); ++i) targets[i].band = bands[i % bands.size()];
  if (bands.size() < 2) return;
  for (std::size_t i = targets.size() - 1; i > 0; --i) {
    const auto other = static_cast<std::size_t>(uniform(generator) * static_cast<double>(i + 1));
    std::swap(targets[i].band, targets[other].band);
  }
}

}  // namespace

Board lay_out_board(const TriangleSurface& organ_T, const Exercise& exercise, const ExerciseLevel& level, int board) {
  const TargetLayout& layout = exercise.layout;
  const HeightField field(organ_T);
  const auto centre = field.top(0, 0);
  if (!centre) throw InputError("the organ does not lie under the middle of the board region: place it first");
  std::mt19937_64 generator(0x9E3779B97F4A7C15ull * (static_cast<std::uint64_t>(board) + 1));
  TargetLayout tried = layout;
  std::vector<Target> best = place_targets(field, tried, centre->position.z(), generator);
  if (static_cast<int>(best.size()) < layout.count) {
    throw InputError("board " + std::to_string(board) + " of exercise '" + exercise.id + "': the organ has room for " +
                     std::to_string(best.size()) + " of " + std::to_string(layout.count) +
                     " targets (slope, relief and spacing limits)");
  }
  order_targets(field, exercise.retract_height_m, best);
  deal_bands(level.bands, generator, best);
  Board result;
  result.centre_T = centre->position;
  result.start_T = centre->position + exercise.start_above_m;
  result.spacing_m = tried.min_spacing_m;
  result.targets = std::move(best);
  return result;
}

}  // namespace trocar
