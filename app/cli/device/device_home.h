// `trocar device home`: homes a device and says on the way what its person must do next.
//
// Behind a back-end with a simulated device a simulated person does it, and how far the zero is off the truth is
// measured; a real one is paced by the clock. Torque stays off throughout. Thread: one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "haptics/device/backends/make_backend.h"
#include "haptics/exchange/homing_report.h"

namespace trocar {

struct HomeOptions {
  std::string backend = kSimulatedBackend, card = {};
  std::string method = {};  ///< light, edges or index; empty: as the device file says
  std::uint64_t seed = 1;   ///< of the simulated device and its person
  int repeat = 1;           ///< homed so often, the stylus taken out in between
  double limit_s = 150;     ///< for each
  std::filesystem::path device = {}, plant = {}, learn = {};
  std::vector<std::string> injections = {};
  bool json = false;
  std::function<bool()> interrupted = {};
};

/// One homing.
struct HomeOutcome {
  bool homed = false;
  double seconds = 0;
  HomingReport report;
  std::vector<std::string> steps = {};           ///< what was said, in order
  ChannelVector error = ChannelVector::Zero();   ///< of the zero on the simulated plant, counts
  ChannelVector marks = ChannelVector::Zero();   ///< counts from home, NaN: not seen
  ChannelVector counts = ChannelVector::Zero();  ///< of the encoders at home
  ChannelVector offset = ChannelVector::Zero();  ///< counts by which the arm stood off its home then
  bool torque_free = true;                       ///< no tick armed an amplifier or asked for anything
  std::string fault = {};                        ///< that ended it
};

/// @throws InputError, EnvironmentError.
std::vector<HomeOutcome> home_device(const HomeOptions& options, std::ostream& out);

/// @return 0, or 4 when it was not homed.
int device_home(const HomeOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
