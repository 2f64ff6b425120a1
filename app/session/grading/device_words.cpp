#include "app/session/grading/device_words.h"

#include <cstdio>
#include <map>

#include "scenarios/director/homing_words.h"

namespace trocar {
namespace {

struct FaultWords {
  const char* what;
  const char* advice;
};

/// By fault_name(). "%" stands for the fault's value.
const std::map<std::string, FaultWords>& table() {
  static const std::map<std::string, FaultWords> words{
      {"encoder-jump",
       {"the counter moved by % counts in one period, more than a motor can turn",
        "Check the encoder's plug and cable"}},
      {"channel-invalid", {"the board did not latch this counter", "Check the encoder board and its cable"}},
      {"non-finite", {"a force or torque was not a number", "Report this: it is a fault of the program"}},
      {"overspeed",
       {"it moved at % (rad/s, or m/s at the tip) in spite of damping",
        "Check for a loose cable drive, then hold the stylus firmly"}},
      {"singular", {"the shoulder came too near its singular pose (det A %)", "Move the arm back to the middle"}},
      {"energy-debt",
       {"the contact gave out more energy than it took in (% J)", "Use a softer surface, and check the loop's delay"}},
      {"overheat", {"the motor's winding is at % C by the model", "Let the motors cool for some minutes"}},
      {"late-loop", {"% periods were missed", "Close other programs; use a real-time kernel for real boards"}},
      {"hand-non-finite", {"the simulated hand produced a number that is not finite", "Check the hand's script"}},
      {"self-test",
       {"a check did not pass within its time (bits %: 1 encoders still, 2 deadman open, 4 pace)",
        "Leave the stylus in its jig and the deadman open"}},
      {"encoder-stuck", {"the arm travelled % counts and this encoder counted none", "Check the encoder and its disc"}},
      {"sensor-silent", {"the board latched nothing new", "Check the board's SYNC and its power"}},
      {"dac-mismatch", {"the DAC does not hold the code that was written", "Check the output board"}},
      {"watchdog", {"the board was not written to for 16 ms and has zeroed its outputs", "Check the bus to the board"}},
      {"emergency-stop", {"the emergency stop was pressed", "Make the place safe, then release the button"}},
      {"drive-fault", {"the amplifier reports a fault", "Check its supply, wiring and indicator"}},
      {"drive-hot", {"the amplifier or motor is too hot", "Let it cool and check its fan"}},
      {"stale-patch",
       {"the tissue said nothing new for % s", "Close other programs; where they are closed, report this"}}};
  return words;
}

std::string number(double value, const char* format) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// What homing waited for. Empty: it had not begun.
std::string unhomed_words(LoopState loop, const HomingReport& homing) {
  if (loop != LoopState::kUnhomed || homing.step == HomingStep::kNone) return "";
  const HomingWords words = homing_words(loop, homing);
  return std::string(". ") + words.title + ". " + words.hint;
}

}  // namespace

std::string fault_words(const RunReport& device) {
  if (device.fault.empty()) return "";
  std::string out = device.fault;
  if (device.fault_channel >= 0) out += " on channel " + std::to_string(device.fault_channel);
  out += " at " + number(device.fault_s, "%.3f") + " s";
  const auto found = table().find(device.fault);
  if (found == table().end()) return out;
  std::string what = found->second.what;
  if (const auto at = what.find('%'); at != std::string::npos) what.replace(at, 1, number(device.fault_value, "%.6g"));
  return out + ": " + what + ". " + found->second.advice +
         "; then put the stylus into its jig and start again: the device homes anew.";
}

std::string end_words(AttemptStatus status, const RunReport& device, LoopState loop, bool reached_run,
                      const HomingReport& homing) {
  switch (status) {
    case AttemptStatus::kFault:
      return "device fault " + fault_words(device);
    case AttemptStatus::kVoid:
      if (!reached_run) return "the clock never began: the tip did not come to rest in the start ball";
      return "the deadman was opened during the attempt: a graded attempt cannot be paused";
    case AttemptStatus::kAborted:
      if (reached_run) return "the exercise did not end within its time";
      return std::string("the exercise never began: the device was ") + loop_state_name(loop) +
             (loop == LoopState::kHomed ? ", waiting for the deadman to be closed" : unhomed_words(loop, homing));
    default:
      return "";
  }
}

}  // namespace trocar
