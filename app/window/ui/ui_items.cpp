// Pieces that a person chooses with: buttons, switches, lists, sliders, fields.
#include <algorithm>
#include <cmath>

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include "app/window/input/key_map.h"
#include "app/window/ui/theme.h"
#include "app/window/ui/ui_parts.h"
#include "app/window/ui/ui_style.h"

namespace trocar {
namespace {

/// Room for the name of a setting left of its control.
double label_room(const Ui& ui) { return std::max(1.0, 0.46 * ui.room()); }

/// Name left, control right; on narrow panels one below the other. @return px for the control.
double labelled(Ui& ui, const std::string& text) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const double all = ui.room(), pad = ImGui::GetStyle().FramePadding.y, gap = ui.px(12);
  const double named = UiParts::width(text);
  if (named <= label_room(ui)) {
    const double left = label_room(ui);
    UiParts::draw(ui, from.x, from.y + pad, text, Ink::kText, left);
    ImGui::SetCursorScreenPos(at(from.x + left + gap, from.y));
    return all - left - gap;
  }
  UiParts::draw(ui, from.x, from.y, text, Ink::kText, all);
  ImGui::Dummy(at(1, UiParts::height()));
  return all;
}

}  // namespace

void UiParts::in_order(bool types) {
  UiMemory& memory = ui_memory();
  const ImGuiID id = ImGui::GetItemID();
  if (id == 0) return;
  memory.items.push_back({id, types});
  if (memory.focus_wanted != id) return;
  memory.focus_wanted = 0;
  ImGuiContext& g = *GImGui;
  ImGui::FocusWindow(g.CurrentWindow);
  ImGui::SetFocusID(id, g.CurrentWindow);
  g.NavDisableHighlight = false;
  g.NavDisableMouseHover = true;
  if (!ImGui::IsItemVisible()) ImGui::SetScrollHereY();
  if (!types) return;
  g.NavNextActivateId = id;
  g.NavNextActivateFlags = ImGuiActivateFlags_PreferInput;
}

bool UiParts::chosen_by_key(const std::string& key) {
  const UiMemory& memory = ui_memory();
  const auto down = [&memory](std::int32_t code) {
    return std::find(memory.pressed.begin(), memory.pressed.end(), code) != memory.pressed.end();
  };
  const ImGuiContext& g = *GImGui;
  if (g.OpenPopupStack.Size > 0 || memory.list_was_open) return false;
  const bool ringed = memory.focus_shown && g.NavId == ImGui::GetItemID() && !g.NavDisableHighlight;
  if (ringed && down(kKeyEnter)) return true;
  if (key.empty()) return false;
  const std::int32_t code = key_from_name(key);
  if (code == kKeyUnknown || !down(code)) return false;
  const auto typing = std::any_of(memory.items_before.begin(), memory.items_before.end(),
                                  [&g](const UiMemory::Item& item) { return item.types && item.id == g.ActiveId; });
  if (typing) return code == kKeyEnter || code == kKeyEscape || code >= kKeyF1;
  if (g.IO.WantTextInput) return false;  // a slider's number is being typed
  return code != kKeyEnter || !memory.focus_shown;
}

bool Ui::button(const char* id, const std::string& text, const std::string& key, bool strong, double width_at_720) {
  const std::string hint = key.empty() ? "" : "[" + words_.name(key) + "]";
  const ImVec2 pad = ImGui::GetStyle().FramePadding;
  const double gap = px(10), hint_width = hint.empty() ? 0 : UiParts::width(hint) + gap;
  const double wanted = width_at_720 > 0 ? px(width_at_720) : UiParts::width(text) + hint_width + 2 * pad.x;
  const double wide = std::min(wanted, room()),
               high = UiParts::height() + 2 * pad.y * (strong && width_at_720 > 0 ? 1.5 : 1.0);
  if (strong) {
    ImGui::PushStyleColor(ImGuiCol_Button, vec(ground_colour(Ground::kStrong)));
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, vec(ground_colour(Ground::kStrongHover)));
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, vec(ground_colour(Ground::kStrongHover)));
  }
  const bool clicked = ImGui::Button(UiParts::hidden(id).c_str(), at(wide, high));
  if (strong) ImGui::PopStyleColor(3);
  UiParts::in_order();
  const bool by_enter = strong && !ImGui::GetIO().WantTextInput && UiParts::chosen_by_key("Enter");
  const bool by_key = UiParts::chosen_by_key(key) || by_enter;
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  const double y = (from.y + to.y - UiParts::height()) / 2, inner = wide - 2 * pad.x;
  const bool hint_fits = !hint.empty() && inner - hint_width >= UiParts::width(text);
  UiParts::draw(*this, from.x + pad.x, y, text, Ink::kText, hint_fits ? inner - hint_width : inner);
  if (hint_fits)
    UiParts::draw(*this, to.x - pad.x - hint_width + gap, y, hint, strong ? Ink::kText : Ink::kDim, hint_width);
  return clicked || by_key;
}

