// How much of the picture a machine can afford: three presets, and the choice among them by timing.
//
//   potato  half size, plain Phong, round field; no shadow, no glow
//   soft    half size, thinner meshes, shadow map of 512; the camera's work at the small size
//   full    full size, shadow map of 1024, finest meshes, more taps
// Each is a set of program variants (#define), never a branch at run time: software rasterisers run both sides of a branch.
// Thread: that of the context for measure_preset(), any for the rest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "app/graphics/graphics_context.h"

namespace trocar {

enum class Preset : std::uint8_t { kPotato, kSoft, kFull };

struct PresetTraits {
  std::string define;              ///< of the shaders: "PRESET_FULL"
  double scale = 1;                ///< of the 3-D picture relative to its window
  int shadow_px = 0;               ///< edge of the shadow map; 0: no shadow
  bool glow = false;
  std::size_t organ_triangles = 0, neighbour_triangles = 0;  ///< at most, each
};
const PresetTraits& traits_of(Preset preset);

std::string preset_name(Preset preset);
/// Empty for a name that is none.
std::optional<Preset> preset_named(const std::string& name);

/// The richest preset that is quick enough; potato when none is. Tries from `first` downwards and times each once.
/// @param frame_s seconds of one picture. @param wanted_s at most.
Preset choose_preset(Preset first, double wanted_s, const std::function<double(Preset)>& frame_s);

/// choose_preset() by drawing pictures of the show scene: ten each, fewer when a preset is clearly too slow. A software rasteriser is
/// not tried at full, which would cost it a second. @param width,height px of the scope's picture.
/// @throws EnvironmentError when a shader is missing or refused.
Preset measure_preset(GraphicsContext& context, const std::filesystem::path& asset_root, int width, int height);

}  // namespace trocar
