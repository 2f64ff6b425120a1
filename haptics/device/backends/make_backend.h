// The one place that knows which back-ends there are: a name and options in, a back-end out.
//
// Thread: any; a back-end is made before its run begins.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "haptics/device/backend.h"
#include "haptics/device/device_model.h"
#include "haptics/device/simulated_daq.h"
#include "haptics/force_sensor/ati/wrench_stream.h"

namespace trocar {

inline constexpr const char* kSimulatedBackend = "simulated";
inline constexpr const char* kPointerBackend = "pointer";  ///< no device: mouse, keys, pad, SpaceMouse

/// A Mesa card on the network; and one that is not there, on the loopback, with the simulated device behind it: the
/// same driver to the last byte.
inline constexpr const char *kHostmot2Backend = "hostmot2", *kFakeHostmot2Backend = "hostmot2-fake";

/// The two boards of the thesis by their registers; and two that are not there, likewise.
inline constexpr const char *kMc4000Backend = "mc4000", *kEmulatedMc4000Backend = "mc4000-emulated";

struct BackendOptions {
  SimulatedDaqConfig simulated = {};  ///< of "simulated"; its rate holds for every back-end
  ForceSensorConfig sensor = {};
  std::uint64_t sensor_seed = 1;  ///< of a simulated sensor's noise and drift
  /// Of "hostmot2": the card's address. Of "mc4000": folders of the two boards in PCI's sysfs, or their /dev/uio, with
  /// a comma. Empty: the address as delivered.
  std::string card = {};
  /// A real force sensor in place of the back-end's: "net-ft:192.168.1.1", "serial:/dev/ttyUSB0" (lines of text),
  /// "serial-binary:/dev/ttyUSB0". Empty: the back-end's.
  std::string force_sensor = {};
  std::optional<SensorMount> sensor_mount = {};  ///< of the real one
};

/// Names that make_backend() knows.
std::vector<std::string> backend_names();
/// What build_scene() needs to know before the back-end is there. @throws InputError listing the names.
DaqCapabilities backend_capabilities(const std::string& name, double rate_hz);
/// @throws InputError listing the names.
BackendAbilities backend_abilities(const std::string& name);
/// Whether a person holds a real device there: no world is simulated behind it. @throws InputError listing the names.
bool is_real_device(const std::string& name);
/// @throws InputError listing the names; std::invalid_argument when an option is out of range.
Backend make_backend(const std::string& name, const BackendOptions& options);
/// @param words as BackendOptions::force_sensor. @param mount how many counts a newton has, if it says; a Net F/T box
/// is asked, and says what is left open. @throws InputError: another word; as NetFt, net_ft_counts(), AtiSerial.
std::unique_ptr<WrenchStream> make_force_sensor(const std::string& words, const std::optional<SensorMount>& mount = {});
/// Plays a recording back: no sensor, no world. @param samples at least one. @param recorded on what it was recorded.
Backend replay_backend(std::vector<DaqSample> samples, const DaqCapabilities& recorded);

}  // namespace trocar
