// `trocar device stop`: what the loop remembered of the moment in which the torque went off.
#include <algorithm>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/attempts/recording_subject.h"
#include "app/cli/command.h"
#include "app/cli/text_table.h"
#include "app/session/recording/safety_file.h"
#include "haptics/device/data_acquisition.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

struct StopOptions {
  std::string subject;
  std::filesystem::path database;
  int ticks = 20;
  bool json = false;
};

std::filesystem::path safety_file(const StopOptions& o, std::ostream& err) {
  if (o.subject.ends_with(".safety.csv")) return o.subject;
  const std::filesystem::path file = safety_file_of(find_subject(o.subject, o.database, err).file);
  if (!std::filesystem::exists(file))
    throw InputError(o.subject + ": the torque did not go off on the way, so nothing of a stop was kept (" +
                     file.string() + ")");
  return file;
}

std::string input_words(const std::string& bits_text) {
  const auto bits = static_cast<std::uint32_t>(std::stoul(bits_text));
  constexpr std::pair<std::uint32_t, const char*> kNames[] = {
      {kDeadman, "deadman"},        {kHomeBeam, "beam"}, {kHandFault, "hand-fault"}, {kEmergencyStop, "stop"},
      {kWatchdogFired, "watchdog"}, {kClutch, "clutch"}, {kPedal, "pedal"},          {kExchange, "exchange"}};
  std::string out;
  const auto add = [&](const std::string& word) { out += (out.empty() ? "" : " ") + word; };
  for (const auto& [bit, name] : kNames)
    if (bits & bit) add(name);
  for (int i = 0; i < kChannels; ++i) {
    if (channel_input(bits, kDacMismatch, i)) add("dac-mismatch-" + std::to_string(i));
    if (channel_input(bits, kDriveFault, i)) add("drive-fault-" + std::to_string(i));
    if (channel_input(bits, kDriveHot, i)) add("drive-hot-" + std::to_string(i));
  }
  return out.empty() ? "-" : out;
}

/// Rows up to the last change that took the torque away, its own tick among them.
std::vector<SafetyFile::Fields> rows_before(const SafetyFile& stop, int ticks) {
  unsigned long long last = 0;
  for (const SafetyFile::Fields& change : stop.changes)
    if (change[3] == "fault" || change[2] == "active") last = std::stoull(change[0]);
  std::vector<SafetyFile::Fields> out;
  for (const SafetyFile::Fields& row : stop.rows)
    if (last == 0 || std::stoull(row[0]) <= last) out.push_back(row);
  const auto most = static_cast<std::size_t>(ticks);
  if (out.size() > most) out.erase(out.begin(), out.end() - static_cast<std::ptrdiff_t>(most));
  return out;
}

std::string joined(const SafetyFile::Fields& row, std::size_t from) {
  std::string out;
  for (std::size_t i = 0; i < kChannels; ++i) out += (i ? " " : "") + row[from + i];
  return out;
}

nlohmann::ordered_json stop_json(const std::filesystem::path& file, const SafetyFile& stop, int ticks) {
  constexpr const char* kNames[] = {"period", "t_s", "from", "to", "cause", "channel", "value"};
  nlohmann::ordered_json json{{"file", file.string()}, {"changes", nlohmann::ordered_json::array()}};
  for (const SafetyFile::Fields& change : stop.changes) {
    nlohmann::ordered_json& one = json["changes"].emplace_back(nlohmann::ordered_json::object());
    for (std::size_t i = 0; i < change.size(); ++i) one[kNames[i]] = change[i];
  }
  json["rows"] = nlohmann::ordered_json::array();
  for (const SafetyFile::Fields& row : rows_before(stop, ticks)) {
    nlohmann::ordered_json& one = json["rows"].emplace_back(nlohmann::ordered_json::object());
    for (std::size_t i = 0; i < row.size(); ++i) one[stop.columns[i]] = row[i];
  }
  return json;
}

int device_stop(const StopOptions& o, std::ostream& out, std::ostream& err) {
  const std::filesystem::path file = safety_file(o, err);
  const SafetyFile stop = read_safety_file(file);
  try {
    if (o.json) {
      out << stop_json(file, stop, o.ticks).dump(2) << '\n';
      return 0;
    }
    using enum TextTable::Align;
    TextTable changes(
        {{"period", kRight}, {"t, s", kRight}, {"from"}, {"to"}, {"cause"}, {"channel", kRight}, {"value", kRight}});
    for (const SafetyFile::Fields& change : stop.changes) changes.add(change);
    changes.print(out);
    out << '\n';
    TextTable ticks(
        {{"period", kRight}, {"state"}, {"valid", kRight}, {"periods", kRight}, {"inputs"}, {"counts"}, {"codes"}});
    for (const SafetyFile::Fields& row : rows_before(stop, o.ticks))
      ticks.add({row[0], row[1], row[3], row[4], input_words(row[5]), joined(row, 6), joined(row, 6 + kChannels)});
    ticks.print(out);
    err << "trocar: " << file.string() << " holds " << stop.rows.size() << " ticks\n";
    return 0;
  } catch (const std::logic_error&) {  // of std::stoul: what must be a number is none
    throw InputError(file.string() + ": a field that must be a whole number is none");
  }
}

}  // namespace

void add_device_stop(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<StopOptions>();
  StopOptions& o = *given;
  CLI::App* stop = add_command(parent, "stop", "Why the torque went off in an attempt, and the last ticks before it",
                               chosen, [given] { return device_stop(*given, std::cout, std::cerr); });
  stop->add_option("attempt", o.subject, "Attempt (UUID part, 'latest'), recording, or its .safety.csv")->required();
  stop->add_option("--ticks", o.ticks, "Of the last ones")->capture_default_str()->check(CLI::Range(1, 100000));
  stop->add_option("--db", o.database, "Database file");
  stop->add_flag("--json", o.json, "As JSON");
}

}  // namespace trocar
