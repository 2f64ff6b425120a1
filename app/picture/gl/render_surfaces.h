// The renderer's own framebuffers: scene (half-float colour and depth), glow, shadow map, final picture.
//
// A headless context has no default framebuffer, so everything is drawn to these. Thread: that of the context.
#pragma once

#include "app/picture/gl/gl_objects.h"

namespace trocar {

/// A framebuffer with one texture (colour or depth) and, for the scene, a depth texture beside it.
struct RenderSurface {
  enum class Use { kSceneColour, kGlow, kShadow, kPicture };

  RenderSurface() = default;
  /// @throws EnvironmentError when the driver refuses the format.
  RenderSurface(Use use, int width, int height);
  /// Binds for drawing and sets the viewport.
  void begin() const;

  GlObject framebuffer, texture, depth;
  int width = 0, height = 0;  ///< px
};

}  // namespace trocar
