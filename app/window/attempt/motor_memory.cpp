#include "app/window/attempt/motor_memory.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <optional>

#include <nlohmann/json.hpp>

#include "app/session/setup/motor_pairs.h"
#include "haptics/input_error.h"
#include "trainees/files/owner_file.h"
#include "trainees/files/write_file.h"
#include "trainees/live/live_clock.h"
#include "trainees/records/process_identity.h"
#include "trainees/store/database.h"

namespace trocar {
namespace {

constexpr double kNoMotor_c = 400;  // its copper's insulation is gone long before
constexpr double kWaitStep_s = 10, kLongestWait_s = 3600;

double calendar_s() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

struct Kept {
  MotorStates motors;
  double ago_s = 0;
};

std::optional<Kept> kept_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return std::nullopt;
  try {
    const auto json = nlohmann::json::parse(in);
    const auto motors = motor_states(json.at(kMotorsKey).get<MotorPairs>());
    if (!motors) return std::nullopt;
    for (const MotorTemperatures& motor : *motors)
      if (std::max(std::abs(motor.winding_c), std::abs(motor.case_c)) > kNoMotor_c) return std::nullopt;
    Kept out{.motors = *motors};
    const bool same_start = json.at("boot").get<std::string>() == this_process().boot;
    out.ago_s = same_start ? since_boot_s() - json.at("since_boot_s").get<double>()
                           : calendar_s() - json.at("calendar_s").get<double>();
    return out;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace

MotorMemory::MotorMemory(const std::filesystem::path& folder, const std::string& backend, const std::string& card) {
  std::string name = backend + '-' + card;
  std::ranges::replace_if(
      name, [](unsigned char c) { return !std::isalnum(c) && c != '-' && c != '.'; }, '_');
  file_ = folder / (name + ".json");
}

MotorStates MotorMemory::now() const {
  MotorStates motors;
  const std::optional<Kept> kept = kept_in(file_);
  if (!kept) return motors;
  std::ranges::transform(kept->motors, motors.begin(), [&](const MotorTemperatures& then) {
    MotorHeat heat({}, then);
    heat.rest(kept->ago_s);
    return heat.temperatures();
  });
  return motors;
}

void MotorMemory::keep(const MotorStates& motors) const {
  const nlohmann::json json = {{"boot", this_process().boot},
                               {"since_boot_s", since_boot_s()},
                               {"calendar_s", std::round(calendar_s())},
                               {kMotorsKey, motor_pairs(motors)}};
  if (!make_owner_folders(file_.parent_path()))
    throw EnvironmentError(file_.parent_path().string() + ": cannot be made");
  std::filesystem::path fresh = file_;
  fresh += ".new";
  write_owner_file(fresh, json.dump() + '\n');
  std::error_code failed;
  std::filesystem::rename(fresh, file_, failed);
  if (failed) throw EnvironmentError(file_.string() + ": cannot be written: " + failed.message());
}

std::filesystem::path motor_folder() {
  try {
    return default_database_path().parent_path() / "motors";
  } catch (const EnvironmentError&) {
    return std::filesystem::temp_directory_path() / "trocar-motors";
  }
}

std::string too_hot_to_begin(const MotorStates& motors) {
  const auto hottest = std::ranges::max_element(motors, {}, &MotorTemperatures::winding_c);
  MotorHeat heat({}, *hottest);
  if (!heat.hot()) return "";
  double wait_s = 0;
  for (; heat.hot() && wait_s < kLongestWait_s; wait_s += kWaitStep_s) heat.rest(kWaitStep_s);
  const auto channel = hottest - motors.begin();
  return (channel == kPinchChannel ? std::string("the pinch's motor") : "motor " + std::to_string(channel + 1)) +
         " is at " + std::to_string(std::lround(hottest->winding_c)) + " C by the model: let it cool for " +
         std::to_string(std::lround(wait_s)) + " s";
}

}  // namespace trocar
