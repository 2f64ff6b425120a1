#include "scenarios/hands/make_hand.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "haptics/input_error.h"
#include "scenarios/files/strict_toml.h"
#include "scenarios/hands/cheating_hand.h"
#include "scenarios/hands/population.h"
#include "scenarios/hands/skilled_hand.h"
#include "scenarios/hands/waypoint_hand.h"

namespace trocar {

std::unique_ptr<Hand> make_hand(const HandScript& script, std::uint64_t seed) {
  if (script.kind == HandKind::kSkilled) return std::make_unique<SkilledHand>(script.skill, seed);
  if (script.kind == HandKind::kLearner || script.kind == HandKind::kPopulation || script.kind == HandKind::kCheat)
    throw InputError("hand '" + script.name + "' is made of others: it must be made by name");
  return std::make_unique<WaypointHand>(script.moves);
}

namespace {

/// What the record calls a person's input, and an invented attempt: no script is ever taken for one.
constexpr std::array<std::string_view, 7> kNoScripts{"auto",       "mouse",  "keyboard", "gamepad",
                                                     "spacemouse", "device", "invented"};

std::filesystem::path hand_file(const std::string& name_or_script, const std::filesystem::path& hands_dir) {
  if (name_or_script.ends_with(".toml")) return name_or_script;
  if (std::find(kNoScripts.begin(), kNoScripts.end(), name_or_script) != kNoScripts.end())
    throw InputError("hand '" + name_or_script +
                     "': is how the record names a person's input, so no script is called so");
  const std::vector<std::string> known = list_hands(hands_dir);
  if (std::find(known.begin(), known.end(), name_or_script) == known.end()) {
    const std::string near = nearest_word(name_or_script, known);
    throw InputError("unknown hand '" + name_or_script + "': known are " + joined(known) +
                     (near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
  // "Mouse" or "mouse " would pass for a person on a page.
  if (name_or_script.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_") != std::string::npos)
    throw InputError("hand '" + name_or_script + "': names are small letters, digits, '-' and '_'");
  return hands_dir / (name_or_script + ".toml");
}

HandSkill skill_of(const std::string& name, const HandScript& made_of, const std::filesystem::path& hands_dir) {
  const HandScript script = load_hand_script(hand_file(name, hands_dir));
  if (script.kind != HandKind::kSkilled)
    throw InputError("hand '" + made_of.name + "': '" + name + "' has no skill of its own");
  return script.skill;
}

constexpr std::uint64_t kPersonStride = 0xd1b54a32d192ed03;  // keeps the chance of persons apart

std::unique_ptr<Hand> make_person(const HandScript& script, const std::string& name, std::uint64_t seed,
                                  const std::filesystem::path& hands_dir) {
  const std::optional<int> person = split_person(name).second;
  if (!person) throw InputError("hand '" + name + "' is a population: name one of it, " + name + "#1");
  const HandSkill skill =
      person_skill(skill_of(script.population.from, script, hands_dir),
                   skill_of(script.population.to, script, hands_dir), script.population.spread_cv, *person);
  return std::make_unique<SkilledHand>(skill, seed + static_cast<std::uint64_t>(*person) * kPersonStride);
}

}  // namespace

std::unique_ptr<Hand> make_hand(const std::string& name_or_script, std::uint64_t seed,
                                const std::filesystem::path& hands_dir, int attempt) {
  const HandScript script = load_hand_script(hand_file(split_person(name_or_script).first, hands_dir));
  if (script.kind == HandKind::kPopulation) return make_person(script, name_or_script, seed, hands_dir);
  if (split_person(name_or_script).second)
    throw InputError("hand '" + name_or_script + "': '" + script.name + "' is no population");
  if (script.kind == HandKind::kCheat)
    return std::make_unique<CheatingHand>(
        std::make_unique<SkilledHand>(skill_of(script.cheat.of, script, hands_dir), seed), script.cheat);
  if (script.kind != HandKind::kLearner) return make_hand(script, seed);
  const Learning& learning = script.learning;
  return std::make_unique<SkilledHand>(
      learned_skill(skill_of(learning.from, script, hands_dir), skill_of(learning.to, script, hands_dir),
                    learning.attempts, attempt),
      seed);
}

std::string hand_bytes(const std::string& name_or_script, const std::filesystem::path& hands_dir) {
  const std::filesystem::path file = hand_file(split_person(name_or_script).first, hands_dir);
  const HandScript script = load_hand_script(file);
  std::string bytes = read_text_file(file.string());
  for (const std::string& other :
       {script.learning.from, script.learning.to, script.population.from, script.population.to, script.cheat.of}) {
    if (!other.empty()) bytes += read_text_file(hand_file(other, hands_dir).string());
  }
  return bytes;
}

}  // namespace trocar
