#include <algorithm>

#include "app/picture/attempt/attempt_scene.h"
#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"
#include "scenarios/kinds/find/find_rules.h"

namespace trocar {
namespace {

using FindShape = SceneObject::Shape;
using FindStyle = SceneObject::Style;

constexpr double kHeadThick = 0.003, kHeadOver = 0.0015;  // m: within the flap's thickness while it lies
constexpr double kBar = 0.18, kRelief = 0.12;             // of the head's diameter: a stroke's width and height
constexpr double kPlateShare = 0.75;                      // of the ball's diameter: the plate that shows its symbol
constexpr double kTellingRead = 0.5;                      // of a hold
constexpr double kPlateThick = 0.0008;                    // m
const Vec3 kHeadColour(0.03, 0.04, 0.06), kSymbolColour(0.92, 0.86, 0.55), kPlateColour(0.03, 0.04, 0.06);

/// A stroke of a symbol: in units of the head's diameter, in its plane.
struct Stroke {
  double x = 0, y = 0, turn_rad = 0, length = 0;
};

constexpr double kSixth = 1.0471975511965976;  // of a turn, rad
const std::vector<Stroke>& strokes(std::int32_t symbol) {
  static const std::vector<std::vector<Stroke>> all{
      {},                                                                                  // a ring
      {{0, 0, 0, 0.72}, {0, 0, 1.5 * kSixth, 0.72}},                                       // a cross
      {{0, -0.19, 0, 0.68}, {0.16, 0.09, 2 * kSixth, 0.68}, {-0.16, 0.09, kSixth, 0.68}},  // a triangle
      {{0, -0.18, 0, 0.70}, {0, 0.18, 0, 0.70}}};                                          // two bars
  return all.at(static_cast<std::size_t>(symbol));
}

/// @param X_TH the head's upper face, seen from +z, x to the right
void add_symbol(std::int32_t symbol, double diameter_m, const Pose& X_TH, std::vector<SceneObject>& out) {
  SceneObject stroke;
  stroke.colour = kSymbolColour;
  if (strokes(symbol).empty()) {
    stroke.shape = FindShape::kRing;
    stroke.size_m = {0.74 * diameter_m, 0, kBar * diameter_m};
    stroke.X_TO = X_TH;
    out.push_back(stroke);
  }
  for (const Stroke& s : strokes(symbol)) {
    stroke.size_m = {s.length * diameter_m, kBar * diameter_m, kRelief * diameter_m};
    stroke.X_TO.R = X_TH.R * Eigen::AngleAxisd(s.turn_rad, Vec3::UnitZ()).toRotationMatrix();
    stroke.X_TO.p = X_TH * Vec3(s.x * diameter_m, s.y * diameter_m, 0);
    out.push_back(stroke);
  }
}

/// z along a direction, x to the right in the picture.
Mat3 facing(const Vec3& direction_T, const Camera& camera) {
  Mat3 R;
  R.col(2) = direction_T.normalized();
  R.col(1) = R.col(2).cross((camera.look_at_T - camera.eye_T).cross(camera.up_T)).normalized();
  R.col(0) = R.col(1).cross(R.col(2));
  return R;
}

/// How far the organ has moved there.
Vec3 moved(const SessionView& view, const Vec3& place_T) {
  if (!view.organ_T || view.organ_T->vertices.size() != view.scene.organ_T->vertices.size()) return Vec3::Zero();
  const auto& rest = view.scene.organ_T->vertices;
  const auto nearest = std::min_element(rest.begin(), rest.end(), [&](const Vec3& a, const Vec3& b) {
    return (a - place_T).squaredNorm() < (b - place_T).squaredNorm();
  });
  return view.organ_T->vertices[static_cast<std::size_t>(nearest - rest.begin())] - *nearest;
}

void add_plate(const Pose& X_TH, double diameter_m, double thick_m, const Vec3& colour, std::vector<SceneObject>& out) {
  SceneObject plate;
  plate.shape = FindShape::kCylinder;
  plate.size_m = {diameter_m, 0, thick_m};
  plate.X_TO = {X_TH.R, X_TH * Vec3(0, 0, -thick_m / 2)};
  plate.colour = colour;
  out.push_back(plate);
}

/// The pin of the lit place. It bears its symbol from the moment on in which that may be read: nobody sees it through
/// the flap, nor at its rim.
void add_pin(const SessionView& view, std::vector<SceneObject>& out) {
  const DirectorStatus& status = view.director.status();
  if (status.target_index < 0) return;
  const HiddenPin& pin = own_rules<FindBoard>(view.scene.board).pins.at(static_cast<std::size_t>(status.target_index));
  const double diameter = 2 * own_rules<FindRules>(view.scene.setup.exercise).pin_radius_m;
  const Pose X_TH{facing(pin.normal_T, attempt_camera(view.scene)),
                  pin.centre_T + moved(view, pin.centre_T) + kHeadOver * pin.normal_T};
  add_plate(X_TH, diameter, kHeadThick, kHeadColour, out);
  if (status.shown_symbol >= 0) add_symbol(status.shown_symbol, diameter, X_TH, out);
}

/// The balls in which answers are told: lit, all alike, while one is asked for.
void add_answers(const SessionView& view, std::vector<SceneObject>& out) {
  const FindRules& rules = own_rules<FindRules>(view.scene.setup.exercise);
  const FindBoard& board = own_rules<FindBoard>(view.scene.board);
  const Camera camera = attempt_camera(view.scene);
  const bool asked = view.director.status().cue == Cue::kRead;
  for (std::int32_t symbol = 0; symbol < kMostAnswers; ++symbol) {
    SceneObject ball;
    ball.shape = FindShape::kSphere;
    ball.style = asked ? FindStyle::kGhostLit : FindStyle::kGhost;
    ball.size_m = Vec3::Constant(2 * rules.answer_m);
    ball.X_TO.p = board.answers_T[static_cast<std::size_t>(symbol)];
    const double diameter = kPlateShare * 2 * rules.answer_m;
    const Pose X_TH{facing(camera.eye_T - ball.X_TO.p, camera), ball.X_TO.p};
    add_plate(X_TH, diameter, kPlateThick, kPlateColour, out);
    add_symbol(symbol, diameter, X_TH, out);
    out.push_back(ball);
  }
}

/// Where the flap is to be taken, and to where that shall come.
void add_pins(const SessionView& view, std::vector<SceneObject>& out) {
  const DirectorStatus& status = view.director.status();
  const bool lift = status.cue == Cue::kLift;
  if (status.cue != Cue::kTake && !lift) return;
  SceneObject ring;
  ring.shape = FindShape::kRing;
  ring.style = FindStyle::kGhostLit;
  ring.size_m = {2 * status.demand.radius_m, 0, 0.001};
  ring.X_TO.p = lift ? status.demand.goal_T : status.demand.centre_T;
  ring.X_TO.R = facing(status.demand.normal_T, attempt_camera(view.scene));
  out.push_back(ring);
}

/// The places lie on the flap, and only the lit one is told: a disc on the organ would be beneath.
void hide_discs(const SessionView&, std::vector<TargetMark>& discs) { discs.clear(); }

void add_find_objects(const SessionView& view, std::vector<SceneObject>& out) {
  add_pin(view, out);
  add_answers(view, out);
  add_pins(view, out);
}

std::vector<ForceBar> find_bars(const SessionView& view) {
  const FindRules& rules = own_rules<FindRules>(view.scene.setup.exercise);
  return pull_and_grip(view, {rules.grip_low_n, rules.grip_high_n});
}

}  // namespace

KindPicture find_picture() {
  return {.kind = ExerciseKind::kFind,
          .steps =
              [](const RunStage& run) {
                return std::vector{
                    hud_step("Lift the flap and read what lies beneath", run.done, run.started && !run.done)};
              },
          .rows =
              [](const Scene& scene, const DirectorStatus& status) {
                return std::vector<HudRow>{{"Symbols told", targets_done(scene, status), ""},
                                           {"Exposed", hud_number("%.0f", 100 * status.exposure), "%"},
                                           {"Holds lost", std::to_string(status.wrong_places), "x"},
                                           hold_row(status)};
              },
          .bars = find_bars,
          .add_objects = add_find_objects,
          .work = [](const Scene&) { return Eigen::AlignedBox3d(); },
          .telling =
              [](const SessionView& view) {
                const DirectorStatus& status = view.director.status();
                return status.shown_symbol >= 0 && status.hold_progress >= kTellingRead;
              },
          .add_marks = hide_discs};
}

}  // namespace trocar
