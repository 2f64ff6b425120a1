#include "scenarios/director/homing_words.h"

#include <array>

namespace trocar {
namespace {

enum Place : std::uint8_t { kWaiting, kSwitch, kSteps };  // then steps, then troubles
constexpr int kFirstStep = static_cast<int>(HomingStep::kMarks), kLastStep = static_cast<int>(HomingStep::kStill);
constexpr std::size_t kTroubles = kSteps + kLastStep - kFirstStep + 1;

constexpr std::array kWords{
    HomingWords{"Waiting for the device", "It starts when homing is complete."},
    HomingWords{"The device is homed", "Take the stylus and close the deadman."},
    HomingWords{"Move each joint slowly", "Until its mark has been seen; then into the jig."},
    HomingWords{"Put the stylus into its jig", "Turn it until the light of the jig is on."},
    HomingWords{"Turn the stylus in its jig", "Slowly through the light, once from either side."},
    HomingWords{"Leave the stylus in its jig", "Nothing may move for half a second."},
    HomingWords{"", "It was moved. Leave it alone.", true},
    HomingWords{"", "No light: turn the stylus, look at the light's wires.", true},
    HomingWords{"", "Always light: shade the receiver, look at its wires.", true},
    HomingWords{"", "It sits wrong in the jig: put it in once more.", true},
    HomingWords{"", "A joint does not count: look at its encoder.", true},
    HomingWords{"", "Not homed for long: begin anew, or call for help.", true},
};
static_assert(kWords.size() == kTroubles + static_cast<std::size_t>(HomingTrouble::kTimeout));

}  // namespace

std::span<const HomingWords> all_homing_words() { return kWords; }

HomingWords homing_words(LoopState loop, const HomingReport& homing) {
  if (loop == LoopState::kHomed) return kWords[kSwitch];
  const int step = static_cast<int>(homing.step);
  if (loop != LoopState::kUnhomed || step < kFirstStep || step > kLastStep) return kWords[kWaiting];
  HomingWords words = kWords[static_cast<std::size_t>(kSteps + step - kFirstStep)];
  if (homing.trouble == HomingTrouble::kNone) return words;
  words.hint = kWords[kTroubles + static_cast<std::size_t>(homing.trouble) - 1].hint;
  words.warning = true;
  return words;
}

}  // namespace trocar
