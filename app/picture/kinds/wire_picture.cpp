#include <algorithm>
#include <cmath>

#include "app/picture/kinds/board_object.h"
#include "app/picture/kinds/hud_parts.h"
#include "app/picture/kinds/kind_picture.h"
#include "haptics/least_turn.h"
#include "scenarios/kinds/wire/wire_layout.h"
#include "scenarios/kinds/wire/wire_rules.h"

namespace trocar {
namespace {

using Shape = SceneObject::Shape;
using Style = SceneObject::Style;

constexpr double kWireBoardSide = 0.180, kWireBoardThickness = 0.004;
constexpr double kBoardBelowWire = 0.025;  // m: seen, not felt
constexpr double kPieceOverlap = 1.15;     // so that no gap opens in a bend
constexpr std::size_t kPointsPerPiece = 2;

const Vec3 kWireBoardLines(0.34, 0.34, 0.33);
const Vec3 kBareWire(0.52, 0.52, 0.54), kPassedWire(0.06, 0.30, 0.52);
const Vec3 kRingColour(0.70, 0.42, 0.06);

/// Its z onto `along`.
Mat3 z_along(const Vec3& along) { return least_turn(Vec3::UnitZ(), along).toRotationMatrix(); }

SceneObject rod(const Vec3& from, const Vec3& to, double radius_m, double longer) {
  SceneObject out;
  out.shape = Shape::kCylinder;
  out.look = SceneObject::Look::kSteel;
  const Vec3 way = to - from;
  out.size_m = {2 * radius_m, 2 * radius_m, longer * way.norm()};
  out.X_TO = {z_along(way.normalized()), (from + to) / 2};
  return out;
}

SceneObject ring_round(const RingOnWire& ring, const WireRules& rules, const Pose& X_TI) {
  SceneObject out;
  out.shape = Shape::kRing;
  const double outer = 2 * (ring.play_m + rules.radius_m + rules.ring_thickness_m);
  out.size_m = {outer, outer, rules.ring_thickness_m};
  out.X_TO = {z_along(X_TI.R * ring.normal_I), X_TI * ring.centre_I};
  out.colour = kRingColour;
  return out;
}

double wire_board_z(const Board& board) {
  double lowest = 0;
  for (const Vec3& point : board.wire_T) lowest = std::min(lowest, point.z());
  return lowest - kBoardBelowWire;
}

/// Of the wire as far as the last gate passed.
std::size_t points_passed(const SessionView& view, const Board& board) {
  const int done = view.director.status().targets_done;
  if (done <= 0) return 0;
  const std::vector<double> along = arc_lengths(board.wire_T);
  const double passed =
      gate_places(view.scene.setup.exercise.layout.count, along.back())[static_cast<std::size_t>(done - 1)];
  return static_cast<std::size_t>(std::lower_bound(along.begin(), along.end(), passed) - along.begin());
}

void add_wire(const SessionView& view, std::vector<SceneObject>& out) {
  const Exercise& exercise = view.scene.setup.exercise;
  const WireRules& rules = own_rules<WireRules>(exercise);
  const Board& board = view.director.board();
  const double board_z = wire_board_z(board);
  out.push_back(board_object(board_z, kWireBoardSide, kWireBoardThickness, board.centre_T, kWireBoardLines));
  const std::size_t passed = points_passed(view, board);
  for (std::size_t i = 0; i + 1 < board.wire_T.size(); i += kPointsPerPiece) {
    const std::size_t end = std::min(i + kPointsPerPiece, board.wire_T.size() - 1);
    out.push_back(rod(board.wire_T[i], board.wire_T[end], rules.radius_m, kPieceOverlap));
    out.back().colour = end <= passed ? kPassedWire : kBareWire;
  }
  const Vec3& last = board.wire_T.back();
  out.push_back(rod({last.x(), last.y(), board_z}, last, rules.radius_m, 1));
  out.back().colour = kBareWire;

  const RingOnWire ring = ring_of(exercise, view.scene.level);
  out.push_back(ring_round(ring, rules, view.record.stylus.X_TI));
  if (view.record.stylus.contact) out.back().style = Style::kLit;
  const DirectorStatus& status = view.director.status();
  if (status.target_index < 0) return;
  out.push_back(ring_round(ring, rules, {status.demand.R_TI, status.demand.centre_T}));
  out.back().style = Style::kGhostLit;
}

Eigen::AlignedBox3d wire_work(const Scene& scene) {
  Eigen::AlignedBox3d box;
  box.extend(scene.board.start_T);
  for (const Vec3& point : scene.board.wire_T) box.extend(point);
  for (const Target& gate : scene.board.targets) box.extend(gate.centre_T);
  return box;
}

}  // namespace

KindPicture wire_picture() {
  return {.kind = ExerciseKind::kWire,
          .steps =
              [](const RunStage& run) {
                return std::vector{hud_step("Move the ring along the wire to its other end", run.done || run.targets,
                                            run.started && !run.targets)};
              },
          .rows =
              [](const Scene& scene, const DirectorStatus& status) {
                return std::vector<HudRow>{{"Gates passed", targets_done(scene, status), ""},
                                           {"Wire touched", std::to_string(status.wrong_places), "x"}};
              },
          .bars = [](const SessionView&) { return std::vector<ForceBar>{}; },
          .add_objects = add_wire,
          .work = wire_work,
          .telling = [](const SessionView& view) { return view.director.status().ring != nullptr; }};
}

}  // namespace trocar
