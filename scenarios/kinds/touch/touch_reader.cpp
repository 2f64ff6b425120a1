#include "scenarios/kinds/touch/touch_reader.h"

#include <algorithm>

#include "scenarios/files/file_units.h"

namespace trocar {

using file_units::kDegrees, file_units::kMilli;

void read_discs(StrictTable& table, TargetLayout& layout) {
  layout.radius_m = table.number("diameter_mm", 1, 50) / 2 * kMilli;
  layout.max_slope_rad = table.number("max_slope_deg", 1, 80) * kDegrees;
  layout.wrong_place_m = table.number("wrong_place_mm", 0, 50) * kMilli;
  if (layout.min_spacing_m < 2 * layout.radius_m) table.fail("min_spacing_mm", "'min_spacing_mm' lets discs overlap");
}

void read_surface(StrictTable& document, Exercise& exercise) {
  if (exercise.is_stage) return;
  StrictTable table = document.table("surface");
  exercise.surface.stiffness_n_per_m = table.number("stiffness_n_per_m", 1, 5000);
  exercise.surface.damping_s_per_m = table.number("damping_s_per_m", 0, 50);
  exercise.surface.mu_static = table.number_or("friction_static", 0, 2, 0);
  exercise.surface.mu_dynamic = table.number_or("friction_dynamic", 0, 2, 0);
  if (exercise.surface.mu_dynamic > exercise.surface.mu_static)
    table.fail("friction_dynamic", "'friction_dynamic' must not be above 'friction_static'");
  table.finish();
}

void read_bands(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level) {
  StrictTable& table = keys.table;
  table.allow("band_n");
  table.allow("bands_n");
  const bool one = table.has("band_n"), several = table.has("bands_n");
  if (one && several) table.fail("bands_n", "'bands_n' and 'band_n' exclude each other");
  const std::string key = several ? "bands_n" : "band_n";
  if (keys.derived && !one && !several) return;
  level.bands.clear();
  if (several) {
    for (const auto& [low, high] : table.pairs("bands_n", 0.01, 50)) level.bands.push_back({low, high});
  } else {
    const auto [low, high] = table.pair("band_n", 0.01, 50);
    level.bands.push_back({low, high});
  }
  level.band_low_n = level.bands.front().low_n;
  level.band_high_n = level.bands.front().high_n;
  for (const WantedForce& band : level.bands) {
    if (band.high_n <= band.low_n) table.fail(key, "'" + key + "' must be [low, high] with low below high");
    if (band.high_n > exercise.hard_force_n) table.fail(key, "'" + key + "' reaches above 'hard_n'");
    level.band_low_n = std::min(level.band_low_n, band.low_n);
    level.band_high_n = std::max(level.band_high_n, band.high_n);
  }
}

}  // namespace trocar
