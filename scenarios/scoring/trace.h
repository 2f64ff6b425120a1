// What an attempt is scored from: the sampled trace and the events, exactly as they stand in the recording.
//
// Pure data: no device, no tissue, no file. Live scoring and regrading read the SAME decoded recording, so they agree
// to the bit. Frame T, metres, virtual newtons, loop seconds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "haptics/quantities.h"
#include "scenarios/scoring/event_types.h"

namespace trocar {

/// One haptic tick of the trace.
struct TraceSample {
  double t_s = 0;
  Vec3 tip_T = Vec3::Zero();     ///< m
  Vec3 shaft_T = Vec3::UnitZ();  ///< unit vector along the shaft towards the tip
  Vec3 force_T = Vec3::Zero();   ///< virtual force of the scene on the instrument, N
  double commanded_n = 0;        ///< magnitude asked at the stylus: kappa times the conjugate map of force_T, N
  double rendered_n = 0;         ///< magnitude delivered to the hand, N
  double grip_n = 0;             ///< virtual grip force, N
  double jaw_opening_m = 0;
  double stiffness_n_per_m = 0;  ///< that the contact asks for at the stylus; 0: nothing touched, NaN: not recorded
  double k_max_n_per_m = 0;      ///< that the device can display there; likewise
  bool contact = false;
  bool saturated = false;
  bool passivity_active = false;
  bool pedal = false;           ///< the instrument in hand is energised, or sucks
  std::int32_t instrument = 0;  ///< in hand: index into the exercise's list
};

struct Trace {
  double rate_hz = 1000;
  std::vector<TraceSample> samples;
};

enum class Severity : std::uint8_t { kInfo, kMinor, kMajor, kCritical };

constexpr const char* severity_name(Severity severity) {
  switch (severity) {
    case Severity::kInfo:
      return "info";
    case Severity::kMinor:
      return "minor";
    case Severity::kMajor:
      return "major";
    case Severity::kCritical:
      return "critical";
  }
  return "unknown";
}

/// Something that happened. `type` is the name of an EventType, e.g. TARGET_HELD.
struct Event {
  double t_s = 0;
  std::string type;
  Severity severity = Severity::kInfo;
  std::int32_t object = -1;   ///< target or object index, -1 when none
  double value = 0;           ///< the number that the type defines (N, m or s)
  std::string unit;           ///< unit of value, "" when none
  Vec3 tip_T = Vec3::Zero();  ///< tip at that moment, m
};

/// How an attempt ended. Only kCompleted and kTimeout are graded; the others carry no score.
enum class AttemptStatus : std::uint8_t { kCompleted, kTimeout, kAborted, kFault, kVoid };

constexpr const char* status_name(AttemptStatus status) {
  switch (status) {
    case AttemptStatus::kCompleted:
      return "completed";
    case AttemptStatus::kTimeout:
      return "timeout";
    case AttemptStatus::kAborted:
      return "aborted";
    case AttemptStatus::kFault:
      return "fault";
    case AttemptStatus::kVoid:
      return "void";
  }
  return "unknown";
}

}  // namespace trocar
