// Sounds of the window: contact, warnings, cautery. Never required: without a device everything is silent, and every
// sound has a twin on the screen (docs/trainee_guide.md lists them).
//
// Sounds are made by formulas (tones.h), not from files. Thread: the window's; the library plays in its own.
#pragma once

#include <memory>
#include <string>

#include "app/window/sound/tones.h"

namespace trocar {

class Sound {
 public:
  /// @param wanted false: silent. Without a device it is silent too, and refusal() says why.
  explicit Sound(bool wanted);
  ~Sound();
  void play(Tone tone);
  /// A tone that lasts while the level is above 0: force over its band (0..1), cautery (0..1). Say it with every
  /// picture: it comes and goes within some of them.
  void hold_force(double level);
  void hold_cautery(double level);
  bool audible() const;
  /// Why it is silent though it was wanted; empty otherwise.
  const std::string& refusal() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
