#include "scenarios/files/exercise_loader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "scenarios/director/director.h"
#include "scenarios/files/level_reader.h"
#include "scenarios/files/strict_toml.h"
#include "scenarios/kinds/grasp/grasp_loader.h"

namespace trocar {
namespace {

constexpr double kMilli = 1e-3, kDegrees = M_PI / 180;
constexpr int kMostTargets = static_cast<int>(decltype(DirectorStatus::done)().size());

void read_start(StrictTable table, Exercise& exercise) {
  exercise.start_sphere_m = table.number("radius_mm", 1, 50) * kMilli;
  exercise.start_hold_s = table.number("hold_s", 0, 10);
  exercise.start_above_m = table.vector("above_mm", -200, 200) * kMilli;
  table.finish();
}

void read_discs(StrictTable& table, TargetLayout& layout) {
  layout.radius_m = table.number("diameter_mm", 1, 50) / 2 * kMilli;
  layout.max_slope_rad = table.number("max_slope_deg", 1, 80) * kDegrees;
  layout.wrong_place_m = table.number("wrong_place_mm", 0, 50) * kMilli;
  if (layout.min_spacing_m < 2 * layout.radius_m) table.fail("min_spacing_mm", "'min_spacing_mm' lets discs overlap");
}

void read_targets(StrictTable table, Exercise& exercise) {
  TargetLayout& layout = exercise.layout;
  layout.count = table.integer("count", 1, kMostTargets);
  const auto [x, y] = table.pair("region_mm", 10, 500);
  layout.region_x_m = x * kMilli;
  layout.region_y_m = y * kMilli;
  layout.relief_m = table.number("relief_mm", 0, 200) * kMilli;
  layout.min_spacing_m = table.number("min_spacing_mm", 0, 200) * kMilli;
  exercise.retract_height_m = table.number("retract_mm", 0, 100) * kMilli;
  if (exercise.kind == ExerciseKind::kTouch) read_discs(table, layout);
  table.finish();
}

void read_surface(StrictTable table, Exercise& exercise) {
  exercise.surface.stiffness_n_per_m = table.number("stiffness_n_per_m", 1, 5000);
  exercise.surface.damping_s_per_m = table.number("damping_s_per_m", 0, 50);
  exercise.surface.mu_static = table.number_or("friction_static", 0, 2, 0);
  exercise.surface.mu_dynamic = table.number_or("friction_dynamic", 0, 2, 0);
  if (exercise.surface.mu_dynamic > exercise.surface.mu_static)
    table.fail("friction_dynamic", "'friction_dynamic' must not be above 'friction_static'");
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

void read_pens(StrictTable table, PenRules& pens) {
  pens.shell_radius_m = table.number("shell_radius_mm", 10, 500) * kMilli;
  pens.cap_rad = table.number("cap_deg", 5, 90) * kDegrees;
  pens.tilt_rad = table.number("tilt_deg", 0, 60) * kDegrees;
  pens.roll_rad = table.number("roll_deg", 0, 180) * kDegrees;
  pens.length_m = table.number("length_mm", 5, 200) * kMilli;
  pens.radius_m = table.number("diameter_mm", 0.5, 50) / 2 * kMilli;
  pens.timeout_s = table.number("timeout_s", 1, 600);
  table.finish();
}

void read_kind(StrictTable& document, Exercise& exercise) {
  switch (exercise.kind) {
    case ExerciseKind::kTouch:
      exercise.hold_s = document.number("hold_s", 0.05, 60);
      read_surface(document.table("surface"), exercise);
      read_grip(document.table("grip"), exercise.grip);
      return;
    case ExerciseKind::kReach:
      exercise.hold_s = document.number("hold_s", 0.05, 60);
      read_pens(document.table("pens"), exercise.pens);
      if (exercise.pens.timeout_s <= exercise.hold_s)
        document.fail("hold_s", "'hold_s' must be below 'timeout_s' of the pens");
      return;
    case ExerciseKind::kGrasp:
      return read_grasp(document, exercise);
  }
}

ExerciseKind kind_of(const std::string& word) {
  if (word == "grasp") return ExerciseKind::kGrasp;
  return word == "reach" ? ExerciseKind::kReach : ExerciseKind::kTouch;
}

}  // namespace

Exercise parse_exercise(const std::string& text, const std::filesystem::path& file) {
  StrictTable document = StrictTable::parse(text, file.string());
  Exercise exercise;
  exercise.file = file;
  exercise.text = text;
  exercise.id = document.text("id");
  exercise.number = document.text("number");
  exercise.version = document.text("version");
  exercise.title = document.text("title");
  exercise.goal = document.text("goal");
  // The first files had no kind: they stand in old recordings.
  exercise.kind = kind_of(document.choice_or("kind", {"reach", "touch", "grasp"}, "touch"));
  exercise.time_limit_s = document.number("time_limit_s", 1, 3600);
  read_start(document.table("start"), exercise);
  read_targets(document.table("targets"), exercise);
  read_force(document.table("force"), exercise);
  read_kind(document, exercise);
  read_levels(document, exercise);
  for (ExerciseLevel& level : exercise.levels) {
    level.rubric = read_rubric(document.table("rubric"), level);
    level.rubric.sha256 = digest::of_bytes(text);
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
