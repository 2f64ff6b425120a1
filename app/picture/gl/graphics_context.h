// An OpenGL context, whatever it draws to: none (HeadlessContext) or a window (app/window/glfw/window.h).
//
// Thread: current on one thread at a time; make_current() moves it.
#pragma once

#include <string>

namespace trocar {

struct ContextInfo {
  std::string platform;   ///< "device 0", "surfaceless", "window"
  std::string renderer;   ///< GL_RENDERER, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string version;    ///< GL_VERSION
  bool software = false;  ///< drawn by the CPU
};

class GraphicsContext {
 public:
  virtual ~GraphicsContext() = default;
  /// @throws EnvironmentError when another thread holds it.
  virtual void make_current() = 0;
  virtual const ContextInfo& info() const = 0;
};

}  // namespace trocar
