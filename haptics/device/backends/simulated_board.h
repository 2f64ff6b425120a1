// A board or card with the simulated device behind it, by the name of its back-end, and what can be done to it: for the
// factory, and for benches and tests, which must look behind the seam and put troubles in.
//
// Thread: the seam's calls the haptic task's; device() only while hold() is held.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "haptics/device/hostmot2/fake_hostmot2.h"
#include "haptics/device/mc4000/emulated_mc4000.h"

namespace trocar {

struct SimulatedBoard {
  std::unique_ptr<DataAcquisition> daq;
  SimulatedWorld* world = nullptr;   ///< part of `daq`, as those below
  SimulatedDaq* device = nullptr;    ///< the device itself
  FakeHostmot2* card = nullptr;      ///< nullptr: another board
  EmulatedMc4000* boards = nullptr;  ///< likewise

  /// The device rests while it is held.
  std::unique_lock<std::mutex> hold() const { return card ? card->hold() : std::unique_lock<std::mutex>(); }
};

/// Names of the back-ends that have one.
std::vector<std::string> simulated_board_names();
/// @param config its rate and watchdog are the board's too. @param answer_s for which an answer of a card is waited
/// for: nothing is lost there unless it is to be, and a busy machine may be late. @throws InputError: another name; as
/// SimulatedDaq and the board's driver.
SimulatedBoard open_simulated_board(const std::string& name, const SimulatedDaqConfig& config, double answer_s = 2);

}  // namespace trocar
