#include "scenarios/kinds/palpate/palpate_kind.h"

#include "scenarios/kinds/kind_parts.h"
#include "scenarios/kinds/palpate/palpate_layout.h"
#include "scenarios/kinds/palpate/palpate_reader.h"
#include "scenarios/kinds/palpate/palpate_task.h"
#include "scenarios/scoring/event_types.h"

namespace trocar {
namespace {

JudgedForces palpate_limits(const Exercise& exercise, const ExerciseLevel&, const Board&, int) {
  return {.tip_n = exercise.hard_force_n, .grip_n = {}};
}

Board lay_out_palpate(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place) {
  return lay_out_nodules(place.organ_T, exercise, level, board, place.behind_tip);
}

/// Asked for are the nodules, not what lies beside them; done are those that were found. Nobody says where to search,
/// so there is no ideal way.
void account_nodules(const Board& board, const std::vector<Event>& events, ScoringContext& context) {
  double stiffest = 0;
  for (const HiddenNodule& nodule : board.nodules) stiffest = std::max(stiffest, nodule.stiffness_ratio);
  for (const HiddenNodule& nodule : board.nodules) context.objects_total += nodule.stiffness_ratio >= stiffest ? 1 : 0;
  // What was marked is done; whether it was right is the matter of search_share.
  for (const Event& event : events)
    context.objects_done += event.type == event_type::kNoduleFound || event.type == event_type::kFalseMark ? 1 : 0;
}

}  // namespace

KindDescription palpate_kind() {
  return {.kind = ExerciseKind::kPalpate,
          .name = "palpate",
          .on_organ = true,
          .oriented = false,
          .jaws_hold = false,
          .tool = ToolKind::kProbe,
          .watched = WatchedForce::kTip,
          .limits = palpate_limits,
          .read_targets = read_nodule_places,
          .read = read_palpate,
          .read_level = read_palpate_level,
          .lay_out = lay_out_palpate,
          .tasks = one_task<PalpateTask>,
          .account = account_nodules};
}

}  // namespace trocar
