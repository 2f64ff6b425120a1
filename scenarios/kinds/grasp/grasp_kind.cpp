#include "scenarios/kinds/grasp/grasp_kind.h"

#include <algorithm>
#include <set>

#include "scenarios/kinds/grasp/grasp_layout.h"
#include "scenarios/kinds/grasp/grasp_reader.h"
#include "scenarios/kinds/grasp/grasp_task.h"
#include "scenarios/kinds/kind_parts.h"
#include "scenarios/scoring/event_types.h"

namespace trocar {
namespace {

/// Where the lit block's foam is crushed; where no colour tells it, where the hardest is.
JudgedForces grasp_limits(const Exercise& exercise, const ExerciseLevel& level, const Board& board, int lit) {
  if (lit >= 0 && level.grasp.colour_cue && static_cast<std::size_t>(lit) < board.rigid.blocks.size())
    return {.tip_n = {}, .grip_n = board.rigid.blocks[static_cast<std::size_t>(lit)].crush_above_n};
  double limit_n = 0;
  for (const FoamKind& kind : exercise.grasp.kinds) limit_n = std::max(limit_n, kind.crush_above_n);
  return {.tip_n = {}, .grip_n = limit_n};
}

Board lay_out_grasp(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace&) {
  return lay_out_blocks(exercise, level, board);
}

/// Windows of all blocks; the way to each placed block and on to its ring, in the order of placing. A block that left
/// its ring again is not done, and so is one that is lost.
void account_blocks(const Board& board, const std::vector<Event>& events, ScoringContext& context) {
  for (const Target& ring : board.targets) context.grip_windows.push_back({ring.band.low_n, ring.band.high_n});
  std::set<std::int32_t> done, seen;
  for (const Event& event : events) {
    const auto index = static_cast<std::size_t>(event.object);
    if (event.object < 0 || index >= board.rigid.blocks.size()) continue;
    if (event.type == event_type::kRemoved || event.type == event_type::kLost) done.erase(event.object);
    if (event.type != event_type::kPlaced) continue;
    done.insert(event.object);
    if (!seen.insert(event.object).second) continue;
    const Vec3 up(0, 0, board.rigid.blocks[index].size_m.z() / 2);
    context.waypoints.push_back(board.rigid.blocks[index].X_TO.p);
    context.waypoints.push_back(board.targets[index].centre_T + up);
  }
  context.objects_total = static_cast<int>(board.targets.size());
  context.objects_done = static_cast<int>(done.size());
}

}  // namespace

KindDescription grasp_kind() {
  return {.kind = ExerciseKind::kGrasp,
          .name = "grasp",
          .on_organ = false,
          .oriented = false,
          .jaws_hold = true,
          .tool = ToolKind::kGrasper,
          .watched = WatchedForce::kGrip,
          .limits = grasp_limits,
          .read_targets = [](StrictTable&, TargetLayout&) {},
          .read = read_grasp,
          .read_level = read_grasp_level,
          .lay_out = lay_out_grasp,
          .tasks = one_task<GraspTask>,
          .account = account_blocks};
}

}  // namespace trocar
