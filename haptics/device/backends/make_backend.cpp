#include "haptics/device/backends/make_backend.h"

#include "haptics/device/hostmot2/fake_hostmot2.h"
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

Hostmot2Options hostmot2_options(const BackendOptions& options) {
  Hostmot2Options out;
  out.card = options.card;
  out.rate_hz = options.simulated.rate_hz;
  out.watchdog_s = options.simulated.watchdog_s;
  return out;
}

Backend hostmot2_backend(const BackendOptions& options) {
  return {.daq = std::make_unique<Hostmot2Daq>(hostmot2_options(options))};
}

/// A card that is not there and its driver, for as long as the driver is there.
class FakeCardDaq final : public DataAcquisition {
 public:
  FakeCardDaq(const SimulatedDaqConfig& device, Hostmot2Options options)
      : device_(FakeHostmot2::device_config(device)), card_(device_, device.faults, options.wiring), driver_([&] {
          options.card = card_.address();
          return options;
        }()) {}
  DaqCapabilities capabilities() const noexcept override { return driver_.capabilities(); }
  DaqSample read() noexcept override { return driver_.read(); }
  void write(const DacFrame& frame) noexcept override { driver_.write(frame); }
  /// What disarms is sent without a question: it has acted before anybody looks, so that runs repeat to the bit.
  void arm(bool enabled) noexcept override {
    driver_.arm(enabled);
    if (!enabled) card_.settle(driver_.link().sent);
  }
  SimulatedWorld* world() { return &card_; }

 private:
  SimulatedDaq device_;
  FakeHostmot2 card_;
  Hostmot2Daq driver_;
};

Backend fake_hostmot2_backend(const BackendOptions& options) {
  constexpr double kPatience_s = 10;  // nothing is lost there: a busy machine may be late
  Hostmot2Options own = hostmot2_options(options);
  own.name = kFakeHostmot2Backend;
  own.wait_share = kPatience_s * own.rate_hz;
  own.wiring.inputs.push_back({kHandFault, 69, false});  // that a real hand does not have
  auto daq = std::make_unique<FakeCardDaq>(options.simulated, own);
  SimulatedWorld* world = daq->world();
  return {.daq = std::move(daq),
          .sensor = std::make_unique<SimulatedForceSensor>(options.sensor, options.sensor_seed),
          .world = world};
}

constexpr BackendKind kBackends[] = {
    {kSimulatedBackend, 16, true, {.pause = true, .pace = true}, simulated_backend},
    {kPointerBackend, 16, false, {.pause = true, .pace = true}, pointer_backend},
    {kHostmot2Backend, hostmot2::kPdmBits + 1, true, {}, hostmot2_backend},
    {kFakeHostmot2Backend, hostmot2::kPdmBits + 1, true, {.pause = true, .pace = true}, fake_hostmot2_backend}};

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
