// The window's sounds as formulas: notes of few partials under a soft envelope.
//
//   s(t) = sum over notes of level e(t) (sin w t + a sin 2 w t + b sin 3 w t) / (1 + a + b)
//   e(t) = raised cosine at both ends (8 ms up, a third of the note down): no click
// Nothing is louder than 0.7 or higher than 4 kHz. Tones that last are loops of one second made of whole periods.
// Hz, s. Thread: any.
#pragma once

#include <cstdint>
#include <vector>

namespace trocar {

enum class Tone : std::uint8_t { kTouch, kRelease, kGood, kTooMuch, kWarning, kFault, kDone };
inline constexpr int kTones = 7;

/// Samples of a tone, mono, -1..1, at `rate_hz`: what the tests listen to.
std::vector<float> tone_samples(Tone tone, double rate_hz);

enum class HeldTone : std::uint8_t { kForce, kCautery };
inline constexpr int kHeldTones = 2;

/// One second that can be repeated without a seam.
std::vector<float> held_samples(HeldTone tone, double rate_hz);

/// Loudness of the next picture: a third of the way to what is wanted, nothing below a thousandth.
double smoothed_gain(double now, double wanted);

}  // namespace trocar
