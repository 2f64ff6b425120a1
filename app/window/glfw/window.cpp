#include "app/window/glfw/window.h"

#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "app/window/glfw/window_events.h"
#include "app/window/input/space_mouse.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr const char* kWithout = "\nWithout a window: trocar demo --headless writes a picture, the score and a report.";

std::string last_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason given";
}

[[noreturn]] void refuse(const std::string& what) { throw EnvironmentError("no window: " + what + kWithout); }

void require_egl() {
  void* handle = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
  if (!handle)
    refuse("libEGL.so.1 not found; install libegl1 libegl-mesa0 libgl1 libgl1-mesa-dri or the GPU vendor's driver");
  dlclose(handle);
}

void start_library() {
  const auto given = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  if (!given("DISPLAY") && !given("WAYLAND_DISPLAY"))
    refuse("no display (DISPLAY and WAYLAND_DISPLAY are not set); log in at a desktop, or forward one with ssh -X");
  if (glfwInit() == GLFW_FALSE) {
    const std::string reason = last_error();
    refuse("the display " + std::string(given("DISPLAY") ? std::getenv("DISPLAY") : "of Wayland") +
           " cannot be opened: " + reason);
  }
}

GLFWwindow* open_window(const WindowOptions& options) {
  // A context that tells of a reset where the driver has one; without where it has none.
  for (const auto& [major, minor, robustness] :
       {std::array{4, 1, GLFW_LOSE_CONTEXT_ON_RESET}, std::array{4, 1, GLFW_NO_ROBUSTNESS},
        std::array{3, 3, GLFW_LOSE_CONTEXT_ON_RESET}, std::array{3, 3, GLFW_NO_ROBUSTNESS}}) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, robustness);
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, major);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "trocar");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "trocar");
    if (GLFWwindow* window = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr))
      return window;
  }
  return nullptr;
}

/// Of OpenGL, through the context: the library's own header is not needed for two strings.
std::string gl_text(unsigned name) {
  using GetString = const unsigned char* (*)(unsigned);
  const auto get = reinterpret_cast<GetString>(glfwGetProcAddress("glGetString"));
  const unsigned char* text = get ? get(name) : nullptr;
  return text ? reinterpret_cast<const char*>(text) : "unknown";
}

using ResetStatus = unsigned (*)();

/// What tells of a lost context; nullptr: this one cannot be lost, or does not say so.
ResetStatus reset_status(GLFWwindow* window) {
  if (glfwGetWindowAttrib(window, GLFW_CONTEXT_ROBUSTNESS) != GLFW_LOSE_CONTEXT_ON_RESET) return nullptr;
  const char* name = glfwExtensionSupported("GL_KHR_robustness")   ? "glGetGraphicsResetStatus"
                     : glfwExtensionSupported("GL_ARB_robustness") ? "glGetGraphicsResetStatusARB"
                                                                   : nullptr;
  return name ? reinterpret_cast<ResetStatus>(glfwGetProcAddress(name)) : nullptr;
}

}  // namespace

struct Window::State {
  GLFWwindow* window = nullptr;
  ResetStatus reset_status = nullptr;
  ContextInfo info;
  WindowEvents events;
  SpaceMouse space_mouse;
  int x = 0, y = 0, width = 0, height = 0;  // as it was before it filled the screen
};

Window::Window(const WindowOptions& options) : state_(std::make_unique<State>()) {
  constexpr unsigned kGlRenderer = 0x1F01, kGlVersion = 0x1F02;
  require_egl();
  start_library();
  state_->window = open_window(options);
  if (!state_->window) {
    const std::string reason = last_error();
    glfwTerminate();
    refuse("the display gives no OpenGL 3.3 core through EGL: " + reason +
           "; install libegl-mesa0 libgl1-mesa-dri or the GPU vendor's driver");
  }
  state_->events.listen(state_->window);
  glfwSetWindowSizeLimits(state_->window, 200, 100, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwMakeContextCurrent(state_->window);
  glfwSwapInterval(1);
  state_->reset_status = reset_status(state_->window);
  state_->info = {"window", gl_text(kGlRenderer), gl_text(kGlVersion), false};
  for (const char* software : {"llvmpipe", "softpipe", "swrast"})
    if (state_->info.renderer.find(software) != std::string::npos) state_->info.software = true;
  if (options.fullscreen) set_fullscreen(true);
}

Window::~Window() {
  glfwDestroyWindow(state_->window);
  glfwTerminate();
}

void Window::make_current() {
  if (glfwGetCurrentContext() == state_->window) return;
  glfwMakeContextCurrent(state_->window);
  if (glfwGetCurrentContext() != state_->window)
    throw EnvironmentError("the window's OpenGL context cannot be made current on this thread: " + last_error());
}

const ContextInfo& Window::info() const { return state_->info; }

std::vector<InputEvent> Window::poll() {
  glfwPollEvents();
  state_->events.sample_pads();
  if (const auto moved = state_->space_mouse.newest()) state_->events.queue.push_back(*moved);
  return std::exchange(state_->events.queue, {});
}

bool Window::close_asked() const { return glfwWindowShouldClose(state_->window) == GLFW_TRUE; }
void Window::stay_open() { glfwSetWindowShouldClose(state_->window, GLFW_FALSE); }

int Window::width() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(state_->window, &width, &height);
  return width;
}

int Window::height() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(state_->window, &width, &height);
  return height;
}

bool Window::lost() const { return state_->reset_status != nullptr && state_->reset_status() != 0; }
void Window::present() { glfwSwapBuffers(state_->window); }
void Window::set_title(const std::string& title) { glfwSetWindowTitle(state_->window, title.c_str()); }

void Window::hold_pointer(bool held) {
  const int wanted = held ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL;
  if (glfwGetInputMode(state_->window, GLFW_CURSOR) != wanted) glfwSetInputMode(state_->window, GLFW_CURSOR, wanted);
}

void Window::set_fullscreen(bool fullscreen) {
  State& s = *state_;
  const bool now = glfwGetWindowMonitor(s.window) != nullptr;
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (now == fullscreen || monitor == nullptr) return;
  if (!fullscreen) return glfwSetWindowMonitor(s.window, nullptr, s.x, s.y, s.width, s.height, GLFW_DONT_CARE);
  glfwGetWindowPos(s.window, &s.x, &s.y);
  glfwGetWindowSize(s.window, &s.width, &s.height);
  const GLFWvidmode* mode = glfwGetVideoMode(monitor);
  if (mode != nullptr) glfwSetWindowMonitor(s.window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void* Window::native() const { return state_->window; }

}  // namespace trocar
