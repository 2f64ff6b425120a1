// The curve of a trainee's scores with its pass line, small. Thread: the window's.
#pragma once

#include <vector>

#include "app/window/practice/level_progress.h"
#include "app/window/ui/ui.h"

namespace trocar {

/// Scores of the attempts that have one, at most the last 30.
std::vector<double> scores_oldest_first(const LevelProgress& progress);

/// Dots joined by a line, a passed one full, others open; the pass line dashed with its number. 0 to 100 upwards.
void paint_sparkline(Ui& ui, const Translator& words, const Area& area, const std::vector<double>& scores,
                     double pass_at);

}  // namespace trocar
