#include "app/window/sound/tones.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

struct Note {
  double start_s, length_s, hz, level;
  double second = 0, third = 0;  ///< shares of the partials
};

/// Pitches are those of the tempered scale: A4 = 440 Hz.
std::vector<Note> notes(Tone tone) {
  switch (tone) {
    case Tone::kTouch:
      return {{0, 0.07, 659.26, 0.35}};
    case Tone::kRelease:
      return {{0, 0.07, 440, 0.30}};
    case Tone::kGood:
      return {{0, 0.11, 659.26, 0.45}, {0.10, 0.18, 880, 0.45}};
    case Tone::kTooMuch:
      return {{0, 0.12, 233.08, 0.6, 0.5, 0.4}, {0.16, 0.16, 233.08, 0.6, 0.5, 0.4}};
    case Tone::kWarning:
      return {{0, 0.14, 523.25, 0.5, 0.3}, {0.20, 0.14, 523.25, 0.5, 0.3}};
    case Tone::kFault:
      return {{0, 0.22, 392, 0.6, 0.4, 0.3}, {0.22, 0.22, 311.13, 0.6, 0.4, 0.3}, {0.44, 0.34, 196, 0.6, 0.4, 0.3}};
    case Tone::kDone:
      return {
          {0, 0.14, 523.25, 0.45}, {0.13, 0.14, 659.26, 0.45}, {0.26, 0.14, 783.99, 0.45}, {0.39, 0.36, 1046.5, 0.45}};
  }
  return {};
}

/// 0 at both ends, and flat there.
double envelope(double t_s, double length_s) {
  const auto rise = [](double share) { return 0.5 - 0.5 * std::cos(std::numbers::pi * std::clamp(share, 0.0, 1.0)); };
  return rise(t_s / 0.008) * rise((length_s - t_s) / (length_s / 3));
}

double wave(double turns, double second, double third) {
  const double w = 2 * std::numbers::pi * turns;
  return (std::sin(w) + second * std::sin(2 * w) + third * std::sin(3 * w)) / (1 + second + third);
}

}  // namespace

std::vector<float> tone_samples(Tone tone, double rate_hz) {
  const std::vector<Note> all = notes(tone);
  double end_s = 0;
  for (const Note& note : all) end_s = std::max(end_s, note.start_s + note.length_s);
  std::vector<float> out(static_cast<std::size_t>(std::ceil(end_s * rate_hz)) + 1);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double t = static_cast<double>(i) / rate_hz;
    double sum = 0;
    for (const Note& note : all) {
      const double since = t - note.start_s;
      if (since > 0 && since < note.length_s)
        sum += note.level * envelope(since, note.length_s) * wave(note.hz * since, note.second, note.third);
    }
    out[i] = static_cast<float>(sum);
  }
  return out;
}

std::vector<float> held_samples(HeldTone tone, double rate_hz) {
  std::vector<float> out(static_cast<std::size_t>(std::lround(rate_hz)));
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(out.size());  // whole hertz close after one second
    const double force = 0.4 * wave(294 * t, 0.3, 0.1);
    const double cautery = 0.4 * (0.7 + 0.3 * std::cos(2 * std::numbers::pi * 24 * t)) * wave(750 * t, 0, 0.25);
    out[i] = static_cast<float>(tone == HeldTone::kForce ? force : cautery);
  }
  return out;
}

double smoothed_gain(double now, double wanted) {
  const double next = now + (std::clamp(wanted, 0.0, 1.0) - now) / 3;
  return next < 1e-3 && wanted <= 0 ? 0 : next;
}

}  // namespace trocar
