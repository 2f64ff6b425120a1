// Dear ImGui on an OpenGL context: one frame's begin and end, fonts of the chosen scale, input from a window or from a
// script.
//
// ImGui's input is the events given to begin(), whether a window or a script made them: one path, so that headless
// frames run the same code. The old key-map interface of ImGui 1.86 is wrapped here and nowhere else. Thread: the one
// on which the context is current.
#pragma once

#include <memory>
#include <vector>

#include "app/picture/gl/graphics_context.h"
#include "app/window/input/input_event.h"

namespace trocar {

class UiLayer {
 public:
  /// @throws EnvironmentError when the font is missing.
  UiLayer(GraphicsContext& context, double scale);
  ~UiLayer();
  void set_scale(double scale);  ///< 1 to 2: a font atlas a scale
  /// @param events as a person's; ImGui sees them first.
  void begin(int width, int height, double dt_s, const std::vector<InputEvent>& events);
  /// Whether ImGui wants the pointer, or the keys, now: then no screen gets these events.
  bool wants_pointer() const;
  bool wants_keys() const;
  bool popup_open() const;  ///< a list is down: Esc closes it
  /// Draws into the framebuffer that is bound.
  void end();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
