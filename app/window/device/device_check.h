// The device looked at while a trainee reads the briefing: board, weight left over, friction, passivity, each as it
// comes.
//
//   weight    half the sum of the forces on a hand that goes up and down the same way at the same speed, N
//   friction  half their difference, along the way, N
//   passivity a press into a wall of 150 N/m: what the contact force has given back beyond what it had taken, J
// Found on the simulated device by a hand that is simulated too; the board through the driver of its back-end. Red: no
// exam. A real device has no such hand: its loop's self-test and homing are its check, as each attempt begins.
// Thread: one of its own works, lines() may be asked from any.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "haptics/device/backends/make_backend.h"

namespace trocar {

struct CheckLimits {
  // Twice the most that devices within the tolerances of their documents show: 0.04 to 0.36 N, 0.22 to 0.73 N (seeds 1
  // to 3) [D].
  double weight_n = 0.8, friction_n = 1.6;
  double energy_j =
      1e-3;  ///< given back by the press beyond what it took: less is rounding and the loop's own delay [D]
};

class DeviceCheck {
 public:
  enum class State : std::uint8_t { kWaiting, kRunning, kPassed, kFailed };
  enum class What : std::uint8_t { kBoard, kWeight, kFriction, kPassivity };
  struct Line {
    What what = What::kBoard;
    State state = State::kWaiting;
    double value = 0, limit = 0;  ///< N or J; board: checks that failed, of `count`
    int count = 0;
    std::string detail = {};  ///< of a failure, in English
  };

  /// Begins at once. @param backend a name that make_backend() knows, of one with the simulated device behind it.
  explicit DeviceCheck(const SimulatedDaqConfig& device, const CheckLimits& limits = {},
                       const std::string& backend = kSimulatedBackend);
  /// Gives up what still runs.
  ~DeviceCheck();
  DeviceCheck(const DeviceCheck&) = delete;
  DeviceCheck& operator=(const DeviceCheck&) = delete;

  std::vector<Line> lines() const;
  bool finished() const;
  /// All passed.
  bool sound() const;
  /// @return finished().
  bool wait(double most_s) const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace trocar
