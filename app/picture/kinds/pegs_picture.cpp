#include "app/picture/kinds/board_object.h"
#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"
#include "tissue/tissue_frame.h"

namespace trocar {
namespace {

/// A ghost of the lit ring round the lit peg.
void add_peg_goal(const SessionView& view, std::vector<SceneObject>& out) {
  const DirectorStatus& status = view.director.status();
  const std::vector<FoamBlock>& rings = view.scene.board.rigid.blocks;
  if (status.target_index < 0) return;
  SceneObject ghost = triangle_object(rings[static_cast<std::size_t>(status.target_index) % rings.size()]);
  ghost.style = SceneObject::Style::kGhostLit;
  ghost.X_TO = {status.demand.object.X_TO.R, status.demand.goal_T + Vec3(0, 0, ghost.size_m.z() / 2)};
  if (std::abs(ghost.X_TO.R(2, 2)) < 0.9) ghost.X_TO.R.setIdentity();
  out.push_back(ghost);
}

Eigen::AlignedBox3d pegs_work(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (const PegPost& peg : scene.board.rigid.pegs) {
    const Vec3 beside(0.010, 0.010, 0);
    box.extend(Vec3(peg.foot_T - beside)).extend(Vec3(peg.foot_T + beside + Vec3(0, 0, 2 * peg.height_m)));
  }
  return box;
}

bool carries_over_pegs(const SessionView& view) {
  if (view.director.status().cue != Cue::kCarry || !view.tissue || !view.tissue->held()) return false;
  const double height = view.tissue->object[static_cast<std::size_t>(view.tissue->grip_object)].X_TO.p.z();
  return height > view.scene.board.rigid.pegs.front().height_m;
}

}  // namespace

KindPicture pegs_picture() {
  return {.kind = ExerciseKind::kPegs,
          .steps =
              [](const RunStage& run) {
                return std::vector{
                    hud_step("Move all rings across and back", run.done || run.targets, run.started && !run.targets)};
              },
          .rows =
              [](const Scene& scene, const DirectorStatus& status) {
                return std::vector<HudRow>{{"Rings moved", targets_done(scene, status), ""},
                                           {"Errors", std::to_string(status.wrong_places), "x"}};
              },
          .bars = grip_of_lit_object,
          .add_objects = add_peg_goal,
          .work = pegs_work,
          .telling = carries_over_pegs};
}

}  // namespace trocar