bool Ui::toggle(const char* id, const std::string& text, bool& value) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const double high = ImGui::GetFrameHeight();
  bool changed = ImGui::Checkbox(UiParts::hidden(id).c_str(), &value);
  UiParts::in_order();
  if (UiParts::chosen_by_key("")) {
    value = !value;
    changed = true;
  }
  ImGui::SameLine(0, static_cast<float>(px(10)));
  UiParts::draw(*this, ImGui::GetCursorScreenPos().x, from.y + (high - UiParts::height()) / 2, text, Ink::kText,
                room());
  ImGui::Dummy(at(1, high));
  return changed;
}

bool Ui::choice(const char* id, const std::string& text, const std::vector<std::string>& options, int& chosen) {
  const double there = labelled(*this, text);
  ImGui::SetNextItemWidth(static_cast<float>(there));
  const bool valid = chosen >= 0 && chosen < static_cast<int>(options.size());
  const std::string now = valid ? options[static_cast<std::size_t>(chosen)] : "";
  const double inner = there - ImGui::GetFrameHeight() - ImGui::GetStyle().FramePadding.x;
  const bool open = ImGui::BeginCombo(UiParts::hidden(id).c_str(), UiParts::fitted(now, inner).c_str());
  const int before = chosen;
  if (open) {
    for (int i = 0; i < static_cast<int>(options.size()); ++i) {
      if (ImGui::Selectable(options[static_cast<std::size_t>(i)].c_str(), i == chosen)) chosen = i;
      if (i == chosen) ImGui::SetItemDefaultFocus();
    }
    ImGui::EndCombo();
    return chosen != before;
  }
  UiParts::in_order();
  const ImVec2 from = ImGui::GetItemRectMin(), pad = ImGui::GetStyle().FramePadding;
  UiParts::note(*this, now, from.x + pad.x, from.y + pad.y, std::min(UiParts::width(now), inner), UiParts::height(),
                inner, UiParts::width(now) > inner);
  if (UiParts::chosen_by_key("") && !options.empty()) chosen = (chosen + 1) % static_cast<int>(options.size());
  return chosen != before;
}

bool Ui::slider(const char* id, const std::string& text, double& value, double low, double high, int decimals) {
  const double there = labelled(*this, text);
  ImGui::SetNextItemWidth(static_cast<float>(there));
  const std::string before =
      words_.number(value, decimals);  // in place of a format: ImGui knows no decimal sign but the point
  const bool changed = ImGui::SliderScalar(UiParts::hidden(id).c_str(), ImGuiDataType_Double, &value, &low, &high,
                                           before.c_str(), ImGuiSliderFlags_AlwaysClamp);
  UiParts::in_order();
  const double step = std::pow(10.0, -decimals);
  if (changed) value = std::clamp(std::round(value / step) * step, low, high);
  const std::string shown = words_.number(value, decimals);
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  const double w = UiParts::width(shown);
  UiParts::note(*this, shown, (from.x + to.x - w) / 2, from.y + ImGui::GetStyle().FramePadding.y, w, UiParts::height(),
                there);
  return changed;
}

bool Ui::field(const char* id, const std::string& text, std::string& value, bool secret) {
  const double there = labelled(*this, text);
  ImGui::SetNextItemWidth(static_cast<float>(there));
  const bool entered =
      ImGui::InputText(UiParts::hidden(id).c_str(), &value,
                       ImGuiInputTextFlags_EnterReturnsTrue | (secret ? ImGuiInputTextFlags_Password : 0));
  UiParts::in_order(true);
  return entered;
}

void Ui::focus_next() { ImGui::SetKeyboardFocusHere(); }

bool Ui::selectable(const char* id, Mark mark, const std::string& text, bool selected, const std::string& right) {
  const double side = UiParts::height(), pad = px(6), high = side + 2 * pad, there = room();
  const bool clicked =
      ImGui::Selectable(UiParts::hidden(id).c_str(), selected, ImGuiSelectableFlags_None, at(there, high));
  UiParts::in_order();
  const bool by_key = UiParts::chosen_by_key("");
  const ImVec2 from = ImGui::GetItemRectMin();
  const double y = from.y + (ImGui::GetItemRectSize().y - side) / 2;
  double x = from.x + pad, inner = there - 2 * pad;
  if (mark != Mark::kNone) {
    paint_mark(mark, x, y, side);
    x += side + px(10);
    inner -= side + px(10);
  }
  const double right_width = right.empty() ? 0 : std::min(UiParts::width(right), 0.5 * inner);
  if (!right.empty()) UiParts::draw(*this, from.x + there - pad - right_width, y, right, Ink::kDim, right_width + 0.5);
  UiParts::draw(*this, x, y, text, Ink::kText, inner - right_width - (right.empty() ? 0 : px(10)));
  return clicked || by_key;
}

}  // namespace trocar
