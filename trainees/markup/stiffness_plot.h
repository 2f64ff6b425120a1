// Stiffness of the contacts against time as inline SVG: what they asked of the device, K_max, and what was displayed.
//
// Displayed is what ramp, clamp, passivity control and torque budget left of the asked stiffness: asked times delivered
// over commanded force. Mean of the ticks that touch in every pixel column; nothing is drawn where nothing is touched.
// N/m at the stylus. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "scenarios/scoring/attempt_result.h"

namespace trocar {

/// Means of one pixel column over the ticks that touch.
struct StiffnessColumn {
  int column = 0;
  double asked = 0, k_max = 0, displayed = 0;  ///< N/m
};

/// @param columns > 0. Columns without a touch are left out.
std::vector<StiffnessColumn> stiffness_columns(const Trace& trace, int columns);

/// A whole <svg> element.
std::string stiffness_plot_svg(const Trace& trace);

/// One sentence: what the numbers mean for the attempt. @return empty when the recording does not say.
std::string stiffness_words(const StiffnessReport& stiffness);

}  // namespace trocar
