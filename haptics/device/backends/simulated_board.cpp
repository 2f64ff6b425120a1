#include "haptics/device/backends/simulated_board.h"

#include <utility>

#include "haptics/device/backends/make_backend.h"
#include "haptics/device/hostmot2/hostmot2_daq.h"
#include "haptics/device/mc4000/mc4000_daq.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

SimulatedBoard plain_device(const SimulatedDaqConfig& config, double /*answer_s*/) {
  auto daq = std::make_unique<SimulatedDaq>(config);
  SimulatedDaq* device = daq.get();
  return {.daq = std::move(daq), .world = device, .device = device};
}

/// Device, card and the driver of a real one.
class FakeCardDaq final : public DataAcquisition {
 public:
  FakeCardDaq(const SimulatedDaqConfig& device, Hostmot2Options own)
      : device_(FakeHostmot2::device_config(device)), card_(device_, device.faults, own.wiring), driver_([&] {
          own.card = card_.address();
          return own;
        }()) {}
  DaqCapabilities capabilities() const noexcept override { return driver_.capabilities(); }
  DaqSample read() noexcept override { return driver_.read(); }
  void write(const DacFrame& frame) noexcept override { driver_.write(frame); }
  /// What disarms is sent without a question: it has acted before anybody looks, so that runs repeat to the bit.
  void arm(bool enabled) noexcept override {
    driver_.arm(enabled);
    if (!enabled) card_.settle(driver_.link().sent);
  }
  SimulatedDaq& device() { return device_; }
  FakeHostmot2& card() { return card_; }

 private:
  SimulatedDaq device_;
  FakeHostmot2 card_;
  Hostmot2Daq driver_;
};

SimulatedBoard with_card(const SimulatedDaqConfig& config, double answer_s) {
  constexpr int kHandPin = 69;
  Hostmot2Options own;
  own.name = kFakeHostmot2Backend;
  own.rate_hz = config.rate_hz;
  own.watchdog_s = config.watchdog_s;
  own.wait_share = answer_s * own.rate_hz;
  own.wiring.inputs.push_back({kHandFault, kHandPin, false});  // that a real hand does not have
  auto daq = std::make_unique<FakeCardDaq>(config, own);
  FakeCardDaq& d = *daq;
  return {.daq = std::move(daq), .world = &d.card(), .device = &d.device(), .card = &d.card()};
}

/// Device, boards and the driver of real ones.
class EmulatedBoardsDaq final : public DataAcquisition {
 public:
  EmulatedBoardsDaq(const SimulatedDaqConfig& device, const Mc4000Options& own)
      : device_(EmulatedMc4000::device_config(device)),
        boards_(device_, device.rate_hz, own.map, own.inputs),
        driver_(boards_.board(0), boards_.board(1), own) {}
  DaqCapabilities capabilities() const noexcept override { return driver_.capabilities(); }
  DaqSample read() noexcept override { return driver_.read(); }
  void write(const DacFrame& frame) noexcept override { driver_.write(frame); }
  void arm(bool enabled) noexcept override { driver_.arm(enabled); }
  SimulatedDaq& device() { return device_; }
  EmulatedMc4000& boards() { return boards_; }

 private:
  SimulatedDaq device_;
  EmulatedMc4000 boards_;
  Mc4000Daq driver_;
};

SimulatedBoard with_boards(const SimulatedDaqConfig& config, double /*answer_s*/) {
  constexpr int kHandPin = 31;
  Mc4000Options own;
  own.name = kEmulatedMc4000Backend;
  own.rate_hz = config.rate_hz;
  own.watchdog_s = config.watchdog_s;
  own.inputs.push_back({kHandFault, 1, kHandPin, false});  // that a real hand does not have
  auto daq = std::make_unique<EmulatedBoardsDaq>(config, own);
  EmulatedBoardsDaq& d = *daq;
  return {.daq = std::move(daq), .world = &d.device(), .device = &d.device(), .boards = &d.boards()};
}

using Open = SimulatedBoard (*)(const SimulatedDaqConfig& config, double answer_s);
constexpr std::pair<const char*, Open> kBoards[] = {
    {kSimulatedBackend, plain_device}, {kFakeHostmot2Backend, with_card}, {kEmulatedMc4000Backend, with_boards}};

}  // namespace

std::vector<std::string> simulated_board_names() {
  std::vector<std::string> names;
  for (const auto& [name, open] : kBoards) names.emplace_back(name);
  return names;
}

SimulatedBoard open_simulated_board(const std::string& name, const SimulatedDaqConfig& config, double answer_s) {
  for (const auto& [known, open] : kBoards)
    if (name == known) return open(config, answer_s);
  throw InputError("--backend " + name + ": no simulated device behind it");
}

}  // namespace trocar
