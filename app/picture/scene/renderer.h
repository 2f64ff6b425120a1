// Draws a SceneView to an image: the scope's picture through OpenGL, the head-up display on top by the CPU.
//
// Passes: lamp's shadow map, instruments, objects, tissue with its marks and targets, then the camera (camera_pass.h).
// Same scene, same size, same preset, same driver: same bytes. Frame T, metres. Thread: the one on which the context is
// current.
#pragma once

#include <filesystem>
#include <memory>

#include "app/picture/gl/graphics_context.h"
#include "app/picture/gl/image.h"
#include "app/picture/scene/preset.h"
#include "app/picture/scene/scene_view.h"

namespace trocar {

struct RenderOptions {
  double text_scale = 1;   ///< 1 to 2
  double scene_scale = 1;  ///< resolution of the 3-D picture relative to what the preset asks for, 0.4 to 1
  bool grain = true;       ///< sensor grain; off for picture tests
  Preset preset = Preset::kFull;
};

class Renderer {
 public:
  /// @param asset_root folder that holds shaders/.
  /// @throws EnvironmentError when a shader or the font is missing or refused.
  Renderer(GraphicsContext& context, const std::filesystem::path& asset_root, const RenderOptions& options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;

  /// From the next picture on; a change of preset builds programs and meshes anew.
  void set_options(const RenderOptions& options);
  const RenderOptions& options() const;

  /// Scope picture and head-up display. A view whose `hud` is empty fills the whole image with the scope's picture.
  /// @param width,height px, at least 320 x 240.
  /// @throws std::invalid_argument for a smaller image or non-finite camera.
  Image render(const SceneView& view, int width, int height);

  /// The scope's picture alone, left on the GPU: for a window, whose screens draw round and over it.
  /// @param width,height px, at least 64 x 48. @return GL name of an RGBA8 texture, lowest row first, kept until the
  /// next call.
  unsigned draw_scope(const SceneView& view, int width, int height);

  /// Waits until the last picture is finished: for timing.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trocar
