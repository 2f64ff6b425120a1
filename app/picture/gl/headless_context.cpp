#include "app/picture/gl/headless_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <vector>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr const char* kPackages =
    "; install libegl1 libegl-mesa0 libgl1 libgl1-mesa-dri (software) or the GPU vendor's EGL driver";

bool library_present(const char* name) {
  void* handle = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
  if (handle) dlclose(handle);
  return handle != nullptr;
}

// libepoxy ends the process when a library is missing, so it is looked for first.
void require_libraries() {
  if (!library_present("libEGL.so.1"))
    throw EnvironmentError(std::string("no picture: libEGL.so.1 not found") + kPackages);
  if (!library_present("libGL.so.1") && !library_present("libOpenGL.so.0"))
    throw EnvironmentError(std::string("no picture: libGL.so.1 not found") + kPackages);
}

std::string egl_error_text() {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "0x%04x", static_cast<unsigned>(eglGetError()));
  return text.data();
}

struct Device {
  EGLDeviceEXT handle;
  int index;
  bool software;
};

std::vector<Device> list_devices() {
  std::vector<Device> devices;
  const bool enumerable = epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base") ||
                          epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration");
  if (!enumerable || !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) return devices;
  std::array<EGLDeviceEXT, 16> handles{};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(static_cast<EGLint>(handles.size()), handles.data(), &count)) return devices;
  for (int i = 0; i < count; ++i) {
    const EGLDeviceEXT handle = handles[static_cast<std::size_t>(i)];
    const char* extensions = eglQueryDeviceStringEXT(handle, EGL_EXTENSIONS);
    devices.push_back({handle, i, extensions && std::strstr(extensions, "EGL_MESA_device_software")});
  }
  return devices;
}

EGLContext create_core_context(EGLDisplay display, EGLConfig config) {
  for (const auto& [major, minor] : {std::array<EGLint, 2>{4, 1}, std::array<EGLint, 2>{3, 3}}) {
    const std::array<EGLint, 7> attributes = {
        EGL_CONTEXT_MAJOR_VERSION,           major,   EGL_CONTEXT_MINOR_VERSION, minor, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
    if (context != EGL_NO_CONTEXT) return context;
  }
  return EGL_NO_CONTEXT;
}

}  // namespace

HeadlessContext::HeadlessContext() {
  require_libraries();
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base"))
    throw EnvironmentError(std::string("no picture: EGL has no driver, or is too old (EGL_EXT_platform_base missing)") +
                           kPackages);
  const std::vector<Device> devices = list_devices();
  const auto try_devices = [&](bool software) {
    for (const Device& device : devices)
      if (device.software == software &&
          try_display(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device.handle, nullptr),
                      "device " + std::to_string(device.index)))
        return true;
    return false;
  };
  if (try_devices(false)) return;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless") &&
      try_display(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr), "surfaceless"))
    return;
  if (try_devices(true)) return;
  throw EnvironmentError("no picture: no EGL platform gives OpenGL 3.3 core (tried:" +
                         (attempts_.empty() ? std::string(" nothing offered") : attempts_) + ")" + kPackages);
}

bool HeadlessContext::try_display(void* display, const std::string& platform) {
  const auto refuse = [&](const char* step) {
    attempts_ += " " + platform + " " + step + " " + egl_error_text() + ";";
    return false;
  };
  if (display == EGL_NO_DISPLAY) return refuse("display");
  EGLint major = 0, minor = 0;
  if (!eglInitialize(display, &major, &minor)) return refuse("initialise");
  const auto give_up = [&](const char* step) {
    refuse(step);
    eglTerminate(display);
    return false;
  };
  if (!eglBindAPI(EGL_OPENGL_API)) return give_up("OpenGL");
  const std::array<EGLint, 5> wanted = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                                        EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, wanted.data(), &config, 1, &count) || count == 0) return give_up("config");
  EGLContext context = create_core_context(display, config);
  if (context == EGL_NO_CONTEXT) return give_up("context");
  EGLSurface surface = EGL_NO_SURFACE;
  if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context")) {
    const std::array<EGLint, 5> one_pixel = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    surface = eglCreatePbufferSurface(display, config, one_pixel.data());
  }
  if (!eglMakeCurrent(display, surface, surface, context)) {
    eglDestroyContext(display, context);
    return give_up("make current");
  }
  display_ = display;
  context_ = context;
  surface_ = surface;
  fill_info(platform);
  return true;
}

void HeadlessContext::fill_info(const std::string& platform) {
  const auto text = [](GLenum name) {
    const auto* bytes = glGetString(name);
    return bytes ? std::string(reinterpret_cast<const char*>(bytes)) : std::string("unknown");
  };
  info_.platform = platform;
  info_.renderer = text(GL_RENDERER);
  info_.version = text(GL_VERSION);
  info_.software = info_.renderer.find("llvmpipe") != std::string::npos ||
                   info_.renderer.find("softpipe") != std::string::npos ||
                   info_.renderer.find("swrast") != std::string::npos;
}

void HeadlessContext::make_current() {
  if (eglGetCurrentContext() == context_) return;
  if (!eglMakeCurrent(display_, surface_, surface_, context_))
    throw EnvironmentError("the OpenGL context cannot be made current on this thread (EGL error " + egl_error_text() +
                           ")");
}

HeadlessContext::~HeadlessContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (surface_) eglDestroySurface(display_, surface_);
  eglDestroyContext(display_, context_);
  // The display is process-wide and shared between contexts of the same platform, so it is not terminated here.
}

}  // namespace trocar
