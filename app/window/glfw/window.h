// A window with an OpenGL context on EGL (GLFW), and what people do in it as InputEvents.
//
// The context is EGL's, never GLX's: the two do not mix in one process. Thread: the main one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/picture/gl/graphics_context.h"
#include "app/window/input/input_event.h"

namespace trocar {

struct WindowOptions {
  std::string title = "Trocar";
  int width = 1280, height = 720;  ///< px
  bool fullscreen = false;
  bool visible = true;
};

class Window final : public GraphicsContext {
 public:
  /// @throws EnvironmentError: no display, no EGL, no OpenGL 3.3; says what is missing and what works without a window.
  explicit Window(const WindowOptions& options);
  ~Window() override;

  void make_current() override;
  const ContextInfo& info() const override;

  /// Events since the last call, in order; pads and SpaceMice are sampled here. Also feeds the ImGui layer
  /// (ui_layer.h).
  std::vector<InputEvent> poll();
  bool close_asked() const;
  void stay_open();   ///< what was asked is not done
  int width() const;  ///< px of the framebuffer
  int height() const;
  /// The driver was reset and everything in the context is gone: make another window.
  bool lost() const;
  void present();  ///< swaps buffers, waits for the screen when it gives a beat
  void set_title(const std::string& title);
  void set_fullscreen(bool fullscreen);
  /// Hides the pointer and lets it move without an end, or gives it back where it was.
  void hold_pointer(bool held);
  void* native() const;  ///< GLFWwindow*

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
