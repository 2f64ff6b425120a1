// Draws a SceneView to an image: the scope's picture through OpenGL, the head-up display on top by the CPU.
//
// Passes: lamp's shadow map, organ and surroundings, target decals, instrument, glow, camera (post). Same scene, same
// size, same driver: same bytes. Frame T, metres. Thread: the one on which the context is current.
#pragma once

#include <filesystem>
#include <memory>

#include "app/graphics/graphics_context.h"
#include "app/graphics/image.h"
#include "app/graphics/scene_view.h"

namespace trocar {

struct RenderOptions {
  double text_scale = 1;  ///< 1 to 2
  double scene_scale =
      1;              ///< resolution of the 3-D picture relative to its window, 0.4 to 1; below 1 is the soft preset
  bool grain = true;  ///< sensor grain; off for picture tests
};

class Renderer {
 public:
  /// @param asset_root folder that holds shaders/.
  /// @throws EnvironmentError when a shader or the font is missing or refused.
  Renderer(GraphicsContext& context, const std::filesystem::path& asset_root, const RenderOptions& options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;

  /// Scope picture and head-up display. A view whose `hud` is empty fills the whole image with the scope's picture.
  /// @param width,height px, at least 320 x 240.
  /// @throws std::invalid_argument for a smaller image or non-finite camera.
  Image render(const SceneView& view, int width, int height);

  /// The scope's picture alone, left on the GPU: for a window, whose screens draw round and over it.
  /// @param width,height px, at least 64 x 48. @return GL name of an RGBA8 texture, lowest row first, kept until the next call.
  unsigned draw_scope(const SceneView& view, int width, int height);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trocar
