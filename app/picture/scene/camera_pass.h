// From the lit scene to the picture on the monitor: smoke in the way, glow round glints, what lies on the lens, barrel,
// sharpening, tone curve, vignette, round field with notch and level tick, grain.
//
// Smoke: light left is exp(-k s), s the path through an uneven fog (0.35 + 1.3 noise); what is scattered in is lit by
// the lamp. Lens: fog is a blurred, paled picture; blood a red blot; a wipe clears both from one side. Thread: that of
// the context.
#pragma once

#include <string>
#include <vector>

#include "app/picture/gl/render_surfaces.h"
#include "app/picture/scene/object_painter.h"
#include "app/picture/scene/preset.h"
#include "app/picture/scene/scene_view.h"
#include "app/picture/scene/scope_optics.h"

namespace trocar {

class CameraPass {
 public:
  /// @param width,height px of the picture. @param scale of the scene to it.
  void resize(int width, int height, double scale);
  const RenderSurface& scene() const { return scene_; }
  const RenderSurface& picture() const { return picture_; }
  /// Binds textures to units from `first_unit` on. @param screen an empty vertex array.
  void draw(const ProgramBinder& bind, const SceneView& view, const ScopeOptics& optics, const PixelRect& window,
            bool grain, const PresetTraits& traits, unsigned screen);

 private:
  void blur(const ProgramBinder& bind, const RenderSurface& to, const RenderSurface& spare, const char* source);
  void step(Program& post, const SceneView& view, const ScopeOptics& optics, const PixelRect& window,
            const RenderSurface& from, const RenderSurface& to);
  std::vector<std::string> lens_defines(const SceneView& view) const;
  RenderSurface scene_, glow_, veil_, spare_, small_, picture_;
};

}  // namespace trocar
