// What a program tells of the attempt that runs in it now, and that as the text of its file
// (docs/decisions/0010-live-station.md).
//
// Forces in virtual newtons, times in seconds of the exercise's clock. A text is judged as it is read: what is not of
// that form is no moment, and numbers that are none are left out. Thread: plain values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trainees/records/process_identity.h"

namespace trocar {

struct LiveEvent {
  double t_s = 0;
  std::string what = {};
  bool grave = false;
  bool operator==(const LiveEvent&) const = default;
};

struct LiveMoment {
  std::string program = {};  ///< "practice window", "trocar run"
  std::string trainee = {};  ///< code; "" for nobody's
  std::string exercise_id = {}, exercise = {}, level = {}, hand = {},
              setup = {};    ///< exercise: its title; setup: organ, board
  std::string attempt = {};  ///< UUID; "" between attempts
  std::string phase = {};    ///< "between attempts", "ready", "armed", "running", "paused", "done", ...
  std::optional<double> elapsed_s = {}, limit_s = {}, force_n = {}, peak_force_n = {}, limit_n = {};
  int done = 0, count = 0;  ///< targets
  std::string device = {}, device_state = {};
  std::optional<double> rate_hz = {};  ///< measured
  std::optional<double> missed = {};   ///< periods of the loop
  bool at_limit = false;               ///< the device gives less force than was asked
  bool hears = false;                  ///< shows what a desk writes
  std::vector<LiveEvent> events = {};  ///< newest last, at most kLiveEvents
  bool operator==(const LiveMoment&) const = default;
};

inline constexpr std::size_t kLiveEvents = 12;

/// A moment with who told it and when.
struct StatusSnapshot {
  LiveMoment moment = {};
  ProcessIdentity process = {};
  std::string machine = {};  ///< its name in the network
  std::string began_utc = {}, told_utc = {};
  double told_s = 0;  ///< since boot, sleep included
};

std::string live_text(const StatusSnapshot& told);
/// Nothing when the text is none of this form; texts in it are cut to 200 bytes.
std::optional<StatusSnapshot> parse_live_text(const std::string& text);

/// The news of a moment: who, what, which phase. Told at once even when nobody looks.
bool same_news(const LiveMoment& a, const LiveMoment& b);

}  // namespace trocar
