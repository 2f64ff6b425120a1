#include "app/window/input/key_map.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "haptics/input_error.h"

namespace trocar {
namespace {

struct KeyName {
  std::int32_t key;
  const char* name;
};

const std::vector<KeyName>& named_keys() {
  static const std::vector<KeyName> table{{kKeySpace, "Space"},
                                          {kKeyEscape, "Esc"},
                                          {kKeyEnter, "Enter"},
                                          {kKeyTab, "Tab"},
                                          {kKeyBackspace, "Backspace"},
                                          {kKeyInsert, "Insert"},
                                          {kKeyDelete, "Delete"},
                                          {kKeyRight, "Right"},
                                          {kKeyLeft, "Left"},
                                          {kKeyDown, "Down"},
                                          {kKeyUp, "Up"},
                                          {kKeyPageUp, "Page up"},
                                          {kKeyPageDown, "Page down"},
                                          {kKeyHome, "Home"},
                                          {kKeyEnd, "End"},
                                          {kKeyShift, "Shift"},
                                          {kKeyControl, "Ctrl"},
                                          {kKeyAlt, "Alt"},
                                          {kKeyF1, "F1"},
                                          {kKeyF2, "F2"},
                                          {kKeyF3, "F3"},
                                          {kKeyF4, "F4"},
                                          {kKeyF5, "F5"},
                                          {kKeyF6, "F6"},
                                          {kKeyF7, "F7"},
                                          {kKeyF8, "F8"},
                                          {kKeyF9, "F9"},
                                          {kKeyF10, "F10"},
                                          {kKeyF11, "F11"},
                                          {kKeyF12, "F12"}};
  return table;
}

const std::map<Action, std::int32_t>& default_keys() {
  static const std::map<Action, std::int32_t> table{
      {Action::kLeft, kKeyLeft},      {Action::kRight, kKeyRight},   {Action::kUp, kKeyUp},
      {Action::kDown, kKeyDown},      {Action::kInsert, kKeyPageUp}, {Action::kWithdraw, kKeyPageDown},
      {Action::kRollLeft, 'Q'},       {Action::kRollRight, 'E'},     {Action::kPitchUp, 'Z'},
      {Action::kPitchDown, 'C'},      {Action::kYawLeft, kKeyHome},  {Action::kYawRight, kKeyEnd},
      {Action::kAct, kKeySpace},      {Action::kLetOff, 'X'},        {Action::kClutch, 'W'},
      {Action::kGrip, 'G'},           {Action::kPedal, 'F'},         {Action::kExchange, 'T'},
      {Action::kPostLeft, 'A'},       {Action::kPostRight, 'D'},     {Action::kScope, 'V'},
      {Action::kLevel, 'H'},          {Action::kPause, 'P'},         {Action::kRestart, 'R'},
      {Action::kMark, 'M'},           {Action::kHelp, kKeyF1},       {Action::kForceBars, kKeyF2},
      {Action::kDevicePanel, kKeyF3}, {Action::kGuidance, kKeyF5},   {Action::kPicture, kKeyF12},
      {Action::kMenu, kKeyEscape}};
  return table;
}

const ActionName& named(Action action) {
  const auto& all = action_names();
  return *std::find_if(all.begin(), all.end(), [&](const ActionName& one) { return one.action == action; });
}

bool stays(Action action) { return action == Action::kMenu || action == Action::kHelp; }

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Came when people had files of their own already.
constexpr std::array kLateActions{Action::kGrip, Action::kPedal, Action::kExchange};

/// Its default, or where another action has been given that, what that one has left.
std::int32_t key_left_for(Action action, const std::map<Action, std::int32_t>& keys) {
  std::int32_t key = default_keys().at(action);
  const auto takes = [&](const auto& own) { return own.first != action && own.second == key; };
  for (auto taker = std::find_if(keys.begin(), keys.end(), takes); taker != keys.end();
       taker = std::find_if(keys.begin(), keys.end(), takes))
    key = default_keys().at(taker->first);
  return key;
}

/// @throws InputError when this key cannot be this action's.
void check_pair(Action action, std::int32_t key) {
  const std::string where = std::string("keys: ") + named(action).name + ": ";
  if (stays(action)) throw InputError(where + "keeps the key " + key_name(default_keys().at(action)));
  for (const Action fixed : {Action::kMenu, Action::kHelp})
    if (key == default_keys().at(fixed))
      throw InputError(where + key_name(key) + " is kept for '" + named(fixed).words + "'; choose another key");
  if (key == kKeyShift || key == kKeyControl)
    throw InputError(where + key_name(key) + " only changes what others do; choose another key");
  if (key_name(key).empty()) throw InputError(where + "no such key");
}

}  // namespace

const std::vector<ActionName>& action_names() {
  static const std::vector<ActionName> table{{Action::kLeft, "left", "Tip to the left", true},
                                             {Action::kRight, "right", "Tip to the right", true},
                                             {Action::kUp, "up", "Tip up", true},
                                             {Action::kDown, "down", "Tip down", true},
                                             {Action::kInsert, "insert", "Tip further in", true},
                                             {Action::kWithdraw, "withdraw", "Tip back", true},
                                             {Action::kRollLeft, "roll-left", "Roll to the left", true},
                                             {Action::kRollRight, "roll-right", "Roll to the right", true},
                                             {Action::kPitchUp, "pitch-up", "Shaft up", true},
                                             {Action::kPitchDown, "pitch-down", "Shaft down", true},
                                             {Action::kYawLeft, "yaw-left", "Shaft to the left", true},
                                             {Action::kYawRight, "yaw-right", "Shaft to the right", true},
                                             {Action::kAct, "act", "Press, or close the jaws", true},
                                             {Action::kLetOff, "let-off", "Let off", true},
                                             {Action::kClutch, "clutch", "Clutch", true},
                                             {Action::kGrip, "grip", "Close the jaws on tissue", true},
                                             {Action::kPedal, "pedal", "Pedal: current or suction", true},
                                             {Action::kExchange, "exchange", "Next instrument", true},
                                             {Action::kPostLeft, "post-left", "Light post to the left", true},
                                             {Action::kPostRight, "post-right", "Light post to the right", true},
                                             {Action::kScope, "scope", "Move the scope", true},
                                             {Action::kLevel, "level", "Scope as at the start", true},
                                             {Action::kPause, "pause", "Pause", false},
                                             {Action::kRestart, "restart", "Start again", false},
                                             {Action::kMark, "mark", "Mark this moment", false},
                                             {Action::kHelp, "help", "Help", false},
                                             {Action::kForceBars, "force-bars", "Force bars", false},
                                             {Action::kDevicePanel, "device-panel", "Device panel", false},
                                             {Action::kGuidance, "guidance", "Guidance", false},
                                             {Action::kPicture, "picture", "Save a picture", false},
                                             {Action::kMenu, "menu", "Menu", false}};
  return table;
}

KeyMap::KeyMap() : keys_(default_keys()) {}

std::optional<Action> KeyMap::action_of(std::int32_t key) const {
  for (const auto& [action, own] : keys_)
    if (own == key) return action;
  return std::nullopt;
}

std::int32_t KeyMap::key_of(Action action) const { return keys_.at(action); }

void KeyMap::assign(Action action, std::int32_t key) {
  check_pair(action, key);
  if (const auto before = action_of(key)) keys_[*before] = keys_.at(action);
  keys_[action] = key;
}

std::map<std::string, std::string> KeyMap::changes() const {
  std::map<std::string, std::string> out;
  for (const auto& [action, key] : keys_)
    if (key != default_keys().at(action)) out[named(action).name] = key_name(key);
  return out;
}

void KeyMap::apply(const std::map<std::string, std::string>& changes) {
  std::map<Action, std::int32_t> keys = default_keys();
  for (const auto& [name, text] : changes) {
    const auto& all = action_names();
    const auto found = std::find_if(all.begin(), all.end(), [&](const ActionName& one) { return one.name == name; });
    if (found == all.end()) throw InputError("keys: '" + name + "' is no action");
    const std::int32_t key = key_from_name(text);
    if (key == kKeyUnknown) throw InputError("keys: " + name + ": '" + text + "' is no key");
    check_pair(found->action, key);
    keys[found->action] = key;
  }
  for (const Action late : kLateActions)
    if (!changes.contains(named(late).name)) keys[late] = key_left_for(late, keys);
  std::map<std::int32_t, Action> taken;
  for (const auto& [action, key] : keys) {
    const auto [at, fresh] = taken.emplace(key, action);
    if (!fresh)
      throw InputError(std::string("keys: ") + named(action).name + " and " + named(at->second).name + " both have " +
                       key_name(key));
  }
  keys_ = keys;
}

std::string key_name(std::int32_t key) {
  for (const KeyName& one : named_keys())
    if (one.key == key) return one.name;
  const bool printed = key > ' ' && key < 127 && !std::islower(static_cast<unsigned char>(key));
  return printed ? std::string(1, static_cast<char>(key)) : "";
}

std::int32_t key_from_name(const std::string& name) {
  for (const KeyName& one : named_keys())
    if (lower(one.name) == lower(name)) return one.key;
  if (name.size() != 1) return kKeyUnknown;
  const std::int32_t key = std::toupper(static_cast<unsigned char>(name[0]));
  return key_name(key).empty() ? static_cast<std::int32_t>(kKeyUnknown) : key;
}

}  // namespace trocar
