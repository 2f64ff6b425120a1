#include "app/window/pages/settings_screen.h"

#include <algorithm>

#include "app/window/practice/practice_model.h"
#include "app/window/ui/ui.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

int index_of(const std::vector<std::string>& names, const std::string& name) {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? 0 : static_cast<int>(at - names.begin());
}

/// A list of names of which one is kept in the settings.
bool name_choice(Ui& ui, const char* id, const std::string& text, const std::vector<std::string>& shown,
                 const std::vector<std::string>& names, std::string& kept) {
  int chosen = index_of(names, kept);
  if (!ui.choice(id, text, shown, chosen)) return false;
  kept = names[static_cast<std::size_t>(chosen)];
  return true;
}

}  // namespace

void SettingsScreen::general(Ui& ui, PracticeModel& model) {
  const Translator& w = model.words();
  Settings& s = model.settings();
  bool changed = false;
  if (languages_.empty()) languages_ = languages(model.assets().assets / "languages");
  std::vector<std::string> shown, codes;
  for (const Language& language : languages_) {
    shown.push_back(language.name);
    codes.push_back(language.code);
  }
  std::string code = w.language();
  if (!shown.empty() && name_choice(ui, "language", w("Language"), shown, codes, code)) {
    model.choose_language(code);
  }
  std::string percent = std::to_string(static_cast<int>(100 * model.scale() + 0.5));
  const std::vector<std::string> percents{"100", "125", "150", "175", "200"};
  if (name_choice(ui, "scale", w("Size of text"), {"100 %", "125 %", "150 %", "175 %", "200 %"}, percents, percent)) {
    model.choose_scale(std::stod(percent) / 100);
  }
  std::string scope = model.scope();
  if (name_choice(ui, "scope", w("Scope"), {w("0 degrees"), w("30 degrees")}, {"0", "30"}, scope))
    model.choose_scope(scope);
  ui.explain(w("The light post of a 30 degree scope turns where it looks; the camera head keeps the horizon."));
  changed |= name_choice(ui, "preset", w("Picture"), {w("Chosen by speed"), w("Plain"), w("Soft"), w("Full")},
                         {"auto", "low", "soft", "full"}, s.preset);
  const std::string pin = w("Whoever has a PIN is asked for it. Only settings.toml turns it off: ask_pin = false.");
  if (s.ask_pin) {
    ui.marked(Mark::kLock, pin);
  } else {
    changed |= ui.toggle("pin", w("Ask for the PIN at sign-in"), s.ask_pin);
    ui.explain(pin);
  }
  changed |= ui.toggle("sound", w("Sound"), s.sound);
  if (!model.sound().refusal().empty()) ui.text(w.made(model.sound().refusal()), Ink::kDim);
  if (changed) model.settings_changed();
}

void SettingsScreen::hand(Ui& ui, PracticeModel& model) {
  const Translator& w = model.words();
  Settings& s = model.settings();
  bool changed = name_choice(ui, "input", w("Steered by"),
                             {w("What moves first"), w("Mouse"), w("Gamepad"), w("SpaceMouse"), w("Device")},
                             {"auto", "mouse", "gamepad", "spacemouse", "device"}, s.input);
  changed |= ui.slider("sensitivity", w("Sensitivity"), s.sensitivity, 0.25, 4, 2);
  changed |= ui.toggle("left", w("Left-handed"), s.left_handed);
  ui.explain(w("Mirrors wrist and panels."));
  changed |= ui.toggle("fulcrum", w("Inverted, as through a port"), s.like_a_fulcrum);
  ui.explain(w("The tip moves against the hand, as an instrument in a real port does."));
  if (changed) model.settings_changed();
}

void SettingsScreen::keys(Ui& ui, PracticeModel& model) {
  const Translator& w = model.words();
  ui.heading(w("Keys"));
  if (!wrong_.empty()) ui.marked(Mark::kWarning, wrong_, Ink::kAlarm);
  for (const ActionName& action : action_names()) {
    const bool waits = waiting_for_ == action.action;
    const std::string right = waits ? w("press a key") : w.name(key_name(model.keys().key_of(action.action)));
    if (ui.selectable(action.name, waits ? Mark::kPlay : Mark::kNone, w(action.words), waits, right)) {
      waiting_for_ = action.action;
      wrong_.clear();
    }
  }
  ui.gap(4);
  if (ui.button("defaults", w("Usual keys"))) {
    model.settings().keys.clear();
    model.settings_changed();
  }
}

std::optional<ScreenName> SettingsScreen::handle(const InputEvent& event, PracticeModel& model) {
  if (!waiting_for_ || event.kind != InputEvent::Kind::kKeyDown || event.repeat) return {};
  const Action action = *waiting_for_;
  took_key_ = true;
  waiting_for_.reset();
  if (event.key == kKeyEscape) return {};
  try {
    KeyMap map = model.keys();
    map.assign(action, event.key);
    model.settings().keys = map.changes();
    model.settings_changed();
  } catch (const InputError& error) {
    wrong_ = error.what();
  }
  return {};
}

std::optional<ScreenName> SettingsScreen::frame(Ui& ui, PracticeModel& model, double /*dt_s*/) {
  const Translator& w = model.words();
  if (waiting_for_) ui.keys_to_screen();
  std::optional<ScreenName> to;
  const double margin = std::min(ui.px(24), 0.02 * ui.width()), gap = ui.px(12);
  const double wide = ui.width() - 2 * margin, high = ui.height() - 2 * margin, foot = ui.strip_height(1);
  const bool beside = wide >= ui.px(860);
  const double left = beside ? 0.5 * (wide - gap) : wide, upper = high - foot - gap;
  ui.begin_panel("settings", {margin, margin, left, upper});
  ui.title(w("Settings"));
  general(ui, model);
  ui.gap(6);
  ui.heading(w("Hand"));
  hand(ui, model);
  if (beside) {
    ui.end_panel();
    ui.begin_panel("settings.keys", {margin + left + gap, margin, left, upper});
  } else {
    ui.gap(6);
  }
  keys(ui, model);
  ui.end_panel();
  ui.begin_strip("settings.foot", {margin, margin + high - foot, wide, foot});
  if (ui.button("done", w("Done"), "Esc", true) && !took_key_) to = ScreenName::kBack;
  took_key_ = false;
  ui.end_panel();
  return to;
}

}  // namespace trocar
