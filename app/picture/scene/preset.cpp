#include "app/picture/scene/preset.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "app/picture/models/show_scene.h"
#include "app/picture/scene/renderer.h"

namespace trocar {
namespace {

constexpr double kWanted_s = 1.0 / 12;  // of the show scene, 18 organs: the exercises cost half of it
constexpr int kFrames = 10;
constexpr std::array<Preset, 3> kAll = {Preset::kLow, Preset::kSoft, Preset::kFull};

/// From rich to plain.
constexpr std::array<PictureThrift::Step, 7> kSteps = {{{Preset::kFull, 1},
                                                        {Preset::kSoft, 1},
                                                        {Preset::kSoft, 0.8},
                                                        {Preset::kSoft, 0.65},
                                                        {Preset::kLow, 0.65},
                                                        {Preset::kLow, 0.5},
                                                        {Preset::kLow, 0.4}}};

/// The step at which a preset stands at its own size, or nearest to it.
std::size_t step_of(Preset preset) {
  return static_cast<std::size_t>(
      std::find_if(kSteps.begin(), kSteps.end(), [&](const auto& step) { return step.preset == preset; }) -
      kSteps.begin());
}

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
  static const std::array<PresetTraits, 3> kTraits = {{{"PRESET_LOW", 0.5, 256, false, 12000, 4000},
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

PictureThrift::PictureThrift(Preset first, Preset richest) : at_(step_of(first)), top_(step_of(richest)) {
  at_ = std::max(at_, top_);
}

const PictureThrift::Step& PictureThrift::now() const { return kSteps[at_]; }

void PictureThrift::go(int by) {
  at_ = static_cast<std::size_t>(static_cast<int>(at_) + by);
  count_ = 0;
  quiet_s_ = 0;
}

bool PictureThrift::picture(double dt_s) {
  if (dt_s > kStandstill_s) return false;
  times_[static_cast<std::size_t>(count_++)] = dt_s;
  quiet_s_ += dt_s;
  if (count_ < kLook) return false;
  std::array<double, kLook> sorted = times_;
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[kLook / 2];
  count_ = 0;
  if (median > kQuick_s) quiet_s_ = 0;
  if (median > kSlow_s && at_ + 1 < kSteps.size()) {
    if (std::exchange(climbed_, false)) wait_s_ = std::min(2 * wait_s_, kLongestWait_s);
    go(median > 2 * kSlow_s && at_ + 2 < kSteps.size() ? 2 : 1);
    return true;
  }
  if (quiet_s_ < wait_s_ || at_ == top_) return false;
  climbed_ = true;
  go(-1);
  return true;
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
