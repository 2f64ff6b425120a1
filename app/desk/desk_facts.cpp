#include "app/desk/desk_facts.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/grasp/grasp_layout.h"

namespace trocar {

review::LevelFacts desk_level_facts(const std::string& exercise_text, const std::string& level) {
  const Exercise exercise = parse_exercise(exercise_text, "exercise of the attempt");
  const ExerciseLevel& found = find_level(exercise, level);
  review::LevelFacts facts;
  if (found.bands.size() <= 1) {  // several bands: what is wanted differs from disc to disc
    facts.limits.low_n = found.band_low_n;
    facts.limits.high_n = found.band_high_n;
  }
  facts.limits.hard_n = exercise.hard_force_n;
  if (found.position_tolerance_m > 0) facts.pose = {found.position_tolerance_m, found.angle_tolerance_rad};
  facts.pass_at = found.rubric.pass_at;
  for (const SubscoreRule& rule : found.rubric.subscores)
    facts.less_is_better[rule.metric] = rule.full_at < rule.zero_at;
  return facts;
}

std::vector<GripLimits> desk_grip_limits(const std::string& exercise_text, const std::string& level, int board) {
  const Exercise exercise = parse_exercise(exercise_text, "exercise of the attempt");
  std::vector<GripLimits> limits;
  if (exercise.grasp.kinds.empty()) return limits;
  for (const FoamBlock& block : lay_out_blocks(exercise, find_level(exercise, level), board).rigid.blocks)
    limits.push_back({block.slip_below_n, block.crush_above_n});
  return limits;
}

std::vector<review::ExerciseLevels> desk_exercises(const std::filesystem::path& folder) {
  std::vector<review::ExerciseLevels> out;
  for (const Exercise& exercise : list_exercises(folder)) {
    out.push_back({exercise.id, exercise.title, {}});
    for (const ExerciseLevel& level : exercise.levels) out.back().levels.push_back(level.name);
  }
  return out;
}

std::string shipped_progress_rules(const std::string& assets_folder) {
  std::ifstream file(std::filesystem::path(assets_folder) / "progress.toml", std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return file ? text.str() : "";
}

}  // namespace trocar
