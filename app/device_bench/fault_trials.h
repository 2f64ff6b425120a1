// What takes the torque away and how fast: every fault that a back-end can have is put in while the arm is at work, and
// the periods are counted until no motor has current (docs/hazards.md).
//
// The real driver, the real loop, the simulated device behind the board. Ticks run from the SYNC at which the fault
// shows. A fault that the board itself must answer (nobody reaches it any more) is timed by its watchdog. Thread: the
// caller's; simulated time.
#pragma once

#include <string>
#include <vector>

#include "haptics/device/simulated_daq.h"

namespace trocar {

struct FaultTrial {
  std::string fault = {};     ///< stable
  std::string reaction = {};  ///< "hard", "soft", "board", "operator"
  std::string cause = {};     ///< as the loop names it; "none" where that is right: a deadman is no fault
  int channel = -1;
  int seen_ticks = 0;  ///< until the loop leaves ACTIVE
  int off_ticks = 0;   ///< until no motor has current
  int limit_ticks = 0;
  std::string failure = {};  ///< empty: as it should be
};

/// @param backend one of simulated_board_names(). @param device its faults are not asked for. @throws InputError:
/// another back-end; as the board.
std::vector<FaultTrial> try_faults(const std::string& backend, const SimulatedDaqConfig& device);

}  // namespace trocar
