#include <algorithm>

#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"
#include "scenarios/kinds/gauze/cut_line.h"
#include "scenarios/kinds/gauze/gauze_layout.h"

namespace trocar {
namespace {

using GauzeShape = SceneObject::Shape;
using GauzeStyle = SceneObject::Style;

constexpr double kInkThick = 0.0004, kInkOver = 0.0005;  // m of a stroke of the line, over the gauze's middle
constexpr double kInkApart = 0.0020, kInkShare = 1.1;    // m from stroke to stroke; of that, its length
constexpr double kBarAcross = 0.006, kBarThick = 0.005, kBarBeside = 0.003;  // m of the frame
constexpr double kGapShown = 0.34;  // of the free edge, that the frame leaves open
constexpr double kTellingCut = 0.7;
const Vec3 kInk(0.02, 0.03, 0.08), kFrame(0.10, 0.16, 0.22);

/// The line, stroke by stroke.
void add_line(const SessionView& view, std::vector<SceneObject>& out) {
  const GauzeBoard& board = own_rules<GauzeBoard>(view.scene.board);
  const CutLine line(board.line, own_rules<GauzeLevel>(view.scene.level).off_m);
  const double all = line.way_in_m() + line.round_m();
  const auto strokes = static_cast<int>(all / kInkApart);
  for (int n = 0; n < strokes; ++n) {
    const double arc = (n + 0.5) / strokes * all;
    const LinePlace at = line.at(arc);
    SceneObject ink;
    ink.shape = GauzeShape::kBox;
    ink.size_m = {kInkShare * all / strokes, own_rules<GauzeRules>(view.scene.setup.exercise).line_m, kInkThick};
    const Vec3 drawn_T = board.middle_T + Vec3(at.at.x(), at.at.y(), kInkOver);
    ink.X_TO.p = on_gauze_now_T(view.scene.board.targets, view.director.status().done, view.tissue, drawn_T, arc / all);
    ink.X_TO.R.col(0) = Vec3(at.along.x(), at.along.y(), 0);
    ink.X_TO.R.col(1) = Vec3(-at.along.y(), at.along.x(), 0);
    ink.X_TO.R.col(2) = Vec3::UnitZ();
    ink.colour = kInk;
    out.push_back(ink);
  }
}

/// The frame that the clips sit on, open where the gauze is cut into.
void add_frame(const SessionView& view, std::vector<SceneObject>& out) {
  if (view.scene.sheets.empty()) return;
  Eigen::AlignedBox3d rim;
  for (const Vec3& vertex : view.scene.sheets.front().drawn_T.vertices) rim.extend(vertex);
  const Vec3 low = rim.min(), high = rim.max(), middle = rim.center(), extent = rim.sizes();
  const auto add = [&](const Vec3& centre, double along_x, double along_y) {
    SceneObject bar;
    bar.shape = GauzeShape::kBox;
    bar.size_m = {along_x, along_y, kBarThick};
    bar.X_TO.p = centre;
    bar.colour = kFrame;
    out.push_back(bar);
  };
  const double out_x = extent.x() + 2 * (kBarBeside + kBarAcross / 2), end = (1 - kGapShown) / 2 * extent.x();
  add({middle.x(), high.y() + kBarBeside, middle.z()}, out_x, kBarAcross);
  add({low.x() - kBarBeside, middle.y(), middle.z()}, kBarAcross, extent.y());
  add({high.x() + kBarBeside, middle.y(), middle.z()}, kBarAcross, extent.y());
  add({low.x() + end / 2, low.y() - kBarBeside, middle.z()}, end, kBarAcross);
  add({high.x() - end / 2, low.y() - kBarBeside, middle.z()}, end, kBarAcross);
}

/// Where the next snip is asked for.
void add_next(const SessionView& view, std::vector<SceneObject>& out) {
  const DirectorStatus& status = view.director.status();
  if (status.cue != Cue::kSnip) return;
  SceneObject ring;
  ring.shape = GauzeShape::kRing;
  ring.style = GauzeStyle::kGhostLit;
  ring.size_m = {2 * own_rules<GauzeLevel>(view.scene.level).off_m + 0.002, 0, 0.0008};
  ring.X_TO.p = status.demand.centre_T + Vec3(0, 0, kInkOver);
  out.push_back(ring);
}

void add_gauze_objects(const SessionView& view, std::vector<SceneObject>& out) {
  add_frame(view, out);
  add_line(view, out);
  add_next(view, out);
}

std::vector<ForceBar> gauze_bars(const SessionView& view) {
  const GauzeRules& rules = own_rules<GauzeRules>(view.scene.setup.exercise);
  return tip_bar(view, "Press", {rules.press_low_n, rules.press_high_n});
}

Eigen::AlignedBox3d gauze_work(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (const SheetSetup& sheet : scene.sheets)
    for (const Vec3& vertex : sheet.drawn_T.vertices) box.extend(vertex);
  return box;
}

/// The places are asked for on the line, and not by discs on the organ beneath.
void hide_places(const SessionView&, std::vector<TargetMark>& discs) { discs.clear(); }

}  // namespace

KindPicture gauze_picture() {
  return {.kind = ExerciseKind::kGauze,
          .steps =
              [](const RunStage& run) {
                return std::vector{hud_step("Cut out the circle", run.done, run.started && !run.done)};
              },
          .rows =
              [](const Scene&, const DirectorStatus& status) {
                return std::vector<HudRow>{{"Line cut", hud_number("%.0f", 100 * status.exposure), "%"},
                                           {"Off the line", std::to_string(status.wrong_places), "x"}};
              },
          .bars = gauze_bars,
          .add_objects = add_gauze_objects,
          .work = gauze_work,
          .telling = [](const SessionView& view) { return view.director.status().exposure >= kTellingCut; },
          .add_marks = hide_places};
}

}  // namespace trocar
