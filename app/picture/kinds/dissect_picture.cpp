#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"
#include "haptics/least_turn.h"
#include "scenarios/kinds/dissect/dissect_rules.h"

namespace trocar {
namespace {

constexpr double kBesideVessel = 0.005;                 // m
constexpr double kLitRing = 0.007, kLitThick = 0.0008;  // m, round the middle of the lit strand

/// A ring round the lit strand, which it passes through, and where the tip shall be lifted to.
void add_lit_strand(const SessionView& view, std::vector<SceneObject>& out) {
  const DirectorStatus& status = view.director.status();
  if (status.cue != Cue::kHook || status.target_index < 0 || status.exposure >= 1) return;
  const auto& path = view.scene.board.ducts_T[static_cast<std::size_t>(status.target_index)];
  SceneObject ring;
  ring.shape = SceneObject::Shape::kRing;
  ring.style = SceneObject::Style::kGhostLit;
  ring.size_m = {kLitRing, kLitRing, kLitThick};
  const Vec3 along = (path.back() - path.front()).normalized();
  ring.X_TO = {least_turn(Vec3::UnitZ(), along).toRotationMatrix(), status.demand.centre_T};
  out.push_back(ring);
}

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

std::string of_count(const DirectorStatus& status, int from, int to) {
  int done = 0;
  for (int i = from; i < to; ++i) done += status.done[static_cast<std::size_t>(i)];
  return std::to_string(done) + " / " + std::to_string(to - from);
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
              [](const Scene&, const DirectorStatus& status) {
                return std::vector<HudRow>{{"Strands divided", of_count(status, 0, kStrands), ""},
                                           {"Vessels sealed", of_count(status, kStrands, kDissectAims), ""},
                                           {"Lifted", hud_number("%.0f", 100 * status.exposure), "%"},
                                           {"Mistakes", std::to_string(status.wrong_places), "x"}};
              },
          .bars = dissect_bars,
          .add_objects = add_lit_strand,
          .work = dissect_work,
          .telling =
              [](const SessionView& view) {
                const DirectorStatus& status = view.director.status();
                const StylusState& stylus = view.record.stylus;
                const bool beside = (stylus.X_TI.p - status.demand.centre_T).norm() < kBesideVessel;
                return status.cue == Cue::kSeal && status.done[kStrands] && beside && stylus.pedal;
              },
          .add_marks = keep_lit_vessel};
}

}  // namespace trocar
