// How much of the picture a machine can afford: three presets, and the choice among them by timing.
//
//   low  half size, plain Phong, shadow map of 256, round field; no glow
//   soft    half size, thinner meshes, shadow map of 512; the camera's work at the small size
//   full    full size, shadow map of 1024, finest meshes, more taps
// Depth is read from shadows, so every preset has them. Each is a set of program variants (#define), never a branch at
// run time: software rasterisers run both sides of a branch. Thread: that of the context for measure_preset(), any for
// the rest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "app/picture/gl/graphics_context.h"

namespace trocar {

class Renderer;
struct SceneView;

enum class Preset : std::uint8_t { kLow, kSoft, kFull };

struct PresetTraits {
  std::string define;  ///< of the shaders: "PRESET_FULL"
  double scale = 1;    ///< of the 3-D picture relative to its window
  int shadow_px = 0;   ///< edge of the shadow map
  bool glow = false;
  std::size_t organ_triangles = 0, adjacent_triangles = 0;  ///< at most, each
};
const PresetTraits& traits_of(Preset preset);

std::string preset_name(Preset preset);
/// Empty for a name that is none.
std::optional<Preset> preset_named(const std::string& name);

/// The richest preset that is quick enough; low when none is. Tries from `first` downwards and times each once.
/// @param frame_s seconds of one picture. @param wanted_s at most.
Preset choose_preset(Preset first, double wanted_s, const std::function<double(Preset)>& frame_s);

/// Draws less where pictures come too slowly, and more again where there is time: for a machine that others use too.
///
/// First the size of the scope's picture gives way, then glow and fine texture, then size again; never a shadow. It
/// goes down at once and up only after a quiet while, which doubles with every time that it was wrong: no flicker.
class PictureThrift {
 public:
  struct Step {
    Preset preset;
    double size;  ///< of the scope's picture relative to its window
  };
  static constexpr double kSlow_s = 1.0 / 21, kQuick_s = 1.0 / 45, kStandstill_s = 1.0;
  static constexpr double kFirstWait_s = 8, kLongestWait_s = 240;
  static constexpr int kLook = 15;  ///< pictures that a change is decided by

  /// @param first from which it begins. @param richest it climbs to.
  PictureThrift(Preset first, Preset richest);
  const Step& now() const;
  /// @param dt_s since the last picture; a standstill (a hidden window, a machine that slept) says nothing.
  /// @return whether now() is another one.
  bool picture(double dt_s);

 private:
  void go(int by);

  std::size_t at_, top_;
  std::array<double, kLook> times_{};
  int count_ = 0;
  bool climbed_ = false;  ///< the last change was one up
  double quiet_s_ = 0, wait_s_ = kFirstWait_s;
};

/// choose_preset() by drawing pictures of a scene: ten each, fewer when a preset is clearly too slow. A software
/// rasteriser is not tried at full, which would cost it a second. The renderer's preset is left as it was tried last.
/// @param width,height px of the scope's picture.
/// @throws EnvironmentError when a shader is missing or refused.
Preset measure_preset(Renderer& renderer, Preset first, const SceneView& view, int width, int height);
/// The same with a renderer and a scene of its own.
Preset measure_preset(GraphicsContext& context, const std::filesystem::path& asset_root, int width, int height);

}  // namespace trocar
