// What the person at the device must do next to home it, and what is wrong, in words: for the display, the device panel
// and the console.
//
// English; the window translates. Thread: constant texts, any thread.
#pragma once

#include <span>

#include "haptics/exchange/stylus_state.h"

namespace trocar {

struct HomingWords {
  const char *title, *hint;
  bool warning = false;  ///< the hint says what is wrong
};

/// Of a loop that is not active yet. A trouble takes the place of the step's hint.
HomingWords homing_words(LoopState loop, const HomingReport& homing);

/// All that homing_words() can say.
std::span<const HomingWords> all_homing_words();

}  // namespace trocar
