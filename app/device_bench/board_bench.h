// What the self-test of a back-end needs beyond the seam: a board fresh from its start, and acts that only a bench, or
// the person at it, can do. A bench that cannot do an act says so, and the checks that need it are left out by name.
//
// At the start the arm is in its jig, amplifiers inhibited, codes zero. Thread: the caller's.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "haptics/device/data_acquisition.h"

namespace trocar {

/// What happens to the board while it is under test; times from its first SYNC.
struct BoardActs {
  std::optional<std::int32_t> counters_at;  ///< every counter begins here
  std::optional<double> stop_pressed_s;     ///< emergency stop, for good
  std::optional<double> switch_opened_s;    ///< enabling switch, for good
  bool held = false;                        ///< a hand holds the stylus and presses the enabling switch
};

class BoardBench {
 public:
  virtual ~BoardBench() = default;
  /// A board at its start, to which the acts will happen; nullptr: this bench cannot do them. @throws EnvironmentError.
  virtual std::unique_ptr<DataAcquisition> open(const BoardActs& acts) = 0;
  /// Whether two boards treated alike give the same counts to the bit.
  virtual bool repeatable() const = 0;
};

}  // namespace trocar
