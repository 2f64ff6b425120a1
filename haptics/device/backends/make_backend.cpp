#include "haptics/device/backends/make_backend.h"

#include <cmath>

#include "haptics/device/backends/simulated_board.h"
#include "haptics/device/hostmot2/hostmot2_daq.h"
#include "haptics/device/mc4000/mc4000_daq.h"
#include "haptics/device/mc4000/pci_bus.h"
#include "haptics/device/pointer_daq.h"
#include "haptics/device/replay_daq.h"
#include "haptics/force_sensor/ati/ati_serial.h"
#include "haptics/force_sensor/ati/net_ft.h"
#include "haptics/force_sensor/ati/net_ft_counts.h"
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

/// A board of that name with the simulated device behind it, and its sensor.
template <const char* const& kName>
Backend simulated_backend(const BackendOptions& options) {
  SimulatedBoard board = open_simulated_board(kName, options.simulated);
  return {.daq = std::move(board.daq),
          .sensor = std::make_unique<SimulatedForceSensor>(options.sensor, options.sensor_seed),
          .world = board.world};
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

Mc4000Options mc4000_options(const BackendOptions& options) {
  Mc4000Options out;
  out.rate_hz = options.simulated.rate_hz;
  out.watchdog_s = options.simulated.watchdog_s;
  return out;
}

/// Two boards on the bus and their driver, for as long as the driver is there.
class PciBoardsDaq final : public DataAcquisition {
 public:
  PciBoardsDaq(const std::string& first, const std::string& second, const Mc4000Options& options)
      : first_(first, options.rate_hz), second_(second, options.rate_hz), driver_(first_, second_, options) {}
  DaqCapabilities capabilities() const noexcept override { return driver_.capabilities(); }
  bool await_sync() noexcept { return driver_.await_sync(); }
  DaqSample read() noexcept override { return driver_.read(); }
  void write(const DacFrame& frame) noexcept override { driver_.write(frame); }
  void arm(bool enabled) noexcept override { driver_.arm(enabled); }

 private:
  PciBus first_, second_;
  Mc4000Daq driver_;
};

Backend mc4000_backend(const BackendOptions& options) {
  const std::size_t comma = options.card.find(',');
  if (comma == std::string::npos)
    throw InputError(
        "--card " + options.card +
        ": two boards are expected, with a comma: /sys/bus/pci/devices/0000:03:00.0,/sys/bus/pci/devices/0000:03:01.0");
  auto daq = std::make_unique<PciBoardsDaq>(options.card.substr(0, comma), options.card.substr(comma + 1),
                                            mc4000_options(options));
  PciBoardsDaq& driver = *daq;
  return {.daq = std::move(daq), .await_sync = [&driver] { return driver.await_sync(); }};
}

constexpr BackendKind kBackends[] = {
    {kSimulatedBackend, 16, true, {.pause = true, .pace = true, .index = true}, simulated_backend<kSimulatedBackend>},
    {kPointerBackend, 16, false, {.pause = true, .pace = true}, pointer_backend},
    {kHostmot2Backend, hostmot2::kPdmBits + 1, true, {.index = true}, hostmot2_backend},
    {kFakeHostmot2Backend,
     hostmot2::kPdmBits + 1,
     true,
     {.pause = true, .pace = true, .index = true},
     simulated_backend<kFakeHostmot2Backend>},
    {kMc4000Backend, Mc4000Map{}.dac_bits, true, {}, mc4000_backend},
    {kEmulatedMc4000Backend,
     Mc4000Map{}.dac_bits,
     true,
     {.pause = true, .pace = true},
     simulated_backend<kEmulatedMc4000Backend>}};

const BackendKind& backend_kind(const std::string& name) {
  std::string known;
  for (const BackendKind& kind : kBackends) {
    if (kind.name == name) return kind;
    known += (known.empty() ? "" : ", ") + std::string(kind.name);
  }
  throw InputError("--backend " + name + ": unknown; known are " + known);
}

constexpr double kCountsAgree = 1e-3;  // share: who copies or converts a number rounds it [chosen]

/// What the device file leaves open is the box's to say. Where they differ the file holds and a doubt is told. It is
/// not refused: no torque follows from a reading, and whether a box set to other units answers with their counts was
/// never tried, so that the file must stay the way out.
void ask_counts(const std::string& box, const SensorMount& file, WrenchStreamOptions& options) {
  const bool whole = file.counts_per_n && file.counts_per_nm;
  NetFtCounts says;
  try {
    says = net_ft_counts(box);
  } catch (const EnvironmentError&) {
    if (!whole) throw;
    options.counts_from += "; the box was asked in vain";
    return;
  }
  options.counts_per_n = file.counts_per_n.value_or(says.per_n);
  options.counts_per_nm = file.counts_per_nm.value_or(says.per_nm);
  if (!whole) options.counts_from = file.counts_per_n || file.counts_per_nm ? "the device file and the box" : "the box";
  const auto differ = [](double a, double b) { return std::abs(a - b) > kCountsAgree * b; };
  if (differ(options.counts_per_n, says.per_n) || differ(options.counts_per_nm, says.per_nm))
    options.counts_doubt = counts_words({options.counts_per_n, options.counts_per_nm, options.counts_from}) +
                           ", but the box says " + counts_words({says.per_n, says.per_nm, "its calibration"}) +
                           ": correct counts_per_n and counts_per_nm in [sensor] of the device file, or leave them out";
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
bool is_real_device(const std::string& name) { return !backend_abilities(name).pace; }

Backend make_backend(const std::string& name, const BackendOptions& options) {
  const BackendKind& kind = backend_kind(name);
  Backend backend = kind.make(options);
  backend.can = kind.can;
  if (!options.force_sensor.empty()) {
    auto real = make_force_sensor(options.force_sensor, options.sensor_mount);
    backend.stream = real.get();
    backend.sensor = std::move(real);
  }
  return backend;
}

std::unique_ptr<WrenchStream> make_force_sensor(const std::string& words, const std::optional<SensorMount>& mount) {
  const std::size_t colon = words.find(':');
  const std::string kind = words.substr(0, colon), where = colon == std::string::npos ? "" : words.substr(colon + 1);
  WrenchStreamOptions options = kind == "net-ft" ? WrenchStreamOptions{} : nano25_options();
  const SensorMount file = mount.value_or(SensorMount{});
  if (file.counts_per_n || file.counts_per_nm) options.counts_from = "the device file";
  options.counts_per_n = file.counts_per_n.value_or(options.counts_per_n);
  options.counts_per_nm = file.counts_per_nm.value_or(options.counts_per_nm);
  options.lag_s = file.lag_s.value_or(options.lag_s);
  if (kind == "net-ft" && !where.empty()) {
    ask_counts(where, file, options);
    return std::make_unique<NetFt>(where, options);
  }
  if (kind == "serial" && !where.empty()) return std::make_unique<AtiSerial>(where, options);
  if (kind == "serial-binary" && !where.empty())
    return std::make_unique<AtiSerial>(where, options, AtiRecords::kBinary);
  throw InputError("--sensor " + words + ": net-ft:ADDRESS, serial:DEVICE or serial-binary:DEVICE is expected");
}

Backend replay_backend(std::vector<DaqSample> samples, const DaqCapabilities& recorded) {
  return {.daq = std::make_unique<ReplayDaq>(std::move(samples), recorded), .can = {.pause = true, .pace = true}};
}

}  // namespace trocar
