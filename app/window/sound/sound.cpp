#include "app/window/sound/sound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <AL/al.h>
#include <AL/alc.h>

namespace trocar {
namespace {

constexpr int kRate_hz = 44100;
constexpr std::size_t kVoices = 4;  // tones that may sound at once; the oldest gives way

std::vector<std::int16_t> as_integers(const std::vector<float>& samples) {
  std::vector<std::int16_t> out(samples.size());
  std::transform(samples.begin(), samples.end(), out.begin(),
                 [](float s) { return static_cast<std::int16_t>(std::lround(32767 * s)); });
  return out;
}

bool set(const char* name) {
  const char* value = std::getenv(name);
  return value && *value;
}

/// Without a card and without a sound server the library below would only fill the terminal with its complaints.
bool anywhere_to_play() {
  std::error_code none;
  if (set("ALSOFT_DRIVERS") || set("PULSE_SERVER") || std::filesystem::exists("/dev/snd", none)) return true;
  const std::filesystem::path run = set("XDG_RUNTIME_DIR") ? std::getenv("XDG_RUNTIME_DIR") : "";
  return !run.empty() &&
         (std::filesystem::exists(run / "pulse/native", none) || std::filesystem::exists(run / "pipewire-0", none));
}

}  // namespace

struct Sound::State {
  std::string refusal = {};
  ALCdevice* device = nullptr;
  ALCcontext* context = nullptr;
  std::array<ALuint, kTones + kHeldTones> buffers{};
  std::array<ALuint, kVoices> voices{};
  std::array<ALuint, kHeldTones> held{};
  std::array<double, kHeldTones> gain{};
  std::size_t next_voice = 0;

  ~State() { close(); }

  void close() {
    if (context) {
      alDeleteSources(static_cast<ALsizei>(voices.size()), voices.data());
      alDeleteSources(static_cast<ALsizei>(held.size()), held.data());
      alDeleteBuffers(static_cast<ALsizei>(buffers.size()), buffers.data());
      alcMakeContextCurrent(nullptr);
      alcDestroyContext(context);
    }
    if (device) alcCloseDevice(device);
    context = nullptr;
    device = nullptr;
  }

  void fill(std::size_t buffer, const std::vector<float>& samples) {
    const std::vector<std::int16_t> data = as_integers(samples);
    alBufferData(buffers[buffer], AL_FORMAT_MONO16, data.data(), static_cast<ALsizei>(data.size() * sizeof data[0]),
                 kRate_hz);
  }

  bool make_sources() {
    alGetError();
    alGenBuffers(static_cast<ALsizei>(buffers.size()), buffers.data());
    alGenSources(static_cast<ALsizei>(voices.size()), voices.data());
    alGenSources(static_cast<ALsizei>(held.size()), held.data());
    for (int i = 0; i < kTones; ++i) fill(static_cast<std::size_t>(i), tone_samples(static_cast<Tone>(i), kRate_hz));
    for (std::size_t i = 0; i < held.size(); ++i) {
      fill(kTones + i, held_samples(static_cast<HeldTone>(i), kRate_hz));
      alSourcei(held[i], AL_BUFFER, static_cast<ALint>(buffers[kTones + i]));
      alSourcei(held[i], AL_LOOPING, AL_TRUE);
    }
    return alGetError() == AL_NO_ERROR;
  }

  void open() {
    device = anywhere_to_play() ? alcOpenDevice(nullptr) : nullptr;
    if (!device) {
      refusal = "No sound: no output device was found. Everything is shown on the screen too.";
      return;
    }
    context = alcCreateContext(device, nullptr);
    if (context && alcMakeContextCurrent(context) && make_sources()) return;
    close();
    refusal = "No sound: the output device cannot be used. Everything is shown on the screen too.";
  }

  void hold(HeldTone tone, double level) {
    if (!context) return;
    const auto i = static_cast<std::size_t>(tone);
    const double before = gain[i];
    gain[i] = smoothed_gain(before, level);
    alSourcef(held[i], AL_GAIN, static_cast<float>(gain[i]));
    if (tone == HeldTone::kForce) alSourcef(held[i], AL_PITCH, static_cast<float>(1 + 0.5 * gain[i]));
    if (before == 0 && gain[i] > 0) alSourcePlay(held[i]);
    if (before > 0 && gain[i] == 0) alSourceStop(held[i]);
  }
};

Sound::Sound(bool wanted) : state_(std::make_unique<State>()) {
  if (wanted) state_->open();
}
Sound::~Sound() = default;

void Sound::play(Tone tone) {
  if (!state_->context) return;
  const ALuint voice = state_->voices[state_->next_voice];
  state_->next_voice = (state_->next_voice + 1) % kVoices;
  alSourceStop(voice);
  alSourcei(voice, AL_BUFFER, static_cast<ALint>(state_->buffers[static_cast<std::size_t>(tone)]));
  alSourcePlay(voice);
}

void Sound::hold_force(double level) { state_->hold(HeldTone::kForce, level); }
void Sound::hold_cautery(double level) { state_->hold(HeldTone::kCautery, level); }
bool Sound::audible() const { return state_->context != nullptr; }
const std::string& Sound::refusal() const { return state_->refusal; }

}  // namespace trocar
