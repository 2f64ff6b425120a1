#include "app/window/glfw/window_events.h"

#include <cmath>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace trocar {
namespace {

using Kind = InputEvent::Kind;

WindowEvents& events_of(GLFWwindow* window) { return *static_cast<WindowEvents*>(glfwGetWindowUserPointer(window)); }

InputEvent at_pointer(const WindowEvents& events, Kind kind) {
  InputEvent event;
  event.kind = kind;
  event.x = events.x;
  event.y = events.y;
  return event;
}

void set_modifiers(InputEvent& event, int mods) {
  event.shift = (mods & GLFW_MOD_SHIFT) != 0;
  event.control = (mods & GLFW_MOD_CONTROL) != 0;
  event.alt = (mods & GLFW_MOD_ALT) != 0;
}

/// Screen coordinates are not pixels where the screen is scaled.
void on_cursor(GLFWwindow* window, double x, double y) {
  WindowEvents& events = events_of(window);
  int width = 1, height = 1, pixels_x = 1, pixels_y = 1;
  glfwGetWindowSize(window, &width, &height);
  glfwGetFramebufferSize(window, &pixels_x, &pixels_y);
  events.x = width > 0 ? x * pixels_x / width : x;
  events.y = height > 0 ? y * pixels_y / height : y;
  events.queue.push_back(at_pointer(events, Kind::kMouseMove));
}

void on_button(GLFWwindow* window, int button, int action, int mods) {
  if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
  WindowEvents& events = events_of(window);
  InputEvent event = at_pointer(events, action == GLFW_PRESS ? Kind::kButtonDown : Kind::kButtonUp);
  event.button = button == GLFW_MOUSE_BUTTON_LEFT    ? MouseButton::kLeft
                 : button == GLFW_MOUSE_BUTTON_RIGHT ? MouseButton::kRight
                                                     : MouseButton::kMiddle;
  set_modifiers(event, mods);
  events.queue.push_back(event);
}

void on_wheel(GLFWwindow* window, double, double notches) {
  WindowEvents& events = events_of(window);
  InputEvent event = at_pointer(events, Kind::kWheel);
  event.wheel = notches;
  event.shift =
      glfwGetKey(window, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS || glfwGetKey(window, GLFW_KEY_RIGHT_SHIFT) == GLFW_PRESS;
  event.alt = glfwGetKey(window, GLFW_KEY_LEFT_ALT) == GLFW_PRESS;
  events.queue.push_back(event);
}

void on_key(GLFWwindow* window, int key, int, int action, int mods) {
  WindowEvents& events = events_of(window);
  InputEvent event = at_pointer(events, action == GLFW_RELEASE ? Kind::kKeyUp : Kind::kKeyDown);
  event.key = key_of_glfw(key);
  if (event.key == kKeyUnknown) return;
  event.repeat = action == GLFW_REPEAT;
  set_modifiers(event, mods);
  events.queue.push_back(event);
}

void on_character(GLFWwindow* window, unsigned code) {
  WindowEvents& events = events_of(window);
  InputEvent event = at_pointer(events, Kind::kText);
  event.character = code;
  events.queue.push_back(event);
}

void on_focus(GLFWwindow* window, int focused) {
  if (focused == GLFW_FALSE) events_of(window).queue.push_back(at_pointer(events_of(window), Kind::kFocusLost));
}

/// Left x y, right x y, triggers as 0..1; y as the sticks give it, down positive.
InputEvent pad_event(const GLFWgamepadstate& state) {
  InputEvent event;
  event.kind = Kind::kPad;
  for (int i = 0; i < 4; ++i) event.axis[static_cast<std::size_t>(i)] = state.axes[i];
  event.axis[4] = (state.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER] + 1) / 2.0;
  event.axis[5] = (state.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] + 1) / 2.0;
  for (unsigned i = 0; i <= GLFW_GAMEPAD_BUTTON_LAST; ++i)
    if (state.buttons[i] == GLFW_PRESS) event.buttons |= 1U << i;
  return event;
}

}  // namespace

