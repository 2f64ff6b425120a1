#include "scenarios/kinds/clip/clip_kind.h"

#include <memory>

#include "scenarios/director/scoring_context.h"
#include "scenarios/files/file_units.h"
#include "scenarios/files/level_keys.h"
#include "scenarios/kinds/clip/clip_layout.h"
#include "scenarios/kinds/clip/clip_rules.h"
#include "scenarios/kinds/clip/clip_task.h"
#include "scenarios/kinds/kind_parts.h"
#include "scenarios/kinds/touch/touch_reader.h"

namespace trocar {
namespace {

using file_units::kDegrees, file_units::kMilli;

constexpr double kLongestPlan = 100;  // mm

std::shared_ptr<const ClipRules> read_rules(StrictTable table) {
  ClipRules rules;
  const Vec3 clips = table.vector("clips_at_mm", 0.1, kLongestPlan);
  for (std::size_t i = 0; i < kClipsEach; ++i) rules.clip_at_m[i] = clips[static_cast<Eigen::Index>(i)] * kMilli;
  rules.cut_at_m = table.number("cut_at_mm", 0.1, kLongestPlan) * kMilli;
  if (!(clips[0] < clips[1] && rules.clip_at_m[1] < rules.cut_at_m && rules.cut_at_m < rules.clip_at_m[2]))
    table.fail("clips_at_mm", "two of 'clips_at_mm' must lie before 'cut_at_mm' and the third beyond it, ascending");
  rules.tips_beyond_m = table.number("tips_beyond_mm", 0, 20) * kMilli;
  std::tie(rules.pull_low_n, rules.pull_high_n) = table.pair("pull_n", 0.05, 10);
  if (rules.pull_high_n <= rules.pull_low_n) table.fail("pull_n", "'pull_n' must be [least, most]");
  rules.touch_s = table.number("touch_s", 0.1, 10);
  rules.clip_gap_m = table.number("clip_gap_mm", 0, 20) * kMilli;
  rules.spared_m = table.number("spared_mm", 0, 20) * kMilli;
  rules.angle_rad = table.number("angle_deg", 1, 90) * kDegrees;
  rules.cut_gap_m = table.number("cut_gap_mm", 0, 20) * kMilli;
  rules.clip_width_m = table.number("clip_width_mm", 0.1, 10) * kMilli;
  rules.blood_ml = table.number("blood_ml", 1, 1000);
  rules.clear_m = table.number("clear_mm", 0, 50) * kMilli;
  rules.turn_rad = table.number("turn_deg", 0, 90) * kDegrees;
  rules.shift_m = table.number("shift_mm", 0, 50) * kMilli;
  table.finish();
  return std::make_shared<const ClipRules>(rules);
}

void read_clip(StrictTable& document, Exercise& exercise) {
  // What stands still cannot be clipped.
  read_giving_tissue(document, exercise);
  read_surface(document, exercise);
  exercise.own = read_rules(document.table("clip"));
}

void read_clip_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level) {
  if (exercise.ducts.size() != 2 * kClipStructures)
    keys.table.fail("name", "the exercise needs four 'ducts': two to be divided and what each of them comes from");
  ClipLevel own = level.own ? own_rules<ClipLevel>(level) : ClipLevel{};
  own.places_shown = keys.table.flag_or("places_shown", own.places_shown);
  level.own = std::make_shared<const ClipLevel>(own);
}

/// What came off is not done. Where a structure was divided, what was left out there is not undone: its clips have been
/// judged.
void account_aims(const Board& board, const std::vector<Event>& events, ScoringContext& context) {
  std::vector<Event> done;
  for (const Event& event : events) {
    if (event.type == event_type::kClipWasted && event.object >= 0)
      std::erase_if(
          done, [&](const Event& held) { return held.type == event_type::kTargetHeld && held.object == event.object; });
    done.push_back(event);
  }
  for (const Event& event : events) {
    if (event.type != event_type::kDivided) continue;
    for (int clip = 0; clip < kClipsEach; ++clip) {
      Event passed = event;
      passed.type = event_type::kTargetHeld.name;
      passed.object = kFirstClipAim + (event.object - kFirstCutAim) * kClipsEach + clip;
      done.push_back(passed);
    }
  }
  account_held_targets(board, done, context);
}

}  // namespace

KindDescription clip_kind() {
  return {.kind = ExerciseKind::kClip,
          .name = "clip",
          .on_organ = true,
          .oriented = true,
          .jaws_hold = false,
          .tool = ToolKind::kGrasper,
          .watched = WatchedForce::kTip,
          .limits = judge_hard_force,
          .read_targets = read_places,
          .read = read_clip,
          .read_level = read_clip_level,
          .lay_out = lay_out_clips,
          .tasks = one_task<ClipTask>,
          .account = account_aims};
}

}  // namespace trocar
