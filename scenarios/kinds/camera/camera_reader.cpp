#include "scenarios/kinds/camera/camera_reader.h"

#include "scenarios/files/file_units.h"
#include "scenarios/kinds/camera/camera_rules.h"

namespace trocar {
namespace {

using file_units::kDegrees, file_units::kMilli;

void read_cups(StrictTable table, CameraRules& rules) {
  rules.sphere_m = table.number("sphere_mm", 1, 40) * kMilli;
  rules.cup_depth_m = table.number("depth_mm", 1, 60) * kMilli;
  rules.cup_wall_m = table.number("wall_mm", 0.2, 10) * kMilli;
  if (rules.cup_depth_m < rules.sphere_m) table.fail("depth_mm", "'depth_mm' lets the sphere stand out of its cup");
  table.finish();
}

void read_view(StrictTable table, CameraRules& rules) {
  rules.nearest_m = table.number("nearest_mm", 5, 200) * kMilli;
  rules.farthest_m = table.number("farthest_mm", 5, 300) * kMilli;
  rules.drawn_m = table.number("drawn_mm", 5, 300) * kMilli;
  rules.lost_s = table.number("horizon_lost_s", 0.1, 60);
  rules.counted_s = table.number("counted_horizon_s", 0.1, 60);
  rules.timeout_s = table.number("timeout_s", 1, 600);
  rules.swing_rad = table.number("swing_deg", 0, 60) * kDegrees;
  rules.steepest_rad = table.number("steepest_deg", 0, 88) * kDegrees;
  if (rules.nearest_m <= rules.cup_depth_m)
    table.fail("nearest_mm", "'nearest_mm' brings the lens into the cup: it must be above 'depth_mm'");
  if (rules.drawn_m <= rules.nearest_m || rules.drawn_m >= rules.farthest_m)
    table.fail("drawn_mm", "'drawn_mm' must lie between 'nearest_mm' and 'farthest_mm'");
  table.finish();
}

void read_plate(StrictTable table, CameraRules& rules) {
  rules.board_half_m = table.number("side_mm", 10, 400) / 2 * kMilli;
  rules.board_z_m = -table.number("below_mm", 0, 300) * kMilli;
  rules.board_stiffness_n_per_m = table.number("stiffness_n_per_m", 10, 5000);
  table.finish();
}

}  // namespace

void read_camera(StrictTable& document, Exercise& exercise) {
  CameraRules rules;
  exercise.hold_s = document.number("hold_s", 0.05, 60);
  read_cups(document.table("cups"), rules);
  read_view(document.table("view"), rules);
  read_plate(document.table("board"), rules);
  if (rules.timeout_s <= exercise.hold_s) document.fail("hold_s", "'hold_s' must be below 'timeout_s' of the view");
  exercise.own = std::make_shared<const CameraRules>(rules);
}

void read_camera_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level) {
  CameraLevel camera = level.own ? own_rules<CameraLevel>(level) : CameraLevel{};
  keys.number("scope_deg", 0, 70, kDegrees, camera.tilt_rad);
  keys.number("centre_deg", 0.5, 30, kDegrees, camera.centre_rad);
  keys.number("horizon_deg", 1, 90, kDegrees, camera.horizon_rad);
  keys.number("bore_mm", 1, 60, kMilli, camera.bore_m);
  if (camera.bore_m < own_rules<CameraRules>(exercise).sphere_m)
    keys.table.fail("bore_mm", "'bore_mm' is narrower than the sphere");
  level.own = std::make_shared<const CameraLevel>(camera);
}

}  // namespace trocar
