#include "scenarios/hands/make_hand.h"

#include <algorithm>

#include "haptics/input_error.h"
#include "scenarios/files/strict_toml.h"
#include "scenarios/hands/skilled_hand.h"
#include "scenarios/hands/waypoint_hand.h"

namespace trocar {

std::unique_ptr<Hand> make_hand(const HandScript& script, std::uint64_t seed) {
  if (script.kind == HandKind::kSkilled) return std::make_unique<SkilledHand>(script.skill, seed);
  if (script.kind == HandKind::kLearner)
    throw InputError("hand '" + script.name + "' learns from others: it must be made by name");
  return std::make_unique<WaypointHand>(script.moves);
}

namespace {

std::filesystem::path hand_file(const std::string& name_or_script, const std::filesystem::path& hands_dir) {
  if (name_or_script.ends_with(".toml")) return name_or_script;
  const std::vector<std::string> known = list_hands(hands_dir);
  if (std::find(known.begin(), known.end(), name_or_script) == known.end()) {
    const std::string near = nearest_word(name_or_script, known);
    throw InputError("unknown hand '" + name_or_script + "': known are " + joined(known) +
                     (near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
  return hands_dir / (name_or_script + ".toml");
}

HandSkill skill_of(const std::string& name, const HandScript& learner, const std::filesystem::path& hands_dir) {
  const HandScript script = load_hand_script(hand_file(name, hands_dir));
  if (script.kind != HandKind::kSkilled)
    throw InputError("hand '" + learner.name + "': '" + name + "' has no skill to learn from");
  return script.skill;
}

}  // namespace

std::unique_ptr<Hand> make_hand(const std::string& name_or_script, std::uint64_t seed,
                                const std::filesystem::path& hands_dir, int attempt) {
  const HandScript script = load_hand_script(hand_file(name_or_script, hands_dir));
  if (script.kind != HandKind::kLearner) return make_hand(script, seed);
  const Learning& learning = script.learning;
  return std::make_unique<SkilledHand>(
      learned_skill(skill_of(learning.from, script, hands_dir), skill_of(learning.to, script, hands_dir),
                    learning.attempts, attempt),
      seed);
}

}  // namespace trocar
