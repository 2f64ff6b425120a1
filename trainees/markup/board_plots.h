// The report's pictures of the board exercises as inline SVG: pose errors of each pen, and grip force of each block.
//
// Pens: POSITION_ERROR (m), ANGLE_ERROR (rad), TARGET_HELD (s since lit) and TARGET_TIMEOUT events, by object.
// Blocks: grip force from the trace; a carry runs from LIFTED to SET_DOWN, DROP or LOST of the same object. Thread:
// any.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenarios/scoring/trace.h"

namespace trocar {

/// What a pen's hold was like; empty where it was never held.
struct PenOutcome {
  std::optional<double> position_error_m, angle_error_rad, time_s;
  int timeouts = 0;
};

/// Tolerances of the level; zero: the exercise has no pens.
struct PoseLimits {
  double position_m = 0, angle_rad = 0;
};

/// Slip and crush limits of one block, N.
struct GripLimits {
  double slip_n = 0, crush_n = 0;
};

/// One carry of one block.
struct Carry {
  int block = 0;
  double from_s = 0, to_s = 0;  ///< loop time
  double share_in_window = 0;   ///< of its time with slip <= grip <= crush
};

std::vector<PenOutcome> pen_outcomes(const std::vector<Event>& events);
std::vector<Carry> carries(const Trace& trace, const std::vector<Event>& events, const std::vector<GripLimits>& blocks);

/// Whole <svg> elements; text inside is escaped.
std::string pose_plot_svg(const std::vector<Event>& events, const PoseLimits& limits);
std::string grip_plot_svg(const Trace& trace, const std::vector<Event>& events, const std::vector<GripLimits>& blocks);

}  // namespace trocar
