#include "app/cli/device/device_selftest.h"

#include <algorithm>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/attempts/run_command.h"
#include "app/cli/command.h"
#include "app/cli/text_table.h"
#include "app/device_bench/board_checks.h"
#include "app/device_bench/simulated_bench.h"
#include "app/session/setup/device_files.h"
#include "haptics/device/backends/simulated_board.h"

namespace trocar {
namespace {

constexpr int kSelftestFault = 4;

nlohmann::ordered_json selftest_json(const std::vector<BoardCheck>& checks, const SelfTestOptions& options,
                                     bool sound) {
  nlohmann::ordered_json json{{"backend", options.backend},
                              {"device", simulated_plant_words(options.seed)},
                              {"rate_hz", options.rate_hz},
                              {"passed", sound},
                              {"checks", nlohmann::ordered_json::array()}};
  for (const BoardCheck& check : checks) {
    json["checks"].push_back(
        {{"name", check.name}, {"outcome", outcome_name(check.outcome)}, {"detail", check.detail}});
  }
  return json;
}

}  // namespace

int device_selftest(const SelfTestOptions& options, std::ostream& out, std::ostream& err) {
  SimulatedDaqConfig config;
  config.seed = options.seed;
  config.rate_hz = options.rate_hz;
  for (const std::string& text : options.injections) config.faults.push_back(parse_injection(text));
  SimulatedBench bench(config, options.backend);
  const std::vector<BoardCheck> checks = check_board(bench);
  const auto failed = std::count_if(checks.begin(), checks.end(),
                                    [](const BoardCheck& c) { return c.outcome == BoardCheck::Outcome::kFailed; });
  if (options.json) {
    out << selftest_json(checks, options, failed == 0).dump(2) << '\n';
  } else {
    TextTable table({{"check"}, {"outcome"}, {"detail"}});
    for (const BoardCheck& check : checks) table.add({check.name, outcome_name(check.outcome), check.detail});
    table.print(out);
  }
  err << "trocar: " << checks.size() << " checks of back-end " << options.backend << " on the simulated device, seed "
      << options.seed << ", " << failed << " failed\n";
  return failed == 0 ? 0 : kSelftestFault;
}

void add_device_selftest(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<SelfTestOptions>();
  SelfTestOptions& o = *given;
  CLI::App* selftest =
      add_command(parent, "selftest", "What the back-end owes the loop, check by check; 4 when one fails", chosen,
                  [given] { return device_selftest(*given, std::cout, std::cerr); });
  selftest->add_flag("--json", o.json, "As JSON");
  selftest->add_option("--backend", o.backend, "What it is done on, with the simulated device behind it")
      ->capture_default_str()
      ->check(CLI::IsMember(simulated_board_names()));
  selftest->add_option("--seed", o.seed, "Of the simulated device")->capture_default_str()->check(seed_range());
  selftest->add_option("--rate", o.rate_hz, "SYNC rate, Hz")
      ->capture_default_str()
      ->check(CLI::IsMember({1000, 2000, 4000}));
  selftest->add_option("--inject", o.injections, "Device fault as in run, repeatable: see a check fail");
}

}  // namespace trocar
