// An OpenGL context without a window, through EGL.
//
// Order tried: hardware devices (EGL_EXT_platform_device), Mesa's surfaceless platform, software devices. Asks for
// GL 4.1 core, then 3.3 core. There is no default framebuffer: whoever draws brings a framebuffer of its own.
// Thread: current on one thread at a time; make_current() moves it.
#pragma once

#include <string>

#include "app/picture/gl/graphics_context.h"

namespace trocar {

class HeadlessContext final : public GraphicsContext {
 public:
  /// Creates the context and makes it current on this thread.
  /// @throws EnvironmentError saying what was tried and which package is missing.
  HeadlessContext();
  ~HeadlessContext() override;
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

  /// @throws EnvironmentError when another thread holds it.
  void make_current() override;
  const ContextInfo& info() const override { return info_; }

 private:
  bool try_display(void* display, const std::string& platform);
  void fill_info(const std::string& platform);

  void* display_ = nullptr;  // EGLDisplay
  void* context_ = nullptr;  // EGLContext
  void* surface_ = nullptr;  // EGLSurface, only where surfaceless contexts are refused
  std::string attempts_;
  ContextInfo info_;
};

}  // namespace trocar
