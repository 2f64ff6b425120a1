// What every back-end of the seam owes the loop (haptics/device/data_acquisition.h), found out through the seam alone.
//
// Whether a command acts is told by comparison: two boards are treated alike but for the sign of one command, and what
// differs in their counts is due to it, weight and friction not. The commands last 40 ms at 15 % of full scale but for
// the pinch, whose light slide shows the delay at full scale. Arm clear of obstacles, no hand on it unless a
// bench act says so. Thread: the caller's.
#pragma once

#include <string>
#include <vector>

#include "app/device_bench/board_bench.h"

namespace trocar {

struct BoardCheck {
  enum class Outcome : char { kPassed, kFailed, kLeftOut };
  std::string name;  ///< stable
  Outcome outcome = Outcome::kPassed;
  std::string detail;  ///< what was measured, or why it failed or was left out
};

/// All checks, in order. @throws EnvironmentError of the bench.
std::vector<BoardCheck> check_board(BoardBench& bench);

/// "pass", "FAIL", "left out".
const char* outcome_name(BoardCheck::Outcome outcome);

}  // namespace trocar
