#include "scenarios/hands/make_hand.h"

#include <algorithm>

#include "haptics/input_error.h"
#include "scenarios/hands/skilled_hand.h"
#include "scenarios/hands/waypoint_hand.h"
#include "scenarios/strict_toml.h"

namespace trocar {

std::unique_ptr<Hand> make_hand(const HandScript& script, std::uint64_t seed) {
  if (script.kind == HandKind::kSkilled) return std::make_unique<SkilledHand>(script.skill, seed);
  return std::make_unique<WaypointHand>(script.moves);
}

std::unique_ptr<Hand> make_hand(const std::string& name_or_script, std::uint64_t seed,
                                const std::filesystem::path& hands_dir) {
  if (name_or_script.ends_with(".toml")) return make_hand(load_hand_script(name_or_script), seed);
  const std::vector<std::string> known = list_hands(hands_dir);
  if (std::find(known.begin(), known.end(), name_or_script) == known.end()) {
    const std::string near = nearest_word(name_or_script, known);
    throw InputError("unknown hand '" + name_or_script + "': known are " + joined(known) +
                     (near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
  return make_hand(load_hand_script(hands_dir / (name_or_script + ".toml")), seed);
}

}  // namespace trocar
