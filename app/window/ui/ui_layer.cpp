#include "app/window/ui/ui_layer.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <utility>

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "app/window/ui/theme.h"
#include "app/window/ui/ui_memory.h"
#include "app/window/ui/ui_style.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

/// ImGui counts keys up to 512; ours end well below.
constexpr int kKeys = 512;

void map_keys(ImGuiIO& io) {
  // Tab is not mapped: ImGui 1.86 would only go from field to field, Ui goes to every item (ui_memory.h).
  const std::pair<int, int> map[] = {{ImGuiKey_LeftArrow, kKeyLeft},
                                     {ImGuiKey_RightArrow, kKeyRight},
                                     {ImGuiKey_UpArrow, kKeyUp},
                                     {ImGuiKey_DownArrow, kKeyDown},
                                     {ImGuiKey_PageUp, kKeyPageUp},
                                     {ImGuiKey_PageDown, kKeyPageDown},
                                     {ImGuiKey_Home, kKeyHome},
                                     {ImGuiKey_End, kKeyEnd},
                                     {ImGuiKey_Insert, kKeyInsert},
                                     {ImGuiKey_Delete, kKeyDelete},
                                     {ImGuiKey_Backspace, kKeyBackspace},
                                     {ImGuiKey_Space, kKeySpace},
                                     {ImGuiKey_Enter, kKeyEnter},
                                     {ImGuiKey_Escape, kKeyEscape},
                                     {ImGuiKey_A, 'A'},
                                     {ImGuiKey_C, 'C'},
                                     {ImGuiKey_V, 'V'},
                                     {ImGuiKey_X, 'X'},
                                     {ImGuiKey_Y, 'Y'},
                                     {ImGuiKey_Z, 'Z'}};
  for (const auto& [theirs, ours] : map) io.KeyMap[theirs] = ours;
}

int button_index(MouseButton button) {
  switch (button) {
    case MouseButton::kLeft:
      return ImGuiMouseButton_Left;
    case MouseButton::kRight:
      return ImGuiMouseButton_Right;
    case MouseButton::kMiddle:
      return ImGuiMouseButton_Middle;
  }
  return ImGuiMouseButton_Left;
}

/// The item after (or before) the one that has the keyboard, in the order of drawing.
unsigned next_item(const UiMemory& memory, unsigned now, bool back) {
  const auto& items = memory.items_before;
  if (items.empty()) return 0;
  const auto at =
      std::find_if(items.begin(), items.end(), [now](const UiMemory::Item& item) { return item.id == now; });
  if (at == items.end() || !memory.focus_shown) return back ? items.back().id : items.front().id;
  const auto index = static_cast<std::size_t>(at - items.begin()), n = items.size();
  return items[(index + (back ? n - 1 : 1)) % n].id;
}

}  // namespace

UiMemory& ui_memory() { return *static_cast<UiMemory*>(ImGui::GetIO().UserData); }

struct UiLayer::State {
  GraphicsContext& context;
  ImGuiContext* imgui = nullptr;
  double scale = 1;
  UiMemory memory;
  std::array<bool, kKeys> held{};
  std::array<bool, 3> buttons{};

  explicit State(GraphicsContext& graphics) : context(graphics) {}
  void feed(const InputEvent& event, ImGuiIO& io);
  void feed_all(const std::vector<InputEvent>& events);
  void move_focus(const std::vector<InputEvent>& events);
  void ensure_fonts(double unit);
};

UiLayer::UiLayer(GraphicsContext& context, double scale) : state_(std::make_unique<State>(context)) {
  State& s = *state_;
  s.scale = scale;
  context.make_current();
  s.imgui = ImGui::CreateContext();
  ImGui::SetCurrentContext(s.imgui);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.UserData = &s.memory;
  map_keys(io);
  try {
    if (!ImGui_ImplOpenGL3_Init("#version 330 core"))
      throw EnvironmentError("no window: the interface's OpenGL part does not start");
    s.ensure_fonts(ui_unit(scale, 1280, 720));
  } catch (...) {
    if (io.BackendRendererUserData) ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(s.imgui);
    throw;
  }
}

UiLayer::~UiLayer() {
  try {
    state_->context.make_current();
  } catch (const EnvironmentError&) {
    // The context is gone: so are its objects.
  }
  ImGui::SetCurrentContext(state_->imgui);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext(state_->imgui);
}

void UiLayer::set_scale(double scale) { state_->scale = scale; }

