#include <algorithm>

#include "app/picture/kinds/board_object.h"
#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"

namespace trocar {
namespace {

using Shape = SceneObject::Shape;
using Style = SceneObject::Style;

constexpr double kBoardSide = 0.100, kBoardThickness = 0.004;
constexpr double kBoardBelowPens = 0.030;  // m: seen, not felt, so it keeps out of the instrument's way
constexpr double kPenNear = 0.012;         // m from a pen's tip: instrument and pen are both seen, the dial speaks

const Vec3 kPenBoardLines(0.34, 0.34, 0.33);

/// Upper face of the board that the picture shows under the pens.
double pen_board_z(const Board& board) {
  double lowest = board.centre_T.z();
  for (const Target& pen : board.targets) lowest = std::min(lowest, pen.centre_T.z());
  return lowest - kBoardBelowPens;
}

Style pen_style(const DirectorStatus& status, int index) {
  if (index == status.target_index) return Style::kGhostLit;
  return status.done.test(static_cast<std::size_t>(index)) ? Style::kGhostDone : Style::kGhost;
}

/// Pole from the lit tip down to the board and a ring at its foot: tells where over the board the tip stands.
void add_plumb_line(const Vec3& tip, double board_z, std::vector<SceneObject>& out) {
  SceneObject pole;
  pole.shape = Shape::kCylinder;
  pole.style = Style::kGhostLit;
  pole.size_m = {0.0006, 0.0006, tip.z() - board_z};
  pole.X_TO.p = {tip.x(), tip.y(), 0.5 * (tip.z() + board_z)};
  SceneObject foot;
  foot.shape = Shape::kRing;
  foot.style = Style::kGhostLit;
  foot.size_m = {0.008, 0.008, 0.0008};
  foot.X_TO.p = {tip.x(), tip.y(), board_z + 0.0004};
  out.push_back(pole);
  out.push_back(foot);
}

void add_pens(const SessionView& view, std::vector<SceneObject>& out) {
  const PenRules& rules = view.scene.setup.exercise.pens;
  const Board& board = view.director.board();
  const double board_z = pen_board_z(board);
  out.push_back(board_object(board_z, kBoardSide, kBoardThickness, board.centre_T, kPenBoardLines));
  for (std::size_t i = 0; i < board.targets.size(); ++i) {
    SceneObject pen;
    pen.shape = Shape::kPen;
    pen.size_m = {2 * rules.radius_m, 2 * rules.radius_m, rules.length_m};
    pen.X_TO = {board.targets[i].R_TI, board.targets[i].centre_T};
    pen.style = pen_style(view.director.status(), static_cast<int>(i));
    out.push_back(pen);
    if (pen.style == Style::kGhostLit && view.scene.level.guides) add_plumb_line(pen.X_TO.p, board_z, out);
  }
}

Eigen::AlignedBox3d pen_work(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (const Target& pen : scene.board.targets)
    for (const double back : {0.0, 0.6 * scene.setup.exercise.pens.length_m})
      box.extend(Vec3(pen.centre_T - back * pen.R_TI.col(2)));
  return box;
}

bool near_a_pen(const SessionView& view) {
  const Demand& demand = view.director.status().demand;
  return demand.oriented && (view.record.stylus.X_TI.p - demand.centre_T).norm() < kPenNear;
}

}  // namespace

KindPicture reach_picture() {
  return {.kind = ExerciseKind::kReach,
          .steps =
              [](const RunStage& run) {
                return std::vector{
                    hud_step("Match each lit pen and hold", run.done || run.targets, run.started && !run.targets)};
              },
          .rows =
              [](const Scene& scene, const DirectorStatus& status) {
                return std::vector<HudRow>{{"Pens matched", targets_done(scene, status), ""},
                                           {"Out of time", std::to_string(status.timeouts), "x"},
                                           hold_row(status)};
              },
          .bars = [](const SessionView&) { return std::vector<ForceBar>{}; },
          .add_objects = add_pens,
          .work = pen_work,
          .telling = near_a_pen};
}

}  // namespace trocar
