#include "haptics/device/backends/make_backend.h"

#include "haptics/device/hostmot2/fake_hostmot2.h"
#include "haptics/device/hostmot2/hostmot2_daq.h"
#include "haptics/device/mc4000/emulated_mc4000.h"
#include "haptics/device/mc4000/mc4000_daq.h"
#include "haptics/device/mc4000/pci_bus.h"
#include "haptics/device/pointer_daq.h"
#include "haptics/device/replay_daq.h"
#include "haptics/force_sensor/ati/ati_serial.h"
#include "haptics/force_sensor/ati/net_ft.h"
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
  if (!options.card.empty()) out.card = options.card;
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

Mc4000Options mc4000_options(const BackendOptions& options) {
  Mc4000Options out;
  out.rate_hz = options.simulated.rate_hz;
  out.watchdog_s = options.simulated.watchdog_s;
  return out;
}

/// What boards are made of, and their driver, for as long as the driver is there.
template <typename Boards>
class DaqWithBoards final : public DataAcquisition {
 public:
  DaqWithBoards(std::unique_ptr<Boards> boards, RegisterBus& board0, RegisterBus& board1, const Mc4000Options& options)
      : boards_(std::move(boards)), driver_(board0, board1, options) {}
  DaqCapabilities capabilities() const noexcept override { return driver_.capabilities(); }
  bool await_sync() noexcept { return driver_.await_sync(); }
  DaqSample read() noexcept override { return driver_.read(); }
  void write(const DacFrame& frame) noexcept override { driver_.write(frame); }
  void arm(bool enabled) noexcept override { driver_.arm(enabled); }

 private:
  std::unique_ptr<Boards> boards_;
  Mc4000Daq driver_;
};

Backend mc4000_backend(const BackendOptions& options) {
  struct Boards {
    PciBus first, second;
  };
  const std::size_t comma = options.card.find(',');
  if (comma == std::string::npos)
    throw InputError(
        "--card " + options.card +
        ": two boards are expected, with a comma: /sys/bus/pci/devices/0000:03:00.0,/sys/bus/pci/devices/0000:03:01.0");
  const double rate_hz = options.simulated.rate_hz;
  auto boards = std::unique_ptr<Boards>(
      new Boards{PciBus(options.card.substr(0, comma), rate_hz), PciBus(options.card.substr(comma + 1), rate_hz)});
  Boards& b = *boards;
  auto daq = std::make_unique<DaqWithBoards<Boards>>(std::move(boards), b.first, b.second, mc4000_options(options));
  DaqWithBoards<Boards>& driver = *daq;
  return {.daq = std::move(daq), .await_sync = [&driver] { return driver.await_sync(); }};
}

Backend emulated_mc4000_backend(const BackendOptions& options) {
  struct Boards {
    Boards(const SimulatedDaqConfig& config, const Mc4000Options& driver)
        : device(EmulatedMc4000::device_config(config)), pair(device, config.rate_hz, driver.map, driver.inputs) {}
    SimulatedDaq device;
    EmulatedMc4000 pair;
  };
  Mc4000Options own = mc4000_options(options);
  own.name = kEmulatedMc4000Backend;
  own.inputs.push_back({kHandFault, 1, 31, false});  // that a real hand does not have
  auto boards = std::make_unique<Boards>(options.simulated, own);
  Boards& b = *boards;
  return {.daq = std::make_unique<DaqWithBoards<Boards>>(std::move(boards), b.pair.board(0), b.pair.board(1), own),
          .sensor = std::make_unique<SimulatedForceSensor>(options.sensor, options.sensor_seed),
          .world = &b.device};
}

constexpr BackendKind kBackends[] = {
    {kSimulatedBackend, 16, true, {.pause = true, .pace = true}, simulated_backend},
    {kPointerBackend, 16, false, {.pause = true, .pace = true}, pointer_backend},
    {kHostmot2Backend, hostmot2::kPdmBits + 1, true, {}, hostmot2_backend},
    {kFakeHostmot2Backend, hostmot2::kPdmBits + 1, true, {.pause = true, .pace = true}, fake_hostmot2_backend},
    {kMc4000Backend, Mc4000Map{}.dac_bits, true, {}, mc4000_backend},
    {kEmulatedMc4000Backend, Mc4000Map{}.dac_bits, true, {.pause = true, .pace = true}, emulated_mc4000_backend}};

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

BackendAbilities backend_abilities(const std::string& name) { return backend_kind(name).can; }

Backend make_backend(const std::string& name, const BackendOptions& options) {
  const BackendKind& kind = backend_kind(name);
  Backend backend = kind.make(options);
  backend.can = kind.can;
  if (!options.force_sensor.empty()) backend.sensor = make_force_sensor(options.force_sensor);
  return backend;
}

std::unique_ptr<WrenchStream> make_force_sensor(const std::string& words) {
  const std::size_t colon = words.find(':');
  const std::string kind = words.substr(0, colon), where = colon == std::string::npos ? "" : words.substr(colon + 1);
  if (kind == "net-ft" && !where.empty()) return std::make_unique<NetFt>(where, WrenchStreamOptions{});
  if (kind == "serial" && !where.empty()) return std::make_unique<AtiSerial>(where, nano25_options());
  throw InputError("--sensor " + words + ": net-ft:ADDRESS or serial:DEVICE is expected");
}

Backend replay_backend(std::vector<DaqSample> samples, const DaqCapabilities& recorded) {
  return {.daq = std::make_unique<ReplayDaq>(std::move(samples), recorded), .can = {.pause = true, .pace = true}};
}

}  // namespace trocar
