#include "app/device_bench/simulated_bench.h"

namespace trocar {

std::unique_ptr<DataAcquisition> SimulatedBench::open(const BoardActs& acts) {
  SimulatedDaqConfig config = config_;
  if (acts.stop_pressed_s) config.faults.push_back({InjectedFaultKind::kEmergencyStop, *acts.stop_pressed_s, 0, 0, 0});
  if (acts.switch_opened_s) config.faults.push_back({InjectedFaultKind::kDeadmanOpen, *acts.switch_opened_s, 0, 0, 0});
  if (acts.counters_at) {
    SimulatedDaqConfig sound = config;
    sound.faults.clear();
    const DaqSample first = make_backend(kSimulatedBackend, {.simulated = sound}).daq->read();
    if (!config.plant) config.plant = draw_parameters(config.seed);
    for (int i = 0; i < kChannels; ++i) {
      const auto c = static_cast<std::size_t>(i);
      config.plant->channel[c].encoder_offset_counts += static_cast<double>(*acts.counters_at) - first.counts[c];
    }
  }
  Backend backend = make_backend(backend_, {.simulated = config});
  if (acts.held) {
    const HandSense sense = backend.world->sense();
    backend.world->set_hand_intent(sense.X_BS, sense.jaw_opening_m);
  }
  return std::move(backend.daq);
}

}  // namespace trocar
