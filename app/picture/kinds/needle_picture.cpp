#include <algorithm>

#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"
#include "scenarios/kinds/needle/needle_rules.h"

namespace trocar {
namespace {

const Vec3 kStandFoam(0.16, 0.30, 0.55);
constexpr double kStandWide = 0.010, kStandDeep = 0.004, kStandHigh = 0.006;    // m
constexpr double kSlitRadius = 0.0006, kSlitStep = 0.002, kSlitBeyond = 0.004;  // m, of the dots that draw the slit

/// The block in which needles stand, its lower part.
void add_stand(const SessionView& view, std::vector<SceneObject>& out) {
  const NeedleBoard& own = own_rules<NeedleBoard>(view.scene.board);
  SceneObject block;
  block.look = SceneObject::Look::kFoam;
  block.colour = kStandFoam;
  block.size_m = {kStandWide, kStandDeep, kStandHigh};
  // Its long side in the needle's plane, its upper face at a third of the circle.
  const Vec3 across = own.X_TN_stand.R.col(2), side = Vec3::UnitZ().cross(across).normalized();
  block.X_TO.R.col(0) = side;
  block.X_TO.R.col(1) = Vec3::UnitZ().cross(side);
  block.X_TO.R.col(2) = Vec3::UnitZ();
  block.X_TO.p = own.X_TN_stand.p - (own.shape.radius_m() * 2 / 3 + kStandHigh / 2) * Vec3::UnitZ();
  out.push_back(block);
}

/// Both dots of a pair look alike; between the pairs runs the slit.
void add_dots(const SessionView& view, std::vector<TargetMark>& out) {
  const std::vector<Target>& dots = view.scene.board.targets;
  const std::size_t pairs = dots.size() / 2;
  for (std::size_t pair = 0; pair < pairs; ++pair) out[pairs + pair].state = out[pair].state;
  const auto middle = [&](std::size_t pair) -> Vec3 { return (dots[pair].centre_T + dots[pairs + pair].centre_T) / 2; };
  for (std::size_t pair = 0; pair + 1 < pairs; ++pair) {
    const Vec3 from = middle(pair), way = middle(pair + 1) - from;
    const int steps = std::max(1, static_cast<int>(way.norm() / kSlitStep));
    const int before = pair == 0 ? static_cast<int>(kSlitBeyond / kSlitStep) : 0;
    const int beyond = pair + 2 == pairs ? static_cast<int>(kSlitBeyond / kSlitStep) : 0;
    for (int i = -before; i < steps + beyond; ++i)
      out.push_back({from + way * i / steps, dots[pair].normal_T, kSlitRadius, TargetMark::State::kWaiting});
  }
}

std::vector<ForceBar> needle_bars(const SessionView& view) {
  return tip_bar(view, "Tip force", {0, view.scene.setup.exercise.soft_force_n});
}

/// The dots, and the needle that stands over them.
Eigen::AlignedBox3d needle_work(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (const Target& target : scene.board.targets) box.extend(target.centre_T);
  const NeedleBoard& own = own_rules<NeedleBoard>(scene.board);
  box.extend(Vec3(own.X_TN_stand.p + own.shape.radius_m() * Vec3::UnitZ()));
  return box;
}

}  // namespace

KindPicture needle_picture() {
  return {.kind = ExerciseKind::kNeedle,
          .steps =
              [](const RunStage& run) {
                return std::vector{hud_step("Take the needle, drive it through each pair, draw it out", run.done,
                                            run.started && !run.done)};
              },
          .rows =
              [](const Scene& scene, const DirectorStatus& status) {
                const std::size_t pairs = scene.board.targets.size() / 2;
                return std::vector<HudRow>{
                    {"Pairs done", std::to_string(status.targets_done) + " / " + std::to_string(pairs), ""},
                    {"Mistakes", std::to_string(status.wrong_places), "x"}};
              },
          .bars = needle_bars,
          .add_objects = add_stand,
          .work = needle_work,
          .telling =
              [](const SessionView& view) {
                const bool good = !view.director.status().warning;
                return good && view.tissue && view.tissue->needle.bite_count > 0 && view.tissue->needle.bite[0].through;
              },
          .add_marks = add_dots};
}

}  // namespace trocar
