// `trocar device monitor`: what the device loop reads and says, ten times a second, on any back-end.
//
// Where the device is simulated, a simulated hand takes the stylus out of the jig and leads it round a small circle in
// free air; paced by the clock, ten times a second, or in lockstep as fast as it goes. A real device is only looked at:
// its loop runs at its rate in a thread of its own, the amplifiers stay off, the codes zero, and the enabling switch is
// shown but not heard. Thread: one; a real device's loop its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace trocar {

struct MonitorOptions {
  std::string backend = "simulated", card = {};  ///< as RunOptions
  double seconds = 5;                            ///< of loop time
  std::uint64_t seed = 1;                        ///< of the simulated device and its hand
  double rate_hz = 1000;
  bool lockstep = false;                      ///< not paced by the clock
  std::filesystem::path calibration, device;  ///< as RunOptions
  std::vector<std::string> injections;        ///< as RunOptions
  bool json = false;
  bool terminal = false;              ///< the block of values is drawn over itself; else a line each
  std::function<bool()> interrupted;  ///< asked ten times a second: true ends it
};

/// Ends by itself, or when it is interrupted. Whether `out` is a terminal is for the caller to say.
/// @return 0, or 4 when the loop has faulted. @throws InputError; EnvironmentError: no such device answers.
int monitor(const MonitorOptions& options, std::ostream& out, std::ostream& err);

/// The same on standard output, ended by Ctrl-C.
int device_monitor(const MonitorOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
