// The one place that knows which back-ends there are: a name and options in, a back-end out.
//
// Thread: any; a back-end is made before its run begins.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "haptics/device/backend.h"
#include "haptics/device/simulated_daq.h"

namespace trocar {

inline constexpr const char* kSimulatedBackend = "simulated";
inline constexpr const char* kPointerBackend = "pointer";  ///< no device: mouse, keys, pad, SpaceMouse

struct BackendOptions {
  SimulatedDaqConfig simulated = {};  ///< of "simulated"; its rate holds for every back-end
  ForceSensorConfig sensor = {};
  std::uint64_t sensor_seed = 1;  ///< of a simulated sensor's noise and drift
};

/// Names that make_backend() knows.
std::vector<std::string> backend_names();
/// What build_scene() needs to know before the back-end is there. @throws InputError listing the names.
DaqCapabilities backend_capabilities(const std::string& name, double rate_hz);
/// @throws InputError listing the names; std::invalid_argument when an option is out of range.
Backend make_backend(const std::string& name, const BackendOptions& options);
/// Plays a recording back: no sensor, no world. @param samples at least one. @param recorded on what it was recorded.
Backend replay_backend(std::vector<DaqSample> samples, const DaqCapabilities& recorded);

}  // namespace trocar
