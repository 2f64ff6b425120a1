// The help's page of sounds: what each stands for; chosen, it is heard. Thread: the window's.
#pragma once

#include <optional>

#include "app/window/practice/practice_model.h"
#include "app/window/ui/ui.h"

namespace trocar {

class SoundPage {
 public:
  static constexpr double kHeld_s = 1.5;  ///< that a tone which lasts is let sound

  void frame(Ui& ui, PracticeModel& model);
  /// With every picture, whether the page is up or not: what lasts comes to its end. @param up the page is seen.
  void pass(Sound& sound, bool up, double dt_s);

 private:
  std::optional<HeldTone> held_;
  double left_s_ = 0;
};

}  // namespace trocar
