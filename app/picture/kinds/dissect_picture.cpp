#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"
#include "app/picture/kinds/stage_parts.h"
#include "haptics/least_turn.h"
#include "scenarios/kinds/dissect/dissect_rules.h"

namespace trocar {
namespace {

constexpr double kBesideVessel = 0.005;                 // m
constexpr double kLitRing = 0.007, kLitThick = 0.0008;  // m, round the middle of the lit strand

}  // namespace

void add_lit_strand(const Board& board, const DirectorStatus& status, std::vector<SceneObject>& out) {
  if (status.cue != Cue::kHook || status.target_index < 0 || status.exposure >= 1) return;
  const auto& path = board.ducts_T[static_cast<std::size_t>(status.target_index)];
  SceneObject ring;
  ring.shape = SceneObject::Shape::kRing;
  ring.style = SceneObject::Style::kGhostLit;
  ring.size_m = {kLitRing, kLitRing, kLitThick};
  const Vec3 along = (path.back() - path.front()).normalized();
  ring.X_TO = {least_turn(Vec3::UnitZ(), along).toRotationMatrix(), status.demand.centre_T};
  out.push_back(ring);
}

namespace {

/// A disc under a strand would be taken for what is to be touched, and vessels are not there before they spurt.
void keep_lit_vessel(const SessionView& view, std::vector<TargetMark>& discs) {
  const DirectorStatus& status = view.director.status();
  const std::int32_t lit = status.cue == Cue::kSeal ? status.target_index : -1;
  for (std::size_t i = discs.size(); i-- > 0;)
    if (static_cast<std::int32_t>(i) != lit) discs.erase(discs.begin() + static_cast<std::ptrdiff_t>(i));
}

std::vector<ForceBar> dissect_bars(const SessionView& view) {
  return tip_bar(view, "Force", {0, view.scene.setup.exercise.soft_force_n});
}

Eigen::AlignedBox3d dissect_work(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (const Target& target : scene.board.targets) box.extend(target.centre_T);
  for (const std::vector<Vec3>& strand : scene.board.ducts_T)
    for (const Vec3& point : strand) box.extend(point);
  return box;
}

}  // namespace

KindPicture dissect_picture() {
  return {.kind = ExerciseKind::kDissect,
          .steps =
              [](const RunStage& run) {
                return std::vector{
                    hud_step("Divide the strands, then stop the bleeding", run.done, run.started && !run.done)};
              },
          .rows =
              [](const Scene& scene, const DirectorStatus& status) {
                const int strands = own_rules<DissectRules>(scene.setup.exercise).strands;
                const auto objects = static_cast<int>(scene.board.targets.size());
                return std::vector<HudRow>{{"Strands divided", of_count(status, 0, strands), ""},
                                           {"Vessels sealed", of_count(status, strands, objects), ""},
                                           {"Lifted", hud_number("%.0f", 100 * status.exposure), "%"},
                                           {"Mistakes", std::to_string(status.wrong_places), "x"}};
              },
          .bars = dissect_bars,
          .add_objects =
              [](const SessionView& view, std::vector<SceneObject>& out) {
                add_lit_strand(view.scene.board, view.director.status(), out);
              },
          .work = dissect_work,
          .telling =
              [](const SessionView& view) {
                const DirectorStatus& status = view.director.status();
                const StylusState& stylus = view.record.stylus;
                const bool beside = (stylus.X_TI.p - status.demand.centre_T).norm() < kBesideVessel;
                return status.cue == Cue::kSeal && status.done[kMostStrands] && beside && stylus.pedal;
              },
          .add_marks = keep_lit_vessel};
}

}  // namespace trocar
