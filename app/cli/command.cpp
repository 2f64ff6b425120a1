#include "app/cli/command.h"

#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/session/setup/typed_path.h"
#include "tissue/solid/tissue_table.h"

namespace trocar {

CLI::App* add_command(CLI::App& parent, const char* name, const char* help, CommandAction& chosen,
                      CommandAction action) {
  CLI::App* command = parent.add_subcommand(name, help);
  command->callback([&chosen, action = std::move(action)] { chosen = action; });
  return command;
}

CLI::App* add_group(CLI::App& parent, const char* name, const char* help) {
  CLI::App* command = parent.add_subcommand(name, help);
  command->require_subcommand(1);
  return command;
}

CLI::Validator writable_path() {
  return CLI::Validator([](std::string& path) { return typed_path_fault(path); }, "PATH");
}

CLI::Validator file_name() {
  return CLI::Validator(
      [](std::string& file) { return file.empty() ? std::string("is empty: a file is asked for") : std::string(); },
      "FILE");
}

void add_device_file_options(CLI::App& command, std::filesystem::path& calibration, std::filesystem::path& device) {
  command
      .add_option("--calibration", calibration, "Amplifier gains and offsets from device calibrate (default: nominal)")
      ->check(file_name());
  command
      .add_option("--device", device,
                  "Device file: weights and friction from device identify, pinch, homing and marks (default: nominal)")
      ->check(file_name());
}

void add_tissue_option(CLI::App& command, std::string& tissue) {
  command
      .add_option("--tissue", tissue,
                  "still, or how the organ gives way: soft, normal or stiff (default: the exercise's)")
      ->check(CLI::IsMember(std::vector<std::string>(kTissueWords.begin(), kTissueWords.end())));
}

CLI::Validator seed_range() { return CLI::Range(0.0, 9e18, "SEED"); }

}  // namespace trocar
