#include "app/cli/machine/doctor_command.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <iomanip>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/picture/gl/headless_context.h"
#include "app/session/setup/scene.h"
#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "trainees/store/database.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr double kMiB = 1024.0 * 1024.0;
constexpr double kBudgetMiBPerMinute = 0.6;  // a recording's budget: what free room is worth in minutes
constexpr double kLeastFreeMiB = 100;        // an hour of recordings and the database with room to spare
constexpr int kLoopPriority = 80;            // SCHED_FIFO priority that a live loop asks for

enum class State : std::uint8_t { kGood, kNote, kMissing };

struct Finding {
  const char* name;
  State state = State::kGood;
  std::string text;
};

const char* state_name(State state) {
  switch (state) {
    case State::kGood:
      return "ok";
    case State::kNote:
      return "note";
    case State::kMissing:
      return "missing";
  }
  return "";
}

/// The text that `look` gives, or what it throws as missing.
Finding needed(const char* name, const std::function<std::string()>& look) {
  try {
    return {name, State::kGood, look()};
  } catch (const std::exception& error) {
    return {name, State::kMissing, error.what()};
  }
}

std::string picture() {
  const HeadlessContext context;
  const ContextInfo& info = context.info();
  return info.renderer + ", OpenGL " + info.version + " on " + info.platform +
         (info.software ? ": drawn by the processor" : "");
}

std::string assets() {
  const AssetRoots roots = find_assets();
  return roots.assets.string() + ", " + std::to_string(list_exercises(roots.exercises).size()) + " exercises in " +
         roots.exercises.string();
}

fs::path database_file(const DoctorOptions& options) {
  return options.database.empty() ? default_database_path() : fs::absolute(options.database);
}

std::string database(const fs::path& file) {
  const auto schema = schema_of_file(file);
  if (!schema) return file.string() + ": not there yet, the first attempt makes it";
  const int known = shipped_migrations().back().version;
  std::string text = file.string() + ": schema " + std::to_string(*schema);
  if (*schema < known) text += ", migrated to " + std::to_string(known) + " when it is next opened";
  return text;
}

/// Room where the database and its recordings lie, or will.
Finding disk_room(const fs::path& file) {
  fs::path folder = file.parent_path();
  std::error_code error;
  while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  const fs::space_info space = fs::space(folder, error);
  if (error) return {"disk", State::kMissing, folder.string() + ": " + error.message()};
  if (access(folder.c_str(), W_OK) != 0) return {"disk", State::kMissing, folder.string() + ": is not writable"};
  const double free = static_cast<double>(space.available) / kMiB;
  const auto minutes = static_cast<long long>(free / kBudgetMiBPerMinute);
  return {"disk", free < kLeastFreeMiB ? State::kMissing : State::kGood,
          std::to_string(static_cast<long long>(free)) + " MiB free in " + folder.string() + ", about " +
              std::to_string(minutes / 60) + " h of recordings"};
}

Finding limit(const char* name, int resource, double wanted, const std::string& meaning) {
  rlimit now{};
  getrlimit(static_cast<__rlimit_resource>(resource), &now);
  const bool endless = now.rlim_cur == RLIM_INFINITY;
  const bool enough = endless || static_cast<double>(now.rlim_cur) >= wanted || geteuid() == 0;
  const std::string value = endless ? "unlimited" : std::to_string(now.rlim_cur);
  return {name, enough ? State::kGood : State::kNote, value + (enough ? "" : ": " + meaning)};
}

std::vector<Finding> findings(const DoctorOptions& options) {
  const fs::path file = database_file(options);
  return {{"version", State::kGood,
           "trocar " TROCAR_VERSION ", database schema " + std::to_string(shipped_migrations().back().version)},
          {"processors", State::kGood, std::to_string(std::thread::hardware_concurrency())},
          needed("assets", assets),
          needed("picture", picture),
          needed("database", [&] { return database(file); }),
          disk_room(file),
          limit("rtprio", RLIMIT_RTPRIO, kLoopPriority, "a live loop would run without real-time priority"),
          limit("memlock", RLIMIT_MEMLOCK, 256 * kMiB, "a live loop could not lock its memory")};
}

}  // namespace

int doctor_command(const DoctorOptions& options, std::ostream& out, std::ostream&) {
  const std::vector<Finding> found = findings(options);
  const bool sound =
      std::none_of(found.begin(), found.end(), [](const Finding& f) { return f.state == State::kMissing; });
  if (options.json) {
    nlohmann::ordered_json json = {{"sound", sound}};
    for (const Finding& finding : found) {
      json["findings"].push_back(
          {{"name", finding.name}, {"state", state_name(finding.state)}, {"text", finding.text}});
    }
    out << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  } else {
    for (const Finding& finding : found) {
      out << std::left << std::setw(9) << state_name(finding.state) << std::setw(12) << finding.name << finding.text
          << '\n';
    }
  }
  return sound ? 0 : 3;
}

void add_doctor(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<DoctorOptions>();
  DoctorOptions& o = *given;
  CLI::App* doctor = add_command(parent, "doctor", "What this machine offers, and what is missing", chosen,
                                 [given] { return doctor_command(*given, std::cout, std::cerr); });
  doctor->add_option("--db", o.database, "Database file");
  doctor->add_flag("--json", o.json, "As JSON");
}

}  // namespace trocar
