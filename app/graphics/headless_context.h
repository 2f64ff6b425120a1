// An OpenGL context without a window, through EGL.
//
// Order tried: hardware devices (EGL_EXT_platform_device), Mesa's surfaceless platform, software devices. Asks for
// GL 4.1 core, then 3.3 core. There is no default framebuffer: whoever draws brings a framebuffer of its own.
// Thread: current on one thread at a time; make_current() moves it.
#pragma once

#include <string>

namespace trocar {

struct ContextInfo {
  std::string platform;   ///< "device 0", "surfaceless"
  std::string renderer;   ///< GL_RENDERER, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string version;    ///< GL_VERSION
  bool software = false;  ///< drawn by the CPU
};

class HeadlessContext {
 public:
  /// Creates the context and makes it current on this thread.
  /// @throws EnvironmentError saying what was tried and which package is missing.
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

  /// @throws EnvironmentError when another thread holds it.
  void make_current();
  const ContextInfo& info() const { return info_; }

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
