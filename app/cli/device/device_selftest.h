// `trocar device selftest`: the conformance of a back-end behind the seam, with the simulated device behind it.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "haptics/device/backends/make_backend.h"

namespace trocar {

struct SelfTestOptions {
  std::uint64_t seed = 1;  ///< of the simulated device
  double rate_hz = 1000;
  std::vector<std::string> injections;  ///< as RunOptions::injections: to see a check fail
  bool json = false;
  std::string backend = kSimulatedBackend;  ///< with the simulated device behind it
};

/// @return 0, or 4 when a check failed. @throws InputError.
int device_selftest(const SelfTestOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
