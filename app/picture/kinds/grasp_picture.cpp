#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"
#include "tissue/tissue_frame.h"

namespace trocar {
namespace {

constexpr double kTellingLift = 0.030;  // m of a block's middle over the board: well in the air

Eigen::AlignedBox3d board_work(const Scene& scene) {
  Eigen::AlignedBox3d box;
  if (!scene.board.rigid.board) return box;
  const BoardPlate& plate = *scene.board.rigid.board;
  const double h = plate.half_extent_m;
  box.extend(Vec3(-h, -h, plate.top_z_m)).extend(Vec3(h, h, plate.top_z_m + 0.03));
  return box;
}

bool carries_high(const SessionView& view) {
  return view.director.status().cue == Cue::kCarry && view.tissue && view.tissue->held() &&
         view.tissue->object[static_cast<std::size_t>(view.tissue->grip_object)].X_TO.p.z() > kTellingLift;
}

}  // namespace

KindPicture grasp_picture() {
  return {.kind = ExerciseKind::kGrasp,
          .steps =
              [](const RunStage& run) {
                return std::vector{
                    hud_step("Carry each lit block to its ring", run.done || run.targets, run.started && !run.targets)};
              },
          .rows =
              [](const Scene& scene, const DirectorStatus& status) {
                return std::vector<HudRow>{{"Blocks placed", targets_done(scene, status), ""},
                                           {"Errors", std::to_string(status.wrong_places), "x"}};
              },
          .bars = grip_of_lit_object,
          .add_objects = [](const SessionView&, std::vector<SceneObject>&) {},
          .work = board_work,
          .telling = carries_high};
}

}  // namespace trocar
