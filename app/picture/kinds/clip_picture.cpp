#include <array>

#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"
#include "app/picture/kinds/stage_parts.h"
#include "haptics/least_turn.h"
#include "scenarios/kinds/clip/clip_rules.h"

namespace trocar {
namespace {

constexpr double kRingWider = 0.0026, kRingThick = 0.0009;  // m, of a ring round a structure
constexpr std::array<std::array<double, 2>, 2> kNeck{{{0.005, 0.014}, {0.015, 0.022}}};  // m beyond the ends; across
const Vec3 kGallbladder(0.22, 0.25, 0.12);

SceneObject ring_round_place(const Target& place, double radius_m, bool lit) {
  SceneObject ring;
  ring.shape = SceneObject::Shape::kRing;
  ring.style = lit ? SceneObject::Style::kGhostLit : SceneObject::Style::kGhost;
  const double across = 2 * (radius_m + kRingWider);
  ring.size_m = {across, across, kRingThick};
  const Vec3 along = place.R_TI.col(0);
  ring.X_TO = {least_turn(Vec3::UnitZ(), along).toRotationMatrix(), place.centre_T};
  return ring;
}

/// What holds duct and artery at their far ends: the gallbladder's neck, lifted by an assistant. Seen, not felt.
void add_neck(const Board& board, std::vector<SceneObject>& out) {
  const Vec3 ends = (board.ducts_T[0].back() + board.ducts_T[1].back()) / 2;
  const Vec3 along = (ends - (board.ducts_T[0].front() + board.ducts_T[1].front()) / 2).normalized();
  for (const auto& [beyond_m, across_m] : kNeck) {
    SceneObject ball;
    ball.shape = SceneObject::Shape::kSphere;
    ball.look = SceneObject::Look::kPlastic;
    ball.size_m = Vec3::Constant(across_m);
    ball.X_TO.p = ends + beyond_m * along;
    ball.colour = kGallbladder;
    out.push_back(ball);
  }
}

}  // namespace

void add_clip_places(const Exercise& exercise, const ExerciseLevel& level, const Board& board,
                     const DirectorStatus& status, std::vector<SceneObject>& out) {
  add_neck(board, out);
  if (!own_rules<ClipLevel>(level).places_shown || status.target_index < 0) return;
  const ClipAim asked = clip_aim(status.target_index);
  for (int target = 0; target < kClipAims; ++target) {
    const ClipAim aim = clip_aim(target);
    if (aim.structure != asked.structure || aim.step != asked.step || status.done[static_cast<std::size_t>(target)])
      continue;
    const Target& place = board.targets[static_cast<std::size_t>(target)];
    const double radius_m = exercise.ducts[static_cast<std::size_t>(aim.structure)].outer_radius_m;
    out.push_back(ring_round_place(place, radius_m, target == status.target_index));
  }
}

namespace {

std::vector<ForceBar> clip_bars(const SessionView& view) {
  const ClipRules& rules = own_rules<ClipRules>(view.scene.setup.exercise);
  return tip_bar(view, "Pull", {rules.pull_low_n, rules.pull_high_n});
}

/// Ducts and the way of the instrument to them.
Eigen::AlignedBox3d clip_work(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (const Target& target : scene.board.targets) box.extend(target.centre_T);
  for (std::size_t d = kClipStructures; d < scene.board.ducts_T.size(); ++d)
    for (const Vec3& point : scene.board.ducts_T[d]) box.extend(point);
  return box;
}

}  // namespace

KindPicture clip_picture() {
  return {.kind = ExerciseKind::kClip,
          .steps =
              [](const RunStage& run) {
                return std::vector{
                    hud_step("Touch duct and artery, clip each, cut between", run.done, run.started && !run.done)};
              },
          .rows =
              [](const Scene&, const DirectorStatus& status) {
                int clips = 0;
                for (std::size_t i = kFirstClipAim; i < kFirstCutAim; ++i) clips += status.done[i];
                return std::vector<HudRow>{{"Clips set", std::to_string(clips) + " / 6", ""},
                                           {"Mistakes", std::to_string(status.wrong_places), "x"},
                                           hold_row(status)};
              },
          .bars = clip_bars,
          .add_objects =
              [](const SessionView& view, std::vector<SceneObject>& out) {
                const Scene& scene = view.scene;
                add_clip_places(scene.setup.exercise, scene.level, scene.board, view.director.status(), out);
              },
          .work = clip_work,
          .telling =
              [](const SessionView& view) {
                return view.director.status().target_index == kClipAims - 1 && view.tissue &&
                       view.tissue->touched_duct == kClipStructures - 1;
              }};
}

}  // namespace trocar
