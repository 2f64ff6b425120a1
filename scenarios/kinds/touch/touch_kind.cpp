#include "scenarios/kinds/touch/touch_kind.h"

#include <algorithm>

#include "scenarios/director/scoring_context.h"
#include "scenarios/files/file_units.h"
#include "scenarios/files/level_keys.h"
#include "scenarios/kinds/touch/disc_layout.h"
#include "scenarios/kinds/touch/disc_task.h"
#include "scenarios/kinds/touch/squeeze_task.h"
#include "scenarios/kinds/touch/touch_reader.h"

namespace trocar {
namespace {

using file_units::kMilli;

void read_grip(StrictTable table, GripTask& grip) {
  grip.block_thickness_m = table.number("block_thickness_mm", 0.5, 50) * kMilli;
  grip.block_stiffness_n_per_m = table.number("block_stiffness_n_per_m", 10, 5000);
  grip.low_n = table.number("low_n", 0, 50);
  grip.high_n = table.number("high_n", 0, 50);
  grip.excess_n = table.number("excess_n", 0, 100);
  grip.hold_s = table.number("hold_s", 0.05, 30);
  if (grip.high_n <= grip.low_n) table.fail("high_n", "'high_n' must be above 'low_n'");
  if (grip.excess_n <= grip.high_n) table.fail("excess_n", "'excess_n' must be above 'high_n'");
  if (grip.high_n / grip.block_stiffness_n_per_m > grip.block_thickness_m)
    table.fail("block_thickness_mm", "the block is too thin to be squeezed with 'high_n'");
  table.finish();
}

void read_touch(StrictTable& document, Exercise& exercise) {
  exercise.counted_hold_s = exercise.hold_s = document.number("hold_s", 0.05, 60);
  exercise.rise_s = document.number_or("rise_s", 0, 10, exercise.rise_s);
  exercise.tissue = document.choice_or("tissue", {kTissueWords.begin(), kTissueWords.end()}, kStillTissue);
  read_surface(document, exercise);
  read_grip(document.table("grip"), exercise.grip);
}

JudgedForces touch_limits(const Exercise& exercise, const ExerciseLevel&, const Board&, int) {
  return {exercise.hard_force_n, exercise.grip.excess_n};
}

/// An organ without discs: to touch as one likes, without an end.
class FreeTask final : public ExerciseTask {
 public:
  void begin(EventLog&) override {}
  void update(const TaskInput&, EventLog&) override {}
  bool finished() const override { return false; }
  std::int32_t object() const override { return -1; }
  void describe(const TaskInput&, DirectorStatus& status) const override {
    status.cue = Cue::kNone;
    status.message.clear();
    status.hint.clear();
  }
};

Board lay_out_touch(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place) {
  return lay_out_discs(place.organ_T, exercise, level, board, place.behind_tip);
}

std::vector<std::unique_ptr<ExerciseTask>> touch_tasks(const Exercise& exercise, const ExerciseLevel& level,
                                                       const Board& board) {
  std::vector<std::unique_ptr<ExerciseTask>> tasks;
  if (board.targets.empty()) {
    tasks.push_back(std::make_unique<FreeTask>());
    return tasks;
  }
  tasks.push_back(std::make_unique<DiscTask>(exercise, level, board.targets));
  tasks.push_back(std::make_unique<SqueezeTask>(exercise.grip, level, static_cast<std::int32_t>(board.targets.size())));
  return tasks;
}

/// The discs, and the block to squeeze.
void account_touch(const Board& board, const std::vector<Event>& events, ScoringContext& context) {
  account_held_targets(board, events, context);
  context.objects_total += 1;
  context.objects_done +=
      std::any_of(events.begin(), events.end(), [](const Event& event) { return event.type == event_type::kGripHeld; })
          ? 1
          : 0;
}

}  // namespace

KindDescription touch_kind() {
  return {.kind = ExerciseKind::kTouch,
          .name = "touch",
          .on_organ = true,
          .oriented = false,
          .jaws_hold = false,
          .tool = ToolKind::kGrasper,
          .watched = WatchedForce::kTip,
          .limits = touch_limits,
          .read_targets = read_discs,
          .read = read_touch,
          .read_level = read_bands,
          .lay_out = lay_out_touch,
          .tasks = touch_tasks,
          .account = account_touch};
}

}  // namespace trocar