std::int32_t key_of_glfw(int key) {
  if ((key >= GLFW_KEY_A && key <= GLFW_KEY_Z) || (key >= GLFW_KEY_0 && key <= GLFW_KEY_9)) return key;
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return kKeyF1 + (key - GLFW_KEY_F1);
  switch (key) {
    case GLFW_KEY_SPACE:
    case GLFW_KEY_APOSTROPHE:
    case GLFW_KEY_COMMA:
    case GLFW_KEY_MINUS:
    case GLFW_KEY_PERIOD:
    case GLFW_KEY_SLASH:
    case GLFW_KEY_SEMICOLON:
    case GLFW_KEY_EQUAL:
    case GLFW_KEY_LEFT_BRACKET:
    case GLFW_KEY_BACKSLASH:
    case GLFW_KEY_RIGHT_BRACKET:
    case GLFW_KEY_GRAVE_ACCENT:
      return key;
    case GLFW_KEY_ESCAPE:
      return kKeyEscape;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      return kKeyEnter;
    case GLFW_KEY_TAB:
      return kKeyTab;
    case GLFW_KEY_BACKSPACE:
      return kKeyBackspace;
    case GLFW_KEY_INSERT:
      return kKeyInsert;
    case GLFW_KEY_DELETE:
      return kKeyDelete;
    case GLFW_KEY_RIGHT:
      return kKeyRight;
    case GLFW_KEY_LEFT:
      return kKeyLeft;
    case GLFW_KEY_DOWN:
      return kKeyDown;
    case GLFW_KEY_UP:
      return kKeyUp;
    case GLFW_KEY_PAGE_UP:
      return kKeyPageUp;
    case GLFW_KEY_PAGE_DOWN:
      return kKeyPageDown;
    case GLFW_KEY_HOME:
      return kKeyHome;
    case GLFW_KEY_END:
      return kKeyEnd;
    case GLFW_KEY_LEFT_SHIFT:
    case GLFW_KEY_RIGHT_SHIFT:
      return kKeyShift;
    case GLFW_KEY_LEFT_CONTROL:
    case GLFW_KEY_RIGHT_CONTROL:
      return kKeyControl;
    case GLFW_KEY_LEFT_ALT:
    case GLFW_KEY_RIGHT_ALT:
      return kKeyAlt;
    default:
      return kKeyUnknown;
  }
}

void WindowEvents::listen(GLFWwindow* window) {
  glfwSetWindowUserPointer(window, this);
  glfwSetCursorPosCallback(window, on_cursor);
  glfwSetMouseButtonCallback(window, on_button);
  glfwSetScrollCallback(window, on_wheel);
  glfwSetKeyCallback(window, on_key);
  glfwSetCharCallback(window, on_character);
  glfwSetWindowFocusCallback(window, on_focus);
}

void WindowEvents::sample_pads() {
  for (int joystick = GLFW_JOYSTICK_1; joystick <= GLFW_JOYSTICK_LAST; ++joystick) {
    const auto index = static_cast<std::size_t>(joystick);
    GLFWgamepadstate state{};
    const bool there =
        glfwJoystickIsGamepad(joystick) == GLFW_TRUE && glfwGetGamepadState(joystick, &state) == GLFW_TRUE;
    if (!there) {
      // A pad that is pulled out lets go of everything.
      if (pad_seen[index]) queue.push_back(pad_event({}));
      if (pad_seen[index]) queue.back().axis.fill(0);
      pad_seen[index] = false;
      continue;
    }
    const InputEvent now = pad_event(state);
    if (!pad_seen[index] || now.axis != pads[index].axis || now.buttons != pads[index].buttons) queue.push_back(now);
    pads[index] = now;
    pad_seen[index] = true;
  }
}

}  // namespace trocar
