#include "scenarios/files/exercise_loader.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "scenarios/director/director.h"
#include "scenarios/files/duct_reader.h"
#include "scenarios/files/file_units.h"
#include "scenarios/files/level_reader.h"
#include "scenarios/files/strict_toml.h"
#include "scenarios/kinds/kind.h"

namespace trocar {
namespace {

using file_units::kMilli;

constexpr int kMostTargets = static_cast<int>(decltype(DirectorStatus::done)().size());

void read_start(StrictTable table, Exercise& exercise) {
  exercise.start_sphere_m = table.number("radius_mm", 1, 50) * kMilli;
  exercise.start_hold_s = table.number("hold_s", 0, 10);
  exercise.start_above_m = table.vector("above_mm", -200, 200) * kMilli;
  table.finish();
}

void read_targets(StrictTable table, Exercise& exercise) {
  TargetLayout& layout = exercise.layout;
  layout.count = table.integer("count", kind_of(exercise).on_organ ? 0 : 1, kMostTargets);  // 0: nothing is asked
  const auto [x, y] = table.pair("region_mm", 10, 500);
  layout.region_x_m = x * kMilli;
  layout.region_y_m = y * kMilli;
  layout.relief_m = table.number("relief_mm", 0, 200) * kMilli;
  layout.min_spacing_m = table.number("min_spacing_mm", 0, 200) * kMilli;
  exercise.retract_height_m = table.number("retract_mm", 0, 100) * kMilli;
  kind_of(exercise).read_targets(table, layout);
  table.finish();
}

void read_force(StrictTable table, Exercise& exercise) {
  exercise.soft_force_n = table.number("soft_n", 0.01, 100);
  exercise.hard_force_n = table.number("hard_n", 0.01, 100);
  exercise.critical_force_n = table.number("critical_n", 0.01, 100);
  if (exercise.hard_force_n < exercise.soft_force_n) table.fail("hard_n", "'hard_n' must not be below 'soft_n'");
  if (exercise.critical_force_n <= exercise.hard_force_n)
    table.fail("critical_n", "'critical_n' must be above 'hard_n'");
  table.finish();
}

ExerciseKind read_kind(StrictTable& document) {
  std::vector<std::string> names;
  for (const KindDescription& kind : all_kinds()) names.emplace_back(kind.name);
  return kind_named(document.choice("kind", names))->kind;
}

/// Older files say `jaws`: whether it is a grasper.
std::vector<InstrumentKind> read_instruments(StrictTable& document, const Exercise& exercise) {
  const bool grasper = document.flag_or("jaws", kind_of(exercise).jaws_hold);
  if (!document.has("instruments")) {
    document.allow("instruments");
    return {grasper ? InstrumentKind::kGrasper : InstrumentKind::kProbe};
  }
  if (document.has("jaws")) document.fail("jaws", "'jaws' must not stand beside 'instruments'");
  std::vector<std::string> known;
  for (const InstrumentDescription& instrument : kInstruments) known.emplace_back(instrument.name);
  std::vector<InstrumentKind> instruments;
  for (const std::string& name : document.choices("instruments", known, kMostInstruments))
    instruments.push_back(*instrument_named(name));
  return instruments;
}

/// Files without the table: all lies still.
Breathing read_breathing(StrictTable& document) {
  Breathing breathing;
  if (!document.has("breathing")) {
    document.allow("breathing");
    return breathing;
  }
  StrictTable table = document.table("breathing");
  breathing.per_min = table.number("per_min", 1, 60);
  breathing.depth_m = table.number("depth_mm", 0, 20) * kMilli;
  breathing.beats_per_min = table.number_or("beats_per_min", 0, 200, 0);
  breathing.beat_m = table.number_or("beat_mm", 0, 3, 0) * kMilli;
  table.finish();
  return breathing;
}

std::vector<FormerRubric> read_former_rubrics(StrictTable& document) {
  document.allow("former_rubrics");
  if (!document.has("former_rubrics")) return {};
  std::vector<FormerRubric> out;
  for (StrictTable& table : document.tables("former_rubrics")) {
    FormerRubric former{table.text("sha256"), table.text("until")};
    if (former.sha256.size() != 64 || former.sha256.find_first_not_of("0123456789abcdef") != std::string::npos)
      table.fail("sha256", "'sha256' must be 64 small hexadecimal digits");
    int year = 0, month = 0, day = 0, read = 0;
    if (former.until.size() != 10 ||
        std::sscanf(former.until.c_str(), "%4d-%2d-%2d%n", &year, &month, &day, &read) != 3 || read != 10)
      table.fail("until", "'until' must be a date, \"2026-11-26\"");
    table.finish();
    out.push_back(former);
  }
  return out;
}

}  // namespace

Exercise read_stage(StrictTable& table, const Exercise& operation, const std::vector<std::string>& kinds) {
  Exercise stage = operation;
  stage.is_stage = true;
  stage.stages.clear();
  stage.kind = kind_named(table.choice("kind", kinds))->kind;
  read_targets(table.table("targets"), stage);
  table.allow("force");
  if (table.has("force")) read_force(table.table("force"), stage);
  stage.ducts = read_ducts(table);
  kind_of(stage).read(table, stage);
  return stage;
}

Exercise parse_exercise(const std::string& text, const std::filesystem::path& file) {
  StrictTable document = StrictTable::parse(text, file.string());
  Exercise exercise;
  exercise.file = file;
  exercise.text = text;
  exercise.id = document.text("id");
  exercise.number = document.text("number");
  exercise.version = document.text("version");
  exercise.former_rubrics = read_former_rubrics(document);
  exercise.title = document.text("title");
  exercise.goal = document.text("goal");
  exercise.kind = read_kind(document);
  exercise.instruments = read_instruments(document, exercise);
  exercise.time_limit_s = document.number("time_limit_s", 1, 3600);
  read_start(document.table("start"), exercise);
  read_targets(document.table("targets"), exercise);
  read_force(document.table("force"), exercise);
  exercise.ducts = read_ducts(document);
  kind_of(exercise).read(document, exercise);
  exercise.sheets = read_sheets(document);
  exercise.breathing = read_breathing(document);
  exercise.bed = read_bed(document);
  exercise.lie = read_lie(document);
  exercise.suture = read_suture(document, exercise.instruments);
  read_levels(document, exercise);
  for (ExerciseLevel& level : exercise.levels) {
    level.rubric = read_rubric(document.table("rubric"), exercise, level);
    level.rubric.sha256 = digest::of_bytes(text);
    ExerciseLevel by_pointer = level;
    if (level.pointer.expert_time_s > 0) by_pointer.expert_time_s = level.pointer.expert_time_s;
    level.pointer.rubric = read_rubric(document.table("rubric"), exercise, by_pointer);
    level.pointer.rubric.sha256 = level.rubric.sha256;
  }
  exercise.rubric = exercise.levels.front().rubric;
  document.finish();
  return exercise;
}

Exercise load_exercise(const std::filesystem::path& file) {
  return parse_exercise(read_text_file(file.string()), file);
}

std::vector<Exercise> list_exercises(const std::filesystem::path& exercises_dir) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(exercises_dir, error)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  if (error) throw InputError(exercises_dir.string() + ": cannot be read as a folder of exercises");
  std::sort(files.begin(), files.end());
  std::vector<Exercise> exercises;
  for (const auto& file : files) exercises.push_back(load_exercise(file));
  std::stable_sort(exercises.begin(), exercises.end(),
                   [](const Exercise& a, const Exercise& b) { return a.number < b.number; });
  return exercises;
}

