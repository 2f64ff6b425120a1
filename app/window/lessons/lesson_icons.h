// Small drawings of what a hand does in a step: an instrument and what it meets. Shapes of Ui only. Thread: the
// window's.
#pragma once

#include "app/window/lessons/lesson_words.h"
#include "app/window/ui/ui.h"

namespace trocar {

/// @param area square, px of the window.
void paint_step(Ui& ui, StepIcon icon, const Area& area);

}  // namespace trocar
