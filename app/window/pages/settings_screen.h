// The settings: language, size, hand, input, picture, sound, and which key does what.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/window/input/key_map.h"
#include "app/window/practice/screen.h"
#include "app/window/words/translator.h"

namespace trocar {

class SettingsScreen final : public Screen {
 public:
  std::optional<ScreenName> frame(Ui& ui, PracticeModel& model, double dt_s) override;
  std::optional<ScreenName> handle(const InputEvent& event, PracticeModel& model) override;
  bool takes_escape() const override { return true; }
  bool takes_all() const override { return waiting_for_.has_value(); }

 private:
  void general(Ui& ui, PracticeModel& model);
  void hand(Ui& ui, PracticeModel& model);
  void keys(Ui& ui, PracticeModel& model);

  std::optional<Action> waiting_for_;  ///< the next key is this action's
  bool took_key_ = false;              ///< the key of this frame was chosen for an action: it means nothing else
  std::string wrong_;
  std::vector<Language> languages_;
};

}  // namespace trocar
