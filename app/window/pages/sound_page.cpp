#include "app/window/pages/sound_page.h"

#include <algorithm>
#include <variant>
#include <vector>

namespace trocar {
namespace {

constexpr double kLevel = 0.7;
constexpr double kFading_s = 0.5;  // after its end, until it is surely silent

struct Row {
  const char* id;
  std::variant<Tone, HeldTone> tone;
  std::string sound, when;
};

std::vector<Row> rows(const Translator& w) {
  return {{"touch", Tone::kTouch, w("Short high note"), w("The tip touches.")},
          {"release", Tone::kRelease, w("Short low note"), w("The tip lets go.")},
          {"good", Tone::kGood, w("Two rising notes"), w("A disc, pen or block is done.")},
          {"too-much", Tone::kTooMuch, w("Low double buzz"), w("Too much force, or a wrong place.")},
          {"warning", Tone::kWarning, w("Two equal notes"),
           w("A force passes the end of its band, the port holds the instrument back, or a time ran out.")},
          {"fault", Tone::kFault, w("Three falling notes"), w("The device has a fault; the run stops.")},
          {"done", Tone::kDone, w("Four rising notes"), w("The run is over.")},
          {"force", HeldTone::kForce, w("Hum that rises"), w("The force is over its band, up to the limit.")},
          {"cautery", HeldTone::kCautery, w("Buzz"), w("Current flows into tissue.")}};
}

void hold(Sound& sound, HeldTone tone, double level) {
  if (tone == HeldTone::kForce)
    sound.hold_force(level);
  else
    sound.hold_cautery(level);
}

}  // namespace

void SoundPage::frame(Ui& ui, PracticeModel& model) {
  const Translator& w = model.words();
  ui.text(w("Nothing is heard that is not seen too. Choose a sound to hear it."), Ink::kDim);
  if (!model.sound().refusal().empty()) ui.marked(Mark::kInfo, w.made(model.sound().refusal()));
  for (const Row& row : rows(w)) {
    const bool chosen = ui.selectable(row.id, Mark::kPlay, row.sound, false);
    ui.text(row.when, Ink::kDim);
    if (!chosen) continue;
    if (const Tone* once = std::get_if<Tone>(&row.tone)) {
      model.sound().play(*once);
    } else {
      if (held_) hold(model.sound(), *held_, 0);
      held_ = std::get<HeldTone>(row.tone);
      left_s_ = kHeld_s;
    }
  }
}

void SoundPage::pass(Sound& sound, bool up, double dt_s) {
  if (!held_) return;
  left_s_ = up ? left_s_ - dt_s : std::min(left_s_, 0.0) - dt_s;
  hold(sound, *held_, left_s_ > 0 ? kLevel : 0);
  if (left_s_ < -kFading_s) held_.reset();
}

}  // namespace trocar
