#include "haptics/device/backends/make_backend.h"

#include "haptics/device/pointer_daq.h"
#include "haptics/device/replay_daq.h"
#include "haptics/force_sensor/simulated_force_sensor.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

/// One line a back-end.
struct BackendKind {
  const char* name;
  int dac_bits;
  bool motors;
  BackendAbilities can;
  Backend (*make)(const BackendOptions&);
};

Backend simulated_backend(const BackendOptions& options) {
  auto daq = std::make_unique<SimulatedDaq>(options.simulated);
  SimulatedWorld* world = daq.get();
  return {.daq = std::move(daq),
          .sensor = std::make_unique<SimulatedForceSensor>(options.sensor, options.sensor_seed),
          .world = world};
}

Backend pointer_backend(const BackendOptions& options) {
  auto daq = std::make_unique<PointerDaq>(options.simulated.rate_hz);
  SimulatedWorld* world = daq.get();
  return {.daq = std::move(daq), .world = world};
}

constexpr BackendKind kBackends[] = {{kSimulatedBackend, 16, true, {.pause = true, .pace = true}, simulated_backend},
                                     {kPointerBackend, 16, false, {.pause = true, .pace = true}, pointer_backend}};

const BackendKind& backend_kind(const std::string& name) {
  std::string known;
  for (const BackendKind& kind : kBackends) {
    if (kind.name == name) return kind;
    known += (known.empty() ? "" : ", ") + std::string(kind.name);
  }
  throw InputError("--backend " + name + ": unknown; known are " + known);
}

}  // namespace

std::vector<std::string> backend_names() {
  std::vector<std::string> names;
  for (const BackendKind& kind : kBackends) names.emplace_back(kind.name);
  return names;
}

DaqCapabilities backend_capabilities(const std::string& name, double rate_hz) {
  const BackendKind& kind = backend_kind(name);
  return {kind.name, rate_hz, kind.dac_bits, kind.motors};
}

Backend make_backend(const std::string& name, const BackendOptions& options) {
  const BackendKind& kind = backend_kind(name);
  Backend backend = kind.make(options);
  backend.can = kind.can;
  return backend;
}

Backend replay_backend(std::vector<DaqSample> samples, const DaqCapabilities& recorded) {
  return {.daq = std::make_unique<ReplayDaq>(std::move(samples), recorded), .can = {.pause = true, .pace = true}};
}

}  // namespace trocar
