// Scenes of the board exercises made by formula: ghost pens over a board, and foam blocks with rings.
//
// Frame T, metres, z up; the board's upper face lies at z = 0. Thread: any.
#pragma once

#include <cmath>
#include <numbers>

#include "tests/support/procedural_scene.h"

namespace trocar::testing_support {

inline SceneObject task_board() {
  SceneObject board;
  board.shape = SceneObject::Shape::kBoard;
  board.look = SceneObject::Look::kBoard;
  board.size_m = {0.100, 0.100, 0.004};
  board.colour = {0.15, 0.16, 0.17};
  board.accent = {0.40, 0.40, 0.38};
  return board;
}

inline SceneObject foam_block(const Vec3& centre, std::size_t foam_class) {
  SceneObject block;
  block.look = SceneObject::Look::kFoam;
  block.size_m = {0.014, 0.014, 0.020};
  block.colour = foam_classes()[foam_class].colour;
  block.accent = foam_classes()[foam_class].band;
  block.bands = foam_classes()[foam_class].bands;
  block.X_TO.p = centre;
  return block;
}

inline SceneObject target_ring(const Vec3& centre, const Vec3& colour) {
  SceneObject ring;
  ring.shape = SceneObject::Shape::kRing;
  ring.size_m = {0.020, 0.020, 0.0016};
  ring.colour = colour;
  ring.X_TO.p = centre + Vec3(0, 0, 0.0008);
  return ring;
}

inline SceneObject ghost_pen(const Vec3& tip, const Vec3& shaft_from, SceneObject::Style style) {
  SceneObject pen;
  pen.shape = SceneObject::Shape::kPen;
  pen.size_m = {0.005, 0.005, 0.060};
  pen.style = style;
  pen.X_TO = instrument_pose(tip, shaft_from);
  return pen;
}

inline SceneView empty_board() {
  SceneView view;
  view.objects.push_back(task_board());
  view.stage_T = Eigen::AlignedBox3d(Vec3(-0.05, -0.05, -0.004), Vec3(0.05, 0.05, 0.05));
  view.camera.eye_T = Vec3(-0.012, -0.115, 0.100);
  view.camera.look_at_T = Vec3(0.0, 0.002, 0.006);
  view.X_TI = instrument_pose(Vec3(0.020, -0.004, 0.040), Vec3(0.62, -0.28, 0.75));
  view.jaw_opening_m = 0.006;
  return view;
}

/// Six blocks of three classes, six rings, one block pinched and lifted.
inline SceneView grasp_scene() {
  SceneView view = empty_board();
  for (int i = 0; i < 6; ++i) {
    const double x = -0.040 + 0.016 * i;
    view.objects.push_back(foam_block({x, 0.030, 0.010}, static_cast<std::size_t>(i % 3)));
    view.objects.push_back(target_ring({-0.040 + 0.016 * i, i % 2 ? -0.020 : -0.036, 0}, Vec3(0.35, 0.35, 0.36)));
  }
  SceneObject& held = view.objects[5];
  held.X_TO.p = Vec3(0.004, -0.004, 0.030);
  held.pinch_O = Vec3::UnitX();
  held.pinch_depth_m = 0.004;
  view.X_TI = instrument_pose(held.X_TO.p + Vec3(-0.002, 0, -0.002), Vec3(0.55, -0.25, 0.80));
  view.jaw_opening_m = 0.012;
  view.hud.title = "E03 Grasp with limited force \u00b7 L1 \u00b7 direct";
  view.hud.trainee = "Trainee: T-expert";
  return view;
}

/// Eight ghost pens on a shell of 70 mm: two done, one lit, five waiting; the instrument near the lit one.
inline SceneView pens_scene() {
  SceneView view = empty_board();
  using Style = SceneObject::Style;
  for (int i = 0; i < 8; ++i) {
    const double turn = 2 * std::numbers::pi * (i + 0.3) / 8, polar = 0.45 + 0.25 * (i % 3);
    const Vec3 d(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
    view.objects.push_back(ghost_pen(0.035 * d - Vec3(0, 0, 0.005), d,
                                     i < 2    ? Style::kGhostDone
                                     : i == 2 ? Style::kGhostLit
                                              : Style::kGhost));
  }
  view.X_TI = instrument_pose(view.objects[3].X_TO.p + Vec3(0.008, -0.006, 0.004), Vec3(0.62, -0.28, 0.75));
  view.jaw_opening_m = 0;
  view.roll_stripe = true;
  view.hud.title = "E01 Reach and orient \u00b7 L1 \u00b7 direct";
  view.hud.trainee = "Trainee: T-expert";
  return view;
}

}  // namespace trocar::testing_support
