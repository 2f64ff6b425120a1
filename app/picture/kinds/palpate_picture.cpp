#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"
#include "scenarios/kinds/palpate/palpate_rules.h"
#include "scenarios/layout/height_field.h"

namespace trocar {
namespace {

constexpr double kMarkRadius = 0.003, kCornerRadius = 0.0012;  // m
constexpr int kCornersASide = 4;                               // of the region's edge, dots from corner to corner

/// What was marked, and dots along the edge of the region. Whether a mark is right is not to be seen.
void add_palpate_marks(const SessionView& view, std::vector<TargetMark>& out) {
  const DirectorStatus& status = view.director.status();
  const HeightField organ(*view.scene.organ_T);
  const auto add = [&](const Vec3& place_T, double radius_m, TargetMark::State state) {
    if (const auto at = organ.top(place_T.x(), place_T.y())) out.push_back({at->position, at->normal, radius_m, state});
  };
  const TargetLayout& layout = view.scene.setup.exercise.layout;
  for (int i = 0; i <= kCornersASide; ++i)
    for (int j = 0; j <= kCornersASide; ++j) {
      if (i % kCornersASide != 0 && j % kCornersASide != 0) continue;
      const Vec3 off((i / double{kCornersASide} - 0.5) * layout.region_x_m,
                     (j / double{kCornersASide} - 0.5) * layout.region_y_m, 0);
      add(view.scene.board.centre_T + off, kCornerRadius, TargetMark::State::kWaiting);
    }
  for (int i = 0; i < status.mark_count; ++i)
    add(status.marks_T[static_cast<std::size_t>(i)], kMarkRadius, TargetMark::State::kLit);
}

/// Of the tip, with the force that judges well and the limit; without a bar the pinch has none either.
std::vector<ForceBar> palpate_bars(const SessionView& view) {
  return tip_bar(view, "Tip force", {view.scene.level.band_low_n, view.scene.level.band_high_n});
}

std::vector<HudRow> palpate_rows(const Scene& scene, const DirectorStatus& status) {
  const std::size_t count = own_rules<PalpateRules>(scene.setup.exercise).nodules.size();
  std::vector<HudRow> rows{{"Marks set", std::to_string(status.mark_count) + " / " + std::to_string(count), ""}};
  if (own_rules<PalpateLevel>(scene.level).found_shown)
    rows.push_back({"False marks", std::to_string(status.wrong_places), ""});
  rows.push_back({"Too much force", std::to_string(status.excess_forces), "x"});
  rows.push_back(hold_row(status));
  return rows;
}

bool marking(const SessionView& view) {
  const DirectorStatus& status = view.director.status();
  return status.mark_count > 0 && status.hold_progress > 0.5;
}

}  // namespace

KindPicture palpate_picture() {
  return {
      .kind = ExerciseKind::kPalpate,
      .steps =
          [](const RunStage& run) {
            return std::vector{hud_step("Feel the region and mark what is hidden", run.done, run.started && !run.done)};
          },
      .rows = palpate_rows,
      .bars = palpate_bars,
      .add_objects = [](const SessionView&, std::vector<SceneObject>&) {},
      .work = [](const Scene&) { return Eigen::AlignedBox3d(); },
      .telling = marking,
      .add_marks = add_palpate_marks};
}

}  // namespace trocar
