// `trocar device card`: who a Mesa card on the network is, what its firmware has, and what its inputs say now.
// `trocar device boards`: what stands in the registers of MC4000 boards.
//
// Registers are read; nothing is written but the counter that a card keeps for its host.
#include <algorithm>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/cli/text_table.h"
#include "haptics/device/hostmot2/card_inquiry.h"
#include "haptics/device/hostmot2/hostmot2_daq.h"
#include "haptics/device/mc4000/mc4000_daq.h"
#include "haptics/device/mc4000/pci_bus.h"

namespace trocar {
namespace {

using hostmot2::Tag;

constexpr int kUnfit = 4;

struct CardCommand {
  std::string card = Hostmot2Options{}.card;
  bool json = false;
};

struct InputName {
  std::uint32_t bits;
  const char* name;
};
constexpr InputName kInputNames[] = {{kDeadman, "enabling switch closed"},
                                     {kHomeBeam, "home beam received"},
                                     {kEmergencyStop, "emergency stop"},
                                     {kClutch, "clutch"},
                                     {kPedal, "pedal"},
                                     {kExchange, "exchange"}};

std::string input_words(std::uint32_t bits) {
  for (const InputName& named : kInputNames)
    if (named.bits == bits) return named.name;
  for (int i = 0; i < kChannels; ++i) {
    if (bits == kDriveFault << i) return "drive fault " + std::to_string(i + 1);
    if (bits == kDriveHot << i) return "over-temperature " + std::to_string(i + 1);
  }
  return "input";
}

int device_card(const CardCommand& options, std::ostream& out, std::ostream& err) {
  hostmot2::CardInquiry card(options.card, Hostmot2Options{}.setup_wait_s);
  const hostmot2::Identity identity = card.identify();
  nlohmann::ordered_json json{{"card", options.card}, {"board", identity.board}, {"pins", identity.pins.size()}};
  bool fit = true;
  TextTable modules({{"module"}, {"there"}, {"needed"}, {"clock, MHz"}});
  const hostmot2::Module* io = nullptr;
  for (const hostmot2::Need& need : hostmot2::kNeeds) {
    const auto at = std::find_if(identity.modules.begin(), identity.modules.end(),
                                 [&need](const hostmot2::Module& m) { return m.tag == need.tag; });
    const int there = at == identity.modules.end() ? 0 : at->instances;
    const double clock_mhz = there == 0 ? 0 : at->clock_hz * 1e-6;
    fit = fit && there >= need.instances;
    if (need.tag == Tag::kIoPort && there > 0) io = &*at;
    modules.add(
        {need.name, std::to_string(there), std::to_string(need.instances), std::to_string(std::lround(clock_mhz))});
    json["modules"].push_back(
        {{"name", need.name}, {"there", there}, {"needed", need.instances}, {"clock_mhz", clock_mhz}});
  }
  TextTable inputs({{"pin"}, {"input"}, {"now"}});
  for (const hostmot2::Wiring::Input& input : hostmot2::standard_wiring().inputs) {
    const bool there = io && static_cast<std::size_t>(input.pin) < identity.pins.size();
    fit = fit && there;
    std::string now = "no such pin";
    if (there) {
      const auto port = card.ask(io->at(hostmot2::IoPortRegister::kData, input.pin / identity.port_width));
      now = ((port >> input.pin % identity.port_width & 1) != 0) != input.active_low ? "yes" : "no";
    }
    inputs.add({std::to_string(input.pin), input_words(input.bits), now});
    json["inputs"].push_back({{"pin", input.pin}, {"input", input_words(input.bits)}, {"now", now}});
  }
  json["fit"] = fit;
  if (options.json) {
    out << json.dump(2) << '\n';
  } else {
    out << identity.board << " at " << options.card << ", " << identity.pins.size() << " pins in " << identity.ports
        << " ports\n\n";
    modules.print(out);
    out << '\n';
    inputs.print(out);
  }
  err << "trocar: "
      << (fit ? "this card has what the device needs" : "this card or its firmware lacks what the device needs")
      << "; nothing was written\n";
  return fit ? 0 : kUnfit;
}

/// What stands in a board's registers, one that nobody answers for included: all ones.
int device_boards(const std::vector<std::string>& boards, std::ostream& out) {
  for (const std::string& board : boards) {
    PciBus bus(board, 1000);
    out << board << '\n';
    for (const std::string& line : Mc4000Daq::dry_look(bus, {})) out << "  " << line << '\n';
  }
  return 0;
}

}  // namespace

void add_device_boards(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<std::vector<std::string>>();
  CLI::App* boards = add_command(parent, "boards", "What stands in the registers of MC4000 boards; reads only", chosen,
                                 [given] { return device_boards(*given, std::cout); });
  boards->add_option("device", *given, "Folder in /sys/bus/pci/devices, or /dev/uio, of each board")->required();
}

void add_device_card(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<CardCommand>();
  CLI::App* card = add_command(parent, "card", "Who a Mesa card on the network is, and what its inputs say; reads only",
                               chosen, [given] { return device_card(*given, std::cout, std::cerr); });
  card->add_option("address", given->card, "Of the card, with :PORT where it is not 27181")->capture_default_str();
  card->add_flag("--json", given->json, "As JSON");
}

}  // namespace trocar
