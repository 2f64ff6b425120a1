// `trocar device faults`: what takes the torque away on a back-end, and in how many ticks.
#include <algorithm>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/cli/text_table.h"
#include "app/device_bench/fault_trials.h"
#include "app/session/setup/device_files.h"
#include "haptics/device/backends/make_backend.h"
#include "haptics/device/backends/simulated_board.h"

namespace trocar {
namespace {

constexpr int kTorqueStayed = 4;

struct FaultsOptions {
  std::string backend = kSimulatedBackend;
  SimulatedDaqConfig device;
  bool json = false;
};

nlohmann::ordered_json faults_json(const std::vector<FaultTrial>& trials, const FaultsOptions& o, bool sound) {
  nlohmann::ordered_json json{{"backend", o.backend},
                              {"device", simulated_plant_words(o.device.seed)},
                              {"rate_hz", o.device.rate_hz},
                              {"passed", sound},
                              {"faults", nlohmann::ordered_json::array()}};
  for (const FaultTrial& t : trials)
    json["faults"].push_back({{"fault", t.fault},
                              {"reaction", t.reaction},
                              {"cause", t.cause},
                              {"channel", t.channel},
                              {"seen_ticks", t.seen_ticks},
                              {"off_ticks", t.off_ticks},
                              {"limit_ticks", t.limit_ticks},
                              {"failure", t.failure}});
  return json;
}

int device_faults(const FaultsOptions& o, std::ostream& out, std::ostream& err) {
  const std::vector<FaultTrial> trials = try_faults(o.backend, o.device);
  const auto failed = std::ranges::count_if(trials, [](const FaultTrial& t) { return !t.failure.empty(); });
  if (o.json) {
    out << faults_json(trials, o, failed == 0).dump(2) << '\n';
  } else {
    using enum TextTable::Align;
    TextTable table({{"fault"},
                     {"reaction"},
                     {"cause"},
                     {"channel", kRight},
                     {"seen, ticks", kRight},
                     {"zero torque, ticks", kRight},
                     {"limit", kRight},
                     {"outcome"}});
    for (const FaultTrial& t : trials)
      table.add({t.fault, t.reaction, t.cause, t.channel < 0 ? "-" : std::to_string(t.channel),
                 std::to_string(t.seen_ticks), std::to_string(t.off_ticks), std::to_string(t.limit_ticks),
                 t.failure.empty() ? "pass" : "FAIL: " + t.failure});
    table.print(out);
  }
  err << "trocar: " << trials.size() << " faults on back-end " << o.backend << " with the simulated device behind it, "
      << failed << " failed\n";
  return failed == 0 ? 0 : kTorqueStayed;
}

}  // namespace

void add_device_faults(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<FaultsOptions>();
  FaultsOptions& o = *given;
  CLI::App* faults =
      add_command(parent, "faults", "Every fault of a back-end, and the ticks until no motor has current", chosen,
                  [given] { return device_faults(*given, std::cout, std::cerr); });
  faults->add_flag("--json", o.json, "As JSON");
  faults->add_option("--backend", o.backend, "What it is done on, with the simulated device behind it")
      ->capture_default_str()
      ->check(CLI::IsMember(simulated_board_names()));
  faults->add_option("--seed", o.device.seed, "Of the simulated device")->capture_default_str()->check(seed_range());
  faults->add_option("--rate", o.device.rate_hz, "SYNC rate, Hz")
      ->capture_default_str()
      ->check(CLI::IsMember({1000, 2000, 4000}));
}

}  // namespace trocar
