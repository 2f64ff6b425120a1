// Sounds of the window: contact, warnings, cautery. Never required: without a device everything is silent, and every sound has a
// twin on the screen.
//
// Sounds are made by formulas, not from files. Thread: the window's; the library plays in its own.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace trocar {

enum class Tone : std::uint8_t { kTouch, kRelease, kGood, kTooMuch, kWarning, kFault, kDone };

class Sound {
 public:
  /// @param wanted false: silent. Without a device it is silent too, and refusal() says why.
  explicit Sound(bool wanted);
  ~Sound();
  void play(Tone tone);
  /// A tone that lasts while the level is above 0: force over its band (0..1), cautery (0..1).
  void hold_force(double level);
  void hold_cautery(double level);
  bool audible() const;
  const std::string& refusal() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Samples of a tone, mono, -1..1, at `rate_hz`: what the tests listen to.
std::vector<float> tone_samples(Tone tone, double rate_hz);

}  // namespace trocar
