// Groups of bars side by side: measures of a few cases on a few methods.
//
// Bars differ in brightness and pattern, not in hue alone; each carries its value. Thread: any.
#pragma once

#include <string>

#include "app/studies/study.h"

namespace trocar {

/// @param curves x is ignored; each series is one kind of bar, at most three. @param groups a name for each entry.
/// @return a whole <svg> document.
std::string grouped_bars_svg(const StudyCurves& curves, const std::vector<std::string>& groups);

}  // namespace trocar
