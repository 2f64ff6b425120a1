#include "scenarios/kinds/pegs/pegs_kind.h"

#include "scenarios/director/scoring_context.h"
#include "scenarios/kinds/kind_parts.h"
#include "scenarios/kinds/pegs/peg_task.h"
#include "scenarios/kinds/pegs/pegs_layout.h"
#include "scenarios/kinds/pegs/pegs_reader.h"
#include "scenarios/kinds/pegs/pegs_rules.h"
#include "scenarios/scoring/event_types.h"

namespace trocar {
namespace {

JudgedForces pegs_limits(const Exercise& exercise, const ExerciseLevel&, const Board&, int) {
  return {.tip_n = {}, .grip_n = own_rules<PegsRules>(exercise).mark_above_n};
}

Board lay_out_peg_board(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace&) {
  return lay_out_pegs(exercise, level, board);
}

/// The grip wanted in all transfers; the way to the ring of each that was done and on to its peg. A ring that was put
/// on its peg once is done, whatever happens to it then.
void account_transfers(const Board& board, const std::vector<Event>& events, ScoringContext& context) {
  for (const Target& goal : board.targets) context.grip_windows.push_back({goal.band.low_n, goal.band.high_n});
  const std::size_t rings = board.rigid.blocks.size();
  context.objects_total = static_cast<int>(board.targets.size());
  for (const Event& event : events) {
    const auto index = static_cast<std::size_t>(event.object);
    if (event.type != event_type::kTargetHeld || event.object < 0 || index >= board.targets.size()) continue;
    const Vec3 up(0, 0, board.rigid.blocks[index % rings].size_m.z() / 2);
    const Vec3 foot = index < rings ? board.targets[index + rings].centre_T : board.targets[index - rings].centre_T;
    context.waypoints.push_back(foot + up);
    context.waypoints.push_back(board.targets[index].centre_T + up);
    ++context.objects_done;
  }
}

}  // namespace

KindDescription pegs_kind() {
  return {.kind = ExerciseKind::kPegs,
          .name = "pegs",
          .on_organ = false,
          .oriented = false,
          .jaws_hold = true,
          .tool = ToolKind::kGrasper,
          .watched = WatchedForce::kGrip,
          .limits = pegs_limits,
          .read = read_pegs,
          .read_level = read_pegs_level,
          .lay_out = lay_out_peg_board,
          .tasks = one_task<PegTask>,
          .account = account_transfers};
}

}  // namespace trocar
