#include "scenarios/kinds/operation/operation_kind.h"

#include <algorithm>

#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/files/file_units.h"
#include "scenarios/files/level_keys.h"
#include "scenarios/kinds/kind_parts.h"
#include "scenarios/kinds/operation/stage_task.h"
#include "scenarios/kinds/touch/touch_reader.h"
#include "scenarios/layout/height_field.h"

namespace trocar {
namespace {

using file_units::kMilli;

/// What lies on the organ alone, beside ducts; scenes are made of nothing else for a stage.
const std::vector<std::string> kStageKinds{"retract", "dissect", "clip"};
constexpr double kFarthestStage = 60;  // mm

void read_operation(StrictTable& document, Exercise& exercise) {
  read_giving_tissue(document, exercise);
  read_surface(document, exercise);
  std::vector<std::string> instruments;
  for (const InstrumentKind kind : exercise.instruments) instruments.emplace_back(describe(kind).name);
  int objects = 0;
  for (StrictTable& table : document.tables("stages")) {
    ExerciseStage stage;
    stage.name = table.text("name");
    if (stage.name.empty() || stage.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") != std::string::npos)
      table.fail("name", "'name' of a stage must be small letters: it stands before its metrics");
    for (const ExerciseStage& other : exercise.stages)
      if (other.name == stage.name) table.fail("name", "two stages are called '" + stage.name + "'");
    stage.instrument = *instrument_named(table.choice("instrument", instruments));
    const auto [x, y] = table.pair("at_mm", -kFarthestStage, kFarthestStage);
    stage.at_m = Vec3(x, y, 0) * kMilli;
    Exercise own = read_stage(table, exercise, kStageKinds);
    own.title = table.text("title");
    table.finish();
    objects += own.layout.count;
    for (DuctPlan duct : own.ducts) {
      for (Vec3& point : duct.path_m) point += stage.at_m;
      exercise.ducts.push_back(std::move(duct));
    }
    stage.exercise = std::make_shared<const Exercise>(std::move(own));
    exercise.stages.push_back(std::move(stage));
  }
  if (objects != exercise.layout.count)
    document.fail("targets", "'count' must be " + std::to_string(objects) + ", as the stages' together");
}

/// What a stage has of its operation's level.
void take_common(const ExerciseLevel& level, const ExerciseStage& stage, ExerciseLevel& own) {
  own.name = level.name;
  own.mapping = level.mapping;
  own.port_m = level.port_m - stage.at_m;
  own.instrument_length_m = level.instrument_length_m;
  own.motion_scale = level.motion_scale;
  own.force_scale = level.force_scale;
  own.force_display = level.force_display;
  own.guides = level.guides;
  own.exam = level.exam;
  own.time_limit_s = level.time_limit_s;
}

/// Keys of a kind stand in a table of the level that is called as the stage.
void read_operation_level(LevelKeys& keys, const Exercise& exercise, ExerciseLevel& level) {
  level.stages.resize(exercise.stages.size());
  for (std::size_t i = 0; i < exercise.stages.size(); ++i) {
    const ExerciseStage& stage = exercise.stages[i];
    take_common(level, stage, level.stages[i]);
    keys.table.allow(stage.name);
    StrictTable own =
        keys.table.has(stage.name) ? keys.table.table(stage.name) : StrictTable::parse("", exercise.file.string());
    LevelKeys own_keys{own, keys.derived};
    kind_of(*stage.exercise).read_level(own_keys, *stage.exercise, level.stages[i]);
    own.finish();
  }
}

/// A stage is laid out as if its place were the region's centre.
Board lay_out_stage(const ExerciseStage& stage, const ExerciseLevel& level, int board, const BoardPlace& place) {
  TriangleSurface organ = place.organ_T;
  for (Vec3& vertex : organ.vertices) vertex -= stage.at_m;
  std::vector<Vec3> strands(place.strands_T.begin(), place.strands_T.end());
  for (Vec3& point : strands) point -= stage.at_m;
  const KindDescription& kind = kind_of(*stage.exercise);
  Board own = kind.lay_out(*stage.exercise, level, board, {organ, nullptr, place.R_TI_rest, strands});
  own.centre_T += stage.at_m;
  own.start_T += stage.at_m;
  for (Target& target : own.targets) {
    target.centre_T += stage.at_m;
    if (!kind.oriented) target.R_TI = place.R_TI_rest;
  }
  for (std::vector<Vec3>& path : own.ducts_T)
    for (Vec3& point : path) point += stage.at_m;
  return own;
}

Board lay_out_operation(const Exercise& exercise, const ExerciseLevel& level, int board, const BoardPlace& place) {
  const auto centre = HeightField(place.organ_T).top(0, 0);
  if (!centre) throw InputError("the organ does not lie under the middle of the board region: place it first");
  Board out;
  out.stages.resize(exercise.stages.size());
  // Jaws that have a strand between them hold no organ: what stands on it is laid out before what is taken of it.
  std::vector<Vec3> strands;
  for (const bool stands : {true, false})
    for (std::size_t i = 0; i < exercise.stages.size(); ++i) {
      if (exercise.stages[i].exercise->ducts.empty() == stands) continue;
      BoardPlace stage_place = place;
      stage_place.strands_T = strands;
      out.stages[i] = lay_out_stage(exercise.stages[i], level.stages[i], board, stage_place);
      if (stands)
        for (const std::vector<Vec3>& path : out.stages[i].ducts_T)
          strands.insert(strands.end(), path.begin(), path.end());
    }
  for (const Board& own : out.stages) {
    out.targets.insert(out.targets.end(), own.targets.begin(), own.targets.end());
    out.ducts_T.insert(out.ducts_T.end(), own.ducts_T.begin(), own.ducts_T.end());
  }
  out.centre_T = centre->position;
  out.start_T = centre->position + exercise.start_above_m;
  return out;
}

std::vector<std::unique_ptr<ExerciseTask>> stage_tasks(const Exercise& exercise, const ExerciseLevel& level,
                                                       const Board& board) {
  std::vector<std::unique_ptr<ExerciseTask>> out;
  for (const StageRange& range : stage_ranges(exercise, board)) {
    const auto i = static_cast<std::size_t>(range.stage);
    const Exercise& stage = *exercise.stages[i].exercise;
    auto parts = kind_of(stage).tasks(stage, level.stages[i], board.stages[i]);  // of these kinds one each
    out.push_back(std::make_unique<StageTask>(exercise, range, std::move(parts.front())));
  }
  return out;
}

/// Those of the stage that the object is in; of none: of the first, whose tissue bears most.
JudgedForces stage_limits(const Exercise& exercise, const ExerciseLevel& level, const Board& board, int lit) {
  const std::vector<StageRange> ranges = stage_ranges(exercise, board);
  const StageRange* range = stage_with(ranges, lit);
  const auto i = static_cast<std::size_t>(range ? range->stage : 0);
  const Exercise& stage = *exercise.stages[i].exercise;
  return kind_of(stage).limits(stage, level.stages[i], board.stages[i], range ? lit - range->first_object : -1);
}

}  // namespace

KindDescription operation_kind() {
  return {.kind = ExerciseKind::kOperation,
          .name = "operation",
          .on_organ = true,
          .oriented = true,
          .jaws_hold = false,
          .tool = ToolKind::kGrasper,
          .watched = WatchedForce::kTip,
          .limits = stage_limits,
          .read_targets = read_places,
          .read = read_operation,
          .read_level = read_operation_level,
          .lay_out = lay_out_operation,
          .tasks = stage_tasks,
          .account = [](const Board&, const std::vector<Event>&, ScoringContext&) {}};  // stages account for themselves
}

}  // namespace trocar
