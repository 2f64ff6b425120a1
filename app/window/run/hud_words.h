// The head-up display in the language that was chosen.
//
// Director and display make their sentences in English with the numbers in them, so that neither they nor a recording
// know of languages; here they are found by their form (Translator::made). Thread: the window's.
#pragma once

#include <string>
#include <vector>

#include "app/picture/scene/scene_view.h"
#include "app/window/words/translator.h"

namespace trocar {

Hud in_words(Hud hud, const Translator& words);

/// Every sentence that director and display make, with places for its values: what a catalogue must hold.
const std::vector<std::string>& hud_sentences();

}  // namespace trocar
