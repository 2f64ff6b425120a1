// `trocar device pinch`: two points of the pinch's slide, closed and open, and where the jig holds it; torque zero.
//
// Behind a back-end with a simulated device a simulated hand does what is said, and how far the openings are off the
// truth is measured; a real one is paced by the clock. Thread: one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>

#include "haptics/device/backends/make_backend.h"

namespace trocar {

struct PinchCommand {
  std::string backend = kSimulatedBackend, card = {}, design = "geared";
  double travel_m = 0.030, ratio_m = 0, most_n = 10, limit_s = 60;
  int noise = 0;
  std::uint64_t seed = 1;
  std::filesystem::path plant = {}, out = {};
  bool json = false;
  std::function<bool()> interrupted = {};  ///< besides Ctrl-C and SIGTERM
};

/// @param out what the person is to do, then what was found. @return 0, or 4 when a point was not seen within limit_s:
/// nothing is written then. @throws InputError, EnvironmentError; Interrupted before the last point.
int device_pinch(const PinchCommand& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
