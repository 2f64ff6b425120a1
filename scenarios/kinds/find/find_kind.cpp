#include "scenarios/kinds/find/find_kind.h"

#include <set>

#include "scenarios/kinds/find/find_layout.h"
#include "scenarios/kinds/find/find_reader.h"
#include "scenarios/kinds/find/find_rules.h"
#include "scenarios/kinds/find/find_task.h"
#include "scenarios/kinds/kind_parts.h"
#include "scenarios/kinds/touch/touch_reader.h"
#include "scenarios/scoring/event_types.h"

namespace trocar {
namespace {

Board lay_out_flap(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place) {
  return lay_out_find(place.organ_T, exercise, level, board);
}

/// Done is what was held long enough and then told, right or wrong: who guesses has done nothing.
void account_pins(const Board& board, const std::vector<Event>& events, ScoringContext& context) {
  const FindBoard& own = own_rules<FindBoard>(board);
  std::set<std::int32_t> held, done;
  for (const Event& event : events) {
    if (event.type == event_type::kTargetHeld) held.insert(event.object);
    const bool told = event.type == event_type::kAnswered || event.type == event_type::kWrongAnswer;
    if (!told || !held.contains(event.object) || !done.insert(event.object).second) continue;
    const auto index = static_cast<std::size_t>(event.object);
    if (index >= board.targets.size()) continue;
    context.waypoints.push_back(board.targets[index].centre_T);
    context.waypoints.push_back(own.answers_T[static_cast<std::size_t>(own.pins[index].symbol)]);
  }
  context.objects_total = static_cast<int>(board.targets.size());
  context.objects_done = static_cast<int>(done.size());
}

}  // namespace

KindDescription find_kind() {
  return {.kind = ExerciseKind::kFind,
          .name = "find",
          .on_organ = true,
          .oriented = false,
          .jaws_hold = true,
          .tool = ToolKind::kGrasper,
          .watched = WatchedForce::kTip,
          .limits =
              [](const Exercise& exercise, const ExerciseLevel&, const Board&, int) {
                return JudgedForces{exercise.hard_force_n, own_rules<FindRules>(exercise).grip_most_n};
              },
          .read_targets = read_discs,
          .read = read_find,
          .read_level = read_find_level,
          .lay_out = lay_out_flap,
          .tasks = one_task<FindTask>,
          .account = account_pins};
}

}  // namespace trocar
