#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"
#include "haptics/least_turn.h"
#include "scenarios/kinds/camera/cup.h"
#include "scenarios/kinds/camera/scope_view.h"

namespace trocar {
namespace {

using Shape = SceneObject::Shape;
using Style = SceneObject::Style;

constexpr double kScopeField = 72;     // deg, of the round field's diameter
constexpr double kRingBefore = 0.006;  // m from the lens: before everything that is looked at
constexpr double kRingWire = 0.00006;  // m
constexpr double kStem = 0.005;        // m, diameter
constexpr double kTellingView = 0.5;   // of a hold
const Vec3 kCupGrey(0.36, 0.37, 0.38), kStemGrey(0.22, 0.23, 0.24);
const Vec3 kRingWhite(0.75, 0.75, 0.72), kRingGreen(0.01, 0.75, 0.22);
const Vec3 kWaitingBall(0.10, 0.22, 0.55), kLitBall(0.95, 0.62, 0.03), kDoneBall(0.05, 0.38, 0.16);

/// At the highest level nothing tells what is level.
bool told(const ExerciseLevel& level) { return level.force_display != "after"; }

Camera scope_sees(const Scene& scene, const Pose& X_TI) {
  const Mat3 R_TC = X_TI.R * picture_in_instrument(own_rules<CameraLevel>(scene.level).tilt_rad);
  Camera camera;
  camera.eye_T = X_TI.p;
  camera.look_at_T = X_TI.p + own_rules<CameraRules>(scene.setup.exercise).drawn_m * R_TC.col(2);
  camera.up_T = -R_TC.col(1);
  camera.diagonal_fov_deg = kScopeField;
  if (told(scene.level)) camera.level_rad = horizon_of(R_TC);
  return camera;
}

void add_cup(const Cup& cup, const Vec3& ball_colour, bool lit, double plate_z, std::vector<SceneObject>& out) {
  SceneObject wall;
  wall.shape = Shape::kCup;
  wall.size_m = {cup.bore_m, 2 * cup.outer_radius_m(), cup.depth_m};
  wall.X_TO.R = least_turn(Vec3::UnitZ(), cup.axis_T).toRotationMatrix();
  wall.X_TO.p = cup.rim_T();
  wall.colour = kCupGrey;
  wall.accent = ball_colour;
  out.push_back(wall);
  SceneObject ball;
  ball.shape = Shape::kSphere;
  ball.size_m = Vec3::Constant(cup.sphere_m);
  ball.X_TO.p = cup.sphere_T;
  ball.colour = ball_colour;
  if (lit) ball.style = Style::kLit;
  out.push_back(ball);
  SceneObject stem;
  stem.shape = Shape::kCylinder;
  const Vec3 foot = cup.foot_T();
  stem.size_m = {kStem, kStem, foot.z() - plate_z};
  stem.X_TO.p = {foot.x(), foot.y(), 0.5 * (foot.z() + plate_z)};
  stem.colour = kStemGrey;
  out.push_back(stem);
}

/// The circle in the middle of the picture, on the lens as it were: green while the lit sphere's middle is in it.
SceneObject middle_ring(const SessionView& view) {
  const CameraLevel& level = own_rules<CameraLevel>(view.scene.level);
  const Camera camera = scope_sees(view.scene, view.record.stylus.X_TI);
  const Vec3 forward = (camera.look_at_T - camera.eye_T).normalized();
  const double diameter = 2 * kRingBefore * std::tan(level.centre_rad);
  SceneObject ring;
  ring.shape = Shape::kRing;
  ring.size_m = {diameter, diameter, kRingWire};
  ring.X_TO.R = least_turn(Vec3::UnitZ(), forward).toRotationMatrix();
  ring.X_TO.p = camera.eye_T + kRingBefore * forward;
  const DirectorStatus& status = view.director.status();
  const bool inside = status.target_index >= 0 && status.angle_error_rad <= level.centre_rad;
  ring.colour = inside ? kRingGreen : kRingWhite;
  return ring;
}

void add_cups(const SessionView& view, std::vector<SceneObject>& out) {
  const Exercise& exercise = view.scene.setup.exercise;
  const DirectorStatus& status = view.director.status();
  const std::vector<Target>& targets = view.director.board().targets;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const bool lit = static_cast<int>(i) == status.target_index;
    add_cup(cup_of(targets[i], own_rules<CameraRules>(exercise), own_rules<CameraLevel>(view.scene.level)),
            lit                   ? kLitBall
            : status.done.test(i) ? kDoneBall
                                  : kWaitingBall,
            lit, own_rules<CameraRules>(exercise).board_z_m, out);
  }
  out.push_back(middle_ring(view));
}

std::vector<HudRow> camera_rows(const Scene& scene, const DirectorStatus& status) {
  std::vector<HudRow> rows{{"Spheres found", targets_done(scene, status), ""},
                           {"Out of time", std::to_string(status.timeouts), "x"},
                           {"Wall contacts", std::to_string(status.wrong_places), "x"}};
  if (told(scene.level) && status.phase == Phase::kRun) {
    rows.push_back({"Distance", hud_number("%.0f", 1000 * status.position_error_m), "mm", true});
    rows.push_back({"Horizon", hud_number("%.0f", std::abs(status.horizon_rad) * 180 / std::numbers::pi), "°", true});
  }
  rows.push_back(hold_row(status));
  return rows;
}

/// The plate, and where the lens goes.
Eigen::AlignedBox3d camera_work(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (const Target& target : scene.board.targets) {
    box.extend(target.centre_T);
    box.extend(
        cup_of(target, own_rules<CameraRules>(scene.setup.exercise), own_rules<CameraLevel>(scene.level)).foot_T());
  }
  return box;
}

}  // namespace

KindPicture camera_picture() {
  return {.kind = ExerciseKind::kCamera,
          .steps =
              [](const RunStage& run) {
                return std::vector{hud_step("Bring each lit sphere into the ring and keep it there",
                                            run.done || run.targets, run.started && !run.targets)};
              },
          .rows = camera_rows,
          .bars = [](const SessionView&) { return std::vector<ForceBar>{}; },
          .add_objects = add_cups,
          .work = camera_work,
          .telling = [](const SessionView& view) { return view.director.status().hold_progress >= kTellingView; },
          .sees = scope_sees};
}

}  // namespace trocar
