// Forces of a recorded attempt over time, small enough to draw at any width: from the recording's rows, no replay.
//
// Virtual newtons of the scene; loop seconds. 60 s at 1 kHz: 0.7 MB. Thread: any; loading takes some ten milliseconds a
// minute.
#pragma once

#include <filesystem>
#include <vector>

#include "scenarios/scoring/trace.h"

namespace trocar {

struct ForceTrace {
  double begin_s = 0, end_s = 0;                     ///< START to the end; all of it without a START
  std::vector<float> t_s, tip_n, grip_n, speed_mps;  ///< one a tick; speed of the tip over 20 ms

  struct Column {
    double low = 0, high = 0;
    bool any = false;
  };
  /// Lowest and highest value in each of `columns` equal parts of from..to. @param values one of the vectors above.
  std::vector<Column> columns(const std::vector<float>& values, int count, double from_s, double to_s) const;
  /// The value at or before t; 0 without one.
  double at(const std::vector<float>& values, double t_s) const;
};

ForceTrace force_trace(const Trace& trace, const std::vector<Event>& events);
/// @throws InputError: unreadable. What was cut off is shown as far as it goes.
ForceTrace load_force_trace(const std::filesystem::path& recording);

}  // namespace trocar
