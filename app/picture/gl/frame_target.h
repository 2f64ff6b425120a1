// Where finished frames are put together: the scope's texture, dimmed or not, then whatever draws over it; a window's
// own framebuffer or one in memory.
//
// Pixels, y down from the top left corner. Thread: the one on which the context is current.
#pragma once

#include "app/picture/gl/graphics_context.h"
#include "app/picture/gl/image.h"
#include "app/picture/scene/scope_optics.h"

#include <memory>

namespace trocar {

class FrameTarget {
 public:
  /// @param to_window draw() goes to the window's framebuffer; else to one in memory.
  FrameTarget(GraphicsContext& context, bool to_window);
  ~FrameTarget();
  /// Binds and clears to black, the scope's field. @param width,height px, at least 64 x 48; may change from frame to
  /// frame.
  void begin(int width, int height);
  /// Puts a texture (lowest row first) into a part. @param dim 0 as it is .. 1 black.
  void place(unsigned texture, const PixelRect& part, double dim);
  /// What has been drawn so far.
  Image read() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
