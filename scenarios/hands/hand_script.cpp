#include "scenarios/hands/hand_script.h"

#include <algorithm>
#include <cmath>

#include "haptics/input_error.h"
#include "scenarios/files/file_units.h"
#include "scenarios/files/strict_toml.h"

namespace trocar {
namespace {

constexpr double kScriptMilli = file_units::kMilli;

HandSkill read_skill(StrictTable table) {
  HandSkill skill;
  skill.speed_factor = table.number("speed_factor", 0.1, 20);
  skill.aim_lateral_m = table.number("aim_lateral_mm", 0, 50) * kScriptMilli;
  skill.aim_depth_m = table.number("aim_depth_mm", 0, 50) * kScriptMilli;
  skill.aim_angle_rad = table.number("aim_angle_deg", 0, 90) * M_PI / 180;
  skill.settle_share = table.number("settle_share", 0.05, 1);
  skill.tremor_m = table.number("tremor_mm", 0, 5) * kScriptMilli;
  skill.pause_s = table.number("pause_s", 0, 10);
  skill.force_bias = table.number("force_bias", 0, 10);
  skill.force_cv = table.number("force_cv", 0, 2);
  skill.path_bulge = table.number("path_bulge", 0, 1);
  skill.max_corrections = table.integer("max_corrections", 0, 20);
  skill.hover_m = table.number("hover_mm", 0, 30) * kScriptMilli;
  skill.approach_speed_mps = table.number("approach_speed_mm_per_s", 1, 500) * kScriptMilli;
  skill.reaction_s = table.number_or("reaction_s", 0.05, 2, skill.reaction_s);
  skill.population_cv = table.number_or("population_cv", 0, 1, 0);
  table.finish();
  return skill;
}

ScriptedMove read_move(StrictTable table) {
  ScriptedMove move;
  if (table.has("about_mm"))
    move.about_m = table.vector("about_mm", -1000, 1000) * kScriptMilli;
  else
    move.to_m = table.vector("to_mm", -1000, 1000) * kScriptMilli;
  table.allow("about_mm");
  move.roll_rad = table.number_or("roll_deg", -360, 360, 0) * file_units::kDegrees;
  move.relative_to_ready = table.choice_or("from", {"theatre", "ready"}, "theatre") == "ready";
  move.seconds = table.number("seconds", 0.01, 600);
  move.hold_s = table.number_or("hold_s", 0, 3600, 0);
  move.jaw_m = table.number_or("jaw_mm", -20, 60, 20) * kScriptMilli;
  move.clutch = table.flag_or("clutch", false);
  move.pedal = table.flag_or("pedal", false);
  std::vector<std::string> known;
  for (const InstrumentDescription& instrument : kInstruments) known.emplace_back(instrument.name);
  if (table.has("instrument")) move.instrument = instrument_named(table.choice("instrument", known));
  table.allow("instrument");
  table.finish();
  return move;
}

}  // namespace

HandScript parse_hand_script(const std::string& text, const std::string& file) {
  StrictTable document = StrictTable::parse(text, file);
  HandScript script;
  script.name = document.text("name");
  const std::string kind = document.choice("kind", {"skilled", "waypoints", "learner", "population", "cheat", "idle"});
  if (kind == "skilled") {
    script.kind = HandKind::kSkilled;
    script.skill = read_skill(document.table("skill"));
  } else if (kind == "waypoints") {
    script.kind = HandKind::kWaypoints;
    for (const StrictTable& move : document.tables("move")) script.moves.push_back(read_move(move));
  }
  if (kind == "learner") {
    script.kind = HandKind::kLearner;
    StrictTable learning = document.table("learning");
    script.learning = {learning.text("from"), learning.text("to"), learning.number("attempts", 0.1, 1000)};
    learning.finish();
  }
  if (kind == "population") {
    script.kind = HandKind::kPopulation;
    StrictTable population = document.table("population");
    script.population = {population.text("from"), population.text("to"), population.number("spread_cv", 0, 1)};
    population.finish();
  }
  if (kind == "cheat") {
    script.kind = HandKind::kCheat;
    StrictTable cheat = document.table("cheat");
    const bool clutch = cheat.choice("trick", {"clutch", "dwell"}) == "clutch";
    script.cheat = {clutch ? Cheat::Trick::kClutch : Cheat::Trick::kDwell, cheat.text("of"),
                    cheat.number("for_s", 0.1, 600)};
    cheat.finish();
  }
  document.finish();
  return script;
}

HandScript load_hand_script(const std::filesystem::path& file) {
  return parse_hand_script(read_text_file(file.string()), file.string());
}

HandSkill learned_skill(const HandSkill& from, const HandSkill& to, double attempts, int attempt) {
  const double left = std::exp(-std::max(0, attempt - 1) / attempts);
  HandSkill skill = to;
  for (double HandSkill::*const number : kSkillNumbers) skill.*number += left * (from.*number - to.*number);
  skill.max_corrections += static_cast<int>(std::lround(left * (from.max_corrections - to.max_corrections)));
  return skill;
}

std::vector<std::string> list_hands(const std::filesystem::path& hands_dir) {
  std::error_code error;
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(hands_dir, error)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  if (error) throw InputError(hands_dir.string() + ": cannot be read as a folder of hands");
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace trocar
