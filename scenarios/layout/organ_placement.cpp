#include "scenarios/layout/organ_placement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "haptics/input_error.h"
#include "haptics/kinematics/device_geometry.h"
#include "scenarios/kinds/touch/disc_layout.h"
#include "scenarios/layout/target_ground.h"
#include "tissue/theatre_frame.h"

namespace trocar {
namespace {

constexpr double kCell = 0.004;  // m, raster of the search for a region
constexpr double kAmple =
    2;  // times the area of the discs packed at their closest: every board finds room, no trial needed
constexpr double kLeast = 0.6;      // of that area: below, no board can be laid
constexpr double kHindered = 0.9;   // the shaft takes more than a tenth of a place: a better one is looked for
constexpr std::size_t kTrials = 3;  // turned places whose boards are tried, those with most room
constexpr int kTriedBoards = 3;     // the first practice boards: each is a search of its own where room is scarce

struct Raster {
  int nx = 0, ny = 0;
  Vec3 corner = Vec3::Zero();
  std::vector<double> z;  ///< NaN where the surface is missed or too steep

  double at(int ix, int iy) const {
    return z[static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(ix)];
  }
};

/// @param room none: the tip alone is asked for.
Raster raster_of(const HeightField& field, double max_slope_rad, const ShaftRoom* room = nullptr) {
  Raster raster;
  raster.corner = field.bounds().min();
  raster.nx = static_cast<int>(field.bounds().sizes().x() / kCell) + 1;
  raster.ny = static_cast<int>(field.bounds().sizes().y() / kCell) + 1;
  for (int iy = 0; iy < raster.ny; ++iy) {
    for (int ix = 0; ix < raster.nx; ++ix) {
      const auto point = field.top(raster.corner.x() + ix * kCell, raster.corner.y() + iy * kCell);
      const bool usable =
          point && point->slope_rad <= max_slope_rad && (room == nullptr || room->free(point->position, point->normal));
      raster.z.push_back(usable ? point->position.z() : std::nan(""));
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

/// Middle of the region with the most usable cells.
std::optional<Vec3> best_centre(const Raster& raster, const TargetLayout& layout) {
  int best = 0;
  Vec3 centre = Vec3::Zero();
  for (int iy = 0; iy < raster.ny; ++iy) {
    for (int ix = 0; ix < raster.nx; ++ix) {
      if (std::isnan(raster.at(ix, iy))) continue;
      const int count = usable_cells(raster, ix, iy, layout);
      if (count <= best) continue;
      best = count;
      centre = Vec3(raster.corner.x() + ix * kCell, raster.corner.y() + iy * kCell, raster.at(ix, iy));
    }
  }
  return best > 0 ? std::optional<Vec3>(centre) : std::nullopt;
}

}  // namespace

Pose place_organ(const TriangleSurface& organ_RAS, const TargetLayout& layout) {
  const Pose turn{theatre_from_ras(), Vec3::Zero()};
  const TriangleSurface turned = organ_RAS.transformed(turn);
  const HeightField field(turned);
  std::optional<Vec3> centre;
  if (!turned.triangles.empty()) centre = best_centre(raster_of(field, layout.max_slope_rad), layout);
  if (!centre)
    throw InputError("the organ has no surface that faces forward within the slope limit: no room for a board");
  return {turn.R, -*centre};
}

std::string turned_words(const OrganPlacement& placement) {
  const auto degrees = [](double angle) {
    return std::to_string(std::lround(std::abs(angle) / kDegree)) + " degrees ";
  };
  std::string words;
  if (placement.roll_rad != 0)
    words += "rolled " + degrees(placement.roll_rad) + (placement.roll_rad > 0 ? "to its left" : "to its right");
  if (placement.turn_rad != 0) {
    words += (words.empty() ? "" : " and ") + ("turned " + degrees(placement.turn_rad)) +
             (placement.turn_rad > 0 ? "anticlockwise" : "clockwise");
  }
  return words.empty() ? "" : "the organ is " + words + ", to make room for the discs and for the instrument";
}

OrganPlacement measure_placement(const TriangleSurface& organ_RAS, const Pose& X_TO, const TargetLayout& layout,
                                 const Instrument& instrument) {
  OrganPlacement placement;
  placement.X_TO = X_TO;
  const TriangleSurface organ_T = organ_RAS.transformed(X_TO);
  const HeightField field(organ_T);
  const ShaftRoom room(organ_T, instrument.tool, instrument.map);
  const auto centre = field.top(0, 0);
  if (!centre) return placement;
  const GroundArea area = ground_area({field, layout, centre->position.z(), &room});
  placement.even_m2 = area.even_m2;
  placement.free_m2 = area.free_m2;
  return placement;
}

namespace {

struct Turn {
  double roll_rad = 0, turn_rad = 0;
};

/// Of a patient on a table, the least first; at the head upright.
std::vector<Turn> turns() {
  constexpr double kStep = std::numbers::pi / 12;  // 15 deg
  std::vector<Turn> all;
  for (int roll = -6; roll <= 6; roll += 2)
    for (int turn = -9; turn <= 12; turn += 3) all.push_back({roll * kStep, turn * kStep});
  std::stable_sort(all.begin(), all.end(), [](const Turn& a, const Turn& b) {
    return std::abs(a.roll_rad) + std::abs(a.turn_rad) + 1e-9 < std::abs(b.roll_rad) + std::abs(b.turn_rad);
  });
  return all;
}

/// Upright is the first of turns(), and there the shaft, too, chooses the region's middle.
std::optional<OrganPlacement> place_turned(const TriangleSurface& organ_RAS, const TargetLayout& layout,
                                           const Instrument& instrument, const Turn& turn) {
  const Mat3 R = Eigen::AngleAxisd(turn.turn_rad, Vec3::UnitZ()).toRotationMatrix() *
                 Eigen::AngleAxisd(turn.roll_rad, Vec3::UnitY()).toRotationMatrix() * theatre_from_ras();
  const TriangleSurface turned = organ_RAS.transformed({R, Vec3::Zero()});
  const HeightField field(turned);
  const ShaftRoom room(turned, instrument.tool, instrument.map.instrument_pose(home_pose()).R);
  const auto centre = best_centre(raster_of(field, layout.max_slope_rad, &room), layout);
  if (!centre) return std::nullopt;
  OrganPlacement placement = measure_placement(organ_RAS, {R, -*centre}, layout, instrument);
  placement.roll_rad = turn.roll_rad;
  placement.turn_rad = turn.turn_rad;
  return placement;
}

/// Of discs packed as closely as they may lie.
double packed_m2(const TargetLayout& layout) {
  return layout.count * std::sqrt(0.75) * std::pow(closest_spacing(layout), 2);
}

bool boards_fit(const TriangleSurface& organ_RAS, const OrganPlacement& placement, const Exercise& exercise,
                const ExerciseLevel& level, const Instrument& instrument) {
  if (placement.free_m2 >= kAmple * packed_m2(exercise.layout)) return true;
  if (placement.free_m2 < kLeast * packed_m2(exercise.layout)) return false;
  const TriangleSurface organ_T = organ_RAS.transformed(placement.X_TO);
  const ShaftRoom room(organ_T, instrument.tool, instrument.map);
  try {
    for (int board = 0; board < kTriedBoards; ++board) lay_out_discs(organ_T, exercise, level, board, &room);
  } catch (const InputError&) {
    return false;
  }
  return true;
}

bool roomier(const OrganPlacement& a, const OrganPlacement& b) { return a.free_m2 > b.free_m2; }

}  // namespace

OrganPlacement place_organ(const TriangleSurface& organ_RAS, const Exercise& exercise, const ExerciseLevel& level,
                           const Instrument& instrument) {
  const TargetLayout& layout = exercise.layout;
  const auto fits = [&](const OrganPlacement& placement) {
    return boards_fit(organ_RAS, placement, exercise, level, instrument);
  };
  const OrganPlacement first = measure_placement(organ_RAS, place_organ(organ_RAS, layout), layout, instrument);
  const bool ample = first.free_m2 >= kAmple * packed_m2(layout), hindered = first.free_m2 < kHindered * first.even_m2;
  if (ample || (!hindered && fits(first))) return first;
  std::vector<OrganPlacement> found;
  for (const Turn& turn : turns()) {
    const auto placement = place_turned(organ_RAS, layout, instrument, turn);
    if (!placement) continue;
    if (placement->free_m2 >= kAmple * packed_m2(layout)) return *placement;
    found.push_back(*placement);
  }
  std::stable_sort(found.begin(), found.end(), roomier);
  for (std::size_t i = 0; i < std::min(kTrials, found.size()); ++i)
    if (fits(found[i])) return found[i];
  return found.empty() || first.free_m2 >= found.front().free_m2 ? first : found.front();
}

}  // namespace trocar