void UiLayer::State::ensure_fonts(double unit) {
  if (memory.fonts[0] != nullptr && memory.unit == unit) return;
  if (memory.fonts[0] != nullptr) ImGui_ImplOpenGL3_DestroyFontsTexture();
  memory.unit = unit;
  memory.fonts = load_fonts(unit);
  apply_style(unit);
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void UiLayer::State::feed(const InputEvent& event, ImGuiIO& io) {
  using Kind = InputEvent::Kind;
  const bool known = event.key > 0 && event.key < kKeys;
  switch (event.kind) {
    case Kind::kKeyDown:
      if (known) io.KeysDown[event.key] = held[static_cast<std::size_t>(event.key)] = true;
      memory.pressed.push_back(event.key);
      break;
    case Kind::kKeyUp:
      if (known) held[static_cast<std::size_t>(event.key)] = false;
      break;
    case Kind::kText:
      io.AddInputCharacter(event.character);
      break;
    case Kind::kMouseMove:
      io.MousePos = ImVec2(static_cast<float>(event.x), static_cast<float>(event.y));
      memory.pointer_x = event.x;
      memory.pointer_y = event.y;
      break;
    case Kind::kButtonDown:
    case Kind::kButtonUp: {
      const bool down = event.kind == Kind::kButtonDown;
      const int index = button_index(event.button);
      buttons[static_cast<std::size_t>(index)] = down;
      if (down) io.MouseDown[index] = true;
      break;
    }
    case Kind::kWheel:
      io.MouseWheel += static_cast<float>(event.wheel);
      break;
    case Kind::kFocusLost:
      held.fill(false);
      buttons.fill(false);
      break;
    case Kind::kPad:
    case Kind::kSpaceMouse:
      break;
  }
}

void UiLayer::State::feed_all(const std::vector<InputEvent>& events) {
  ImGuiIO& io = ImGui::GetIO();
  // What went down and up again within a frame is down for this one.
  for (int key = 0; key < kKeys; ++key) io.KeysDown[key] = held[static_cast<std::size_t>(key)];
  for (int button = 0; button < 3; ++button) io.MouseDown[button] = buttons[static_cast<std::size_t>(button)];
  memory.pressed.clear();
  std::array<bool, kKeys> keys_before = held;
  std::array<bool, 3> buttons_before = buttons;
  for (const InputEvent& event : events) feed(event, io);
  // What was down before and is let go is up at once.
  for (std::size_t i = 0; i < keys_before.size(); ++i) io.KeysDown[i] = held[i] || (io.KeysDown[i] && !keys_before[i]);
  for (std::size_t i = 0; i < buttons_before.size(); ++i)
    io.MouseDown[i] = buttons[i] || (io.MouseDown[i] && !buttons_before[i]);
  const auto is_down = [&](Key key) { return io.KeysDown[key]; };
  io.KeyShift = is_down(kKeyShift);
  io.KeyCtrl = is_down(kKeyControl);
  io.KeyAlt = is_down(kKeyAlt);
}

void UiLayer::State::move_focus(const std::vector<InputEvent>& events) {
  const ImGuiContext& g = *imgui;
  const bool ring = g.NavId != 0 && !g.NavDisableHighlight;
  memory.focus_shown = (ring || g.ActiveId == g.NavId) && g.NavId != 0 &&
                       std::any_of(memory.items_before.begin(), memory.items_before.end(),
                                   [&g](const UiMemory::Item& item) { return item.id == g.NavId; });
  memory.focus_wanted = 0;  // an item that is no longer drawn is not waited for
  if (memory.screen_has_keys) return;
  for (const InputEvent& event : events) {
    if (event.kind != InputEvent::Kind::kKeyDown || event.key != kKeyTab || event.control || event.alt) continue;
    const unsigned from = memory.focus_wanted != 0 ? memory.focus_wanted : g.NavId;
    memory.focus_wanted = next_item(memory, from, event.shift);
    memory.focus_shown = true;
  }
  if (memory.focus_wanted != 0 && g.ActiveId != 0) ImGui::ClearActiveID();
}

void UiLayer::begin(int width, int height, double dt_s, const std::vector<InputEvent>& events) {
  State& s = *state_;
  ImGui::SetCurrentContext(s.imgui);
  s.ensure_fonts(ui_unit(s.scale, width, height));
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
  io.DeltaTime = static_cast<float>(std::clamp(dt_s, 1e-4, 1.0));
  s.memory.screen_has_keys = std::exchange(s.memory.keys_to_screen, false);
  io.ConfigFlags = s.memory.screen_has_keys ? ImGuiConfigFlags_None : ImGuiConfigFlags_NavEnableKeyboard;
  s.feed_all(events);
  s.memory.items_before.swap(s.memory.items);
  s.memory.items.clear();
  s.memory.list_was_open = s.imgui->OpenPopupStack.Size > 0;
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  s.move_focus(events);
}

bool UiLayer::wants_pointer() const {
  ImGui::SetCurrentContext(state_->imgui);
  return ImGui::GetIO().WantCaptureMouse;
}

bool UiLayer::wants_keys() const {
  ImGui::SetCurrentContext(state_->imgui);
  const ImGuiContext& g = *state_->imgui;
  if (state_->memory.screen_has_keys && !g.IO.WantTextInput) return false;
  return g.IO.WantTextInput || g.OpenPopupStack.Size > 0 || state_->memory.focus_shown;
}

bool UiLayer::popup_open() const { return state_->imgui->OpenPopupStack.Size > 0; }

void UiLayer::end() {
  ImGui::SetCurrentContext(state_->imgui);
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace trocar
