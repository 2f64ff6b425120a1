#include "app/picture/scene/preset.h"

#include <array>
#include <chrono>

#include "app/picture/models/show_scene.h"
#include "app/picture/scene/renderer.h"

namespace trocar {
namespace {

constexpr double kWanted_s = 1.0 / 12;  // of the show scene, 18 organs: the exercises cost half of it
constexpr int kFrames = 10;
constexpr std::array<Preset, 3> kAll = {Preset::kLow, Preset::kSoft, Preset::kFull};

/// Mean time of a picture; stops early when `enough_s` have gone.
double mean_frame_s(Renderer& renderer, SceneView view, int width, int height, double enough_s) {
  using Clock = std::chrono::steady_clock;
  renderer.draw_scope(view, width, height);  // compiles the shaders
  renderer.finish();
  const auto start = Clock::now();
  for (int i = 1; i <= kFrames; ++i) {
    view.X_TI.p.x() += 1e-4;
    renderer.draw_scope(view, width, height);
    renderer.finish();
    const double gone_s = std::chrono::duration<double>(Clock::now() - start).count();
    if (i == kFrames || gone_s > enough_s) return gone_s / i;
  }
  return 0;
}

}  // namespace

const PresetTraits& traits_of(Preset preset) {
  static const std::array<PresetTraits, 3> kTraits = {{{"PRESET_LOW", 0.5, 0, false, 12000, 4000},
                                                       {"PRESET_SOFT", 0.5, 512, true, 20000, 6000},
                                                       {"PRESET_FULL", 1.0, 1024, true, 60000, 16000}}};
  return kTraits[static_cast<std::size_t>(preset)];
}

std::string preset_name(Preset preset) {
  static const std::array<std::string, 3> kNames = {"low", "soft", "full"};
  return kNames[static_cast<std::size_t>(preset)];
}

std::optional<Preset> preset_named(const std::string& name) {
  for (const Preset preset : kAll)
    if (preset_name(preset) == name) return preset;
  return std::nullopt;
}

Preset choose_preset(Preset first, double wanted_s, const std::function<double(Preset)>& frame_s) {
  for (auto i = static_cast<std::size_t>(first); i > 0; --i)
    if (frame_s(kAll[i]) <= wanted_s) return kAll[i];
  return Preset::kLow;
}

std::optional<Preset> PresetWatch::picture(double dt_s, Preset now) {
  if (dt_s > kStandstill_s) return std::nullopt;
  slow_ = dt_s > kTooSlow_s && now != Preset::kLow ? slow_ + 1 : 0;
  if (slow_ < kInARow) return std::nullopt;
  slow_ = 0;
  return kAll[static_cast<std::size_t>(now) - 1];
}

Preset measure_preset(Renderer& renderer, Preset first, const SceneView& view, int width, int height) {
  return choose_preset(first, kWanted_s, [&](Preset preset) {
    RenderOptions options = renderer.options();
    options.preset = preset;
    renderer.set_options(options);
    return mean_frame_s(renderer, view, width, height, kFrames * kWanted_s);
  });
}

Preset measure_preset(GraphicsContext& context, const std::filesystem::path& asset_root, int width, int height) {
  Renderer renderer(context, asset_root);
  return measure_preset(renderer, context.info().software ? Preset::kSoft : Preset::kFull, show_scene("abdomen"), width,
                        height);
}

}  // namespace trocar
