// Which key does what: actions with their names, default keys (reference: docs/trainee_guide.md), and a person's own
// choice.
//
// Text form: one line an action, "roll-left = Q". The device has one hand: Tab, 1 and 2, which other trainers use to
// change hands, do nothing in a run. Thread: plain value, any thread.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/window/input/input_event.h"

namespace trocar {

enum class Action : std::uint8_t {
  // steering, held
  kLeft,
  kRight,
  kUp,
  kDown,
  kInsert,
  kWithdraw,
  kRollLeft,
  kRollRight,
  kPitchUp,
  kPitchDown,
  kYawLeft,
  kYawRight,
  kAct,
  kLetOff,
  kClutch,
  kGrip,
  kPedal,
  kExchange,
  kPostLeft,
  kPostRight,
  kScope,
  kLevel,
  // commands, once
  kPause,
  kRestart,
  kMark,
  kHelp,
  kForceBars,
  kDevicePanel,
  kGuidance,
  kPicture,
  kMenu,
};

/// Name in settings, English words on screens.
struct ActionName {
  Action action;
  const char* name;
  const char* words;
  bool steering;
};
const std::vector<ActionName>& action_names();

class KeyMap {
 public:
  /// The default keys.
  KeyMap();
  std::optional<Action> action_of(std::int32_t key) const;
  std::int32_t key_of(Action action) const;
  /// Gives the key to the action; an action that had it before gets what this one had, so nothing is left without.
  /// @throws InputError for keys that must stay (Escape, F1) or only modify others (Shift, Ctrl).
  void assign(Action action, std::int32_t key);
  /// Only what differs from the defaults.
  std::map<std::string, std::string> changes() const;
  /// Jaws, pedal and exchange yield: older files may have given their keys away.
  /// @throws InputError naming an unknown action, key, or one that is given twice.
  void apply(const std::map<std::string, std::string>& changes);

 private:
  std::map<Action, std::int32_t> keys_;
};

/// "F12", "Space", "Page up", "A". And back; kKeyUnknown for what is none.
std::string key_name(std::int32_t key);
std::int32_t key_from_name(const std::string& name);

}  // namespace trocar