namespace {

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

bool is_named(const Exercise& exercise, const std::string& word) {
  const std::string asked = lower_case(word), number = lower_case(exercise.number);
  if (asked == lower_case(exercise.id) || asked == number) return true;
  const bool digits = !asked.empty() && asked.size() < 9 && asked.find_first_not_of("0123456789") == std::string::npos;
  const std::size_t from = number.find_first_of("0123456789");
  return digits && from != std::string::npos && std::atoi(asked.c_str()) == std::atoi(number.c_str() + from);
}

Exercise find_exercise(const std::string& id_or_path, const std::filesystem::path& exercises_dir) {
  if (id_or_path.ends_with(".toml")) return load_exercise(id_or_path);
  std::vector<std::string> known, listed;
  for (Exercise& exercise : list_exercises(exercises_dir)) {
    if (is_named(exercise, id_or_path)) return std::move(exercise);
    known.push_back(exercise.id);
    listed.push_back(exercise.number + " " + exercise.id);
  }
  const std::string near = nearest_word(lower_case(id_or_path), known);
  throw InputError("unknown exercise '" + id_or_path + "': known are " + joined(listed) + ", or a FILE.toml" +
                   (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

const ExerciseLevel& find_level(const Exercise& exercise, const std::string& name) {
  std::vector<std::string> known;
  for (const ExerciseLevel& level : exercise.levels) {
    if (level.name == name) return level;
    known.push_back(level.name);
  }
  throw InputError("exercise '" + exercise.id + "' has no level '" + name + "': known are " + joined(known));
}

}  // namespace trocar
