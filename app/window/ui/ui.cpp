#include "app/window/ui/ui.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>
#include <imgui_internal.h>

#include "app/window/input/key_map.h"
#include "app/window/ui/theme.h"
#include "app/window/ui/ui_parts.h"
#include "app/window/ui/ui_style.h"
#include "haptics/utf8.h"

namespace trocar {
namespace {

ImFont* font_of(UiFont font) { return ui_memory().fonts[static_cast<std::size_t>(font)]; }

ImVec2 size_of(const std::string& text, UiFont font, float wrap = 0) {
  const ImFont* f = font_of(font);
  return f->CalcTextSizeA(f->FontSize, FLT_MAX, wrap, text.data(), text.data() + text.size());
}

constexpr double kStripAir = 9;       // px at 720 lines above and below a strip's buttons
constexpr double kScrolledLines = 3;  // by an arrow

}  // namespace

ImVec2 at(double x, double y) { return {static_cast<float>(x), static_cast<float>(y)}; }

double UiParts::width(const std::string& text, UiFont font) { return size_of(text, font).x; }
double UiParts::height(UiFont font) { return font_of(font)->FontSize; }

std::string UiParts::fitted(const std::string& text, double room, UiFont font) {
  if (width(text, font) <= room) return text;
  const double left = room - width("\u2026", font);
  std::size_t end = 0;
  while (end < text.size()) {
    const std::size_t next = end + std::max<std::size_t>(1, utf8_length(text, end));
    if (width(text.substr(0, next), font) > left) break;
    end = next;
  }
  while (end > 0 && text[end - 1] == ' ') --end;
  return text.substr(0, end) + "\u2026";
}

void UiParts::note(Ui& ui, const std::string& text, double x, double y, double width, double height, double room,
                   bool shortened) {
  const ImGuiWindow* window = GImGui->CurrentWindow;
  const bool grounded = window == nullptr || window->IsFallbackWindow;
  const double top = grounded ? 0 : window->ClipRect.Min.y, bottom = grounded ? ui.height() : window->ClipRect.Max.y;
  const double seen_top = std::max(y, top), seen_bottom = std::min(y + height, bottom);
  if (seen_bottom <= seen_top) return;
  ui.drawn_.push_back({text, x, seen_top, width, seen_bottom - seen_top, room, shortened, ui.in_front_, grounded});
}

double UiParts::draw(Ui& ui, double x, double y, const std::string& text, Ink ink, double room, UiFont font) {
  const std::string shown = fitted(text, room, font);
  const double w = width(shown, font), h = height(font);
  const ImFont* f = font_of(font);
  ImGui::GetWindowDrawList()->AddText(f, f->FontSize, at(x, y), packed(ink_colour(ink)), shown.data(),
                                      shown.data() + shown.size());
  note(ui, text, x, y, w, h, room, shown != text);
  return w;
}

Ui::Ui(const Translator& words, double scale, int width_px, int height_px)
    : words_(words), scale_(ui_unit(scale, width_px, height_px)), width_(width_px), height_(height_px) {}

double Ui::px(double at_720) const { return at_720 * scale_; }

void Ui::begin_panel(const char* id, const Area& area, double opacity) {
  begin(id, area, opacity, ImGuiWindowFlags_None);
}

void Ui::begin(const char* id, const Area& area, double opacity, int flags) {
  panel_ = id;
  ImGui::SetNextWindowPos(at(area.x, area.y));
  ImGui::SetNextWindowSize(at(std::max(8.0, area.width), std::max(8.0, area.height)));
  ImGui::SetNextWindowBgAlpha(static_cast<float>(opacity));
  ImGui::Begin(id, nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | flags);
  ImGui::PushFont(font_of(UiFont::kBody));
}

/// Without a bar: it would take room from the buttons, whose new row then needs it.
void Ui::begin_strip(const char* id, const Area& area, double opacity) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(ImGui::GetStyle().WindowPadding.x, static_cast<float>(px(kStripAir))));
  begin(id, area, opacity, ImGuiWindowFlags_NoScrollbar);
  ImGui::PopStyleVar();
}

double Ui::strip_height(int rows) const {
  const ImGuiStyle& style = ImGui::GetStyle();
  const double row = UiParts::height() + 2 * style.FramePadding.y;
  return std::ceil(2 * px(kStripAir) + rows * row + (rows - 1) * style.ItemSpacing.y) + 1;
}

double Ui::strip_room(double width) const { return std::floor(width) - 2 * ImGui::GetStyle().WindowPadding.x; }

void Ui::in_front() {
  ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
  in_front_ = true;
}

void Ui::reveal() {
  const ImRect item = GImGui->LastItemData.Rect, seen = GImGui->CurrentWindow->InnerClipRect;
  if (item.Min.y < seen.Min.y || item.Max.y > seen.Max.y) ImGui::SetScrollHereY();
}

void Ui::end_panel() {
  if (ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y + GImGui->CurrentWindow->WindowPadding.y >
      ImGui::GetWindowHeight() + 1)
    scrolling_.push_back(panel_);
  ImGui::PopFont();
  ImGui::End();
  panel_.clear();
  in_front_ = false;
}

double Ui::room() const { return std::max(1.0F, ImGui::GetContentRegionAvail().x); }

void Ui::scroll_by_keys(bool arrows) {
  const float page = 0.8F * ImGui::GetWindowHeight(), step = static_cast<float>(kScrolledLines * UiParts::height());
  float by = (pressed("Page down") ? page : 0) - (pressed("Page up") ? page : 0);
  if (const float asked = (pressed("Down") ? step : 0) - (pressed("Up") ? step : 0); arrows && asked != 0) {
    by += asked;
    ImGui::NavMoveRequestCancel();
  }
  if (by != 0) ImGui::SetScrollY(std::clamp(ImGui::GetScrollY() + by, 0.0F, ImGui::GetScrollMaxY()));
}

double Ui::room_below() const { return std::max(1.0F, ImGui::GetContentRegionAvail().y); }

void Ui::to_bottom(double height_at_720) {
  const double y = ImGui::GetWindowHeight() - GImGui->CurrentWindow->WindowPadding.y - px(height_at_720);
  if (y > ImGui::GetCursorPosY()) ImGui::SetCursorPosY(static_cast<float>(y));
}

namespace {

/// Wrapped text of one font. @return where it stood and how large it was.
Area wrapped(const std::string& text, Ink ink, UiFont font, double room) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const ImVec2 size = size_of(text, font, static_cast<float>(room));
  ImGui::PushFont(font_of(font));
  ImGui::PushStyleColor(ImGuiCol_Text, vec(ink_colour(ink)));
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + static_cast<float>(room));
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  ImGui::PopFont();
  return {from.x, from.y, size.x, size.y};
}

}  // namespace

double UiParts::wrapped_at(Ui& ui, const Area& place, const std::string& text, Ink ink) {
  ImGui::SetCursorScreenPos(at(place.x, place.y));
  const Area a = wrapped(text, ink, UiFont::kBody, place.width);
  note(ui, text, a.x, a.y, a.width, a.height, place.width);
  return a.height;
}

void Ui::title(const std::string& text, const std::string& right) {
  const double there = room(), side = right.empty() ? 0 : UiParts::width(right) + 1;
  const bool beside = UiParts::width(text, UiFont::kTitle) + px(16) + side <= there;
  const Area a = wrapped(text, Ink::kText, UiFont::kTitle, there);
  UiParts::note(*this, text, a.x, a.y, a.width, a.height, there);
  if (right.empty()) return;
  if (!beside) return this->text(right, Ink::kDim);
  const double y = a.y + UiParts::height(UiFont::kTitle) - UiParts::height() - px(2);
  UiParts::draw(*this, a.x + there - side, y, right, Ink::kDim, side);
}

void Ui::heading(const std::string& text) {
  const double there = room();
  const Area a = wrapped(text, Ink::kHeading, UiFont::kHeading, there);
  UiParts::note(*this, text, a.x, a.y, a.width, a.height, there);
}

void Ui::text(const std::string& text, Ink ink) {
  const double there = room();
  const Area a = wrapped(text, ink, UiFont::kBody, there);
  UiParts::note(*this, text, a.x, a.y, a.width, a.height, there);
}

void Ui::line(const std::string& text, Ink ink) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const double w = UiParts::draw(*this, from.x, from.y, text, ink, room());
  ImGui::Dummy(at(w, UiParts::height()));
  if (drawn_.size() && drawn_.back().shortened && drawn_.back().text == text) explain(text);
}

void Ui::marked(Mark mark, const std::string& text, Ink ink) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const double side = UiParts::height(), indent = side + px(10);
  if (mark != Mark::kNone) paint_mark(mark, from.x, from.y, side);
  const double there = std::max(1.0, room() - indent);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + static_cast<float>(indent));
  const Area a = wrapped(text, ink, UiFont::kBody, there);
  UiParts::note(*this, text, a.x, a.y, a.width, a.height, there);
}

void Ui::pair(const std::string& name, const std::string& value, Ink ink) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const double there = room(), air = px(12), right_width = std::min(UiParts::width(value) + 1, 0.58 * there),
               left = there - right_width - air;
  const double named = UiParts::wrapped_at(*this, {from.x, from.y, left, 0}, name, Ink::kDim);
  const double valued = UiParts::wrapped_at(*this, {from.x + left + air, from.y, right_width, 0}, value, ink);
  ImGui::SetCursorScreenPos(from);
  ImGui::Dummy(at(there, std::max(named, valued)));
}

Area Ui::placed(double height_at_720) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const Area area{from.x, from.y, room(), std::max(1.0, px(height_at_720))};
  ImGui::Dummy(at(area.width, area.height));
  return area;
}

void Ui::text_in(const Area& area, const std::string& text, Ink ink) {
  const ImVec2 keep = ImGui::GetCursorScreenPos();
  const double high = size_of(text, UiFont::kBody, static_cast<float>(area.width)).y;
  UiParts::wrapped_at(*this, {area.x, area.y + std::max(0.0, (area.height - high) / 2), area.width, 0}, text, ink);
  ImGui::SetCursorScreenPos(keep);
}

void Ui::gap(double at_720) { ImGui::Dummy(at(1, px(at_720))); }
void Ui::same_line(double at_720) { ImGui::SameLine(0, static_cast<float>(px(at_720))); }

void Ui::text_at(double x, double y, const std::string& text, Ink ink, double room, double anchor, bool heading) {
  const UiFont font = heading ? UiFont::kHeading : UiFont::kBody;
  const double w = UiParts::width(text, font);
  const double left = x - anchor * (room > 0 ? std::min(w, room) : w);
  if (panel_.empty()) {
    const std::string shown = room > 0 ? UiParts::fitted(text, room, font) : text;
    const ImFont* f = font_of(font);
    ImGui::GetBackgroundDrawList()->AddText(f, f->FontSize, at(left, y), packed(ink_colour(ink)), shown.data(),
                                            shown.data() + shown.size());
    UiParts::note(*this, text, left, y, UiParts::width(shown, font), UiParts::height(font), room > 0 ? room : w,
                  shown != text);
    return;
  }
  UiParts::draw(*this, left, y, text, ink, room > 0 ? room : w + 1, font);
}

double Ui::text_width(const std::string& text, bool heading) const {
  return UiParts::width(text, heading ? UiFont::kHeading : UiFont::kBody);
}
double Ui::text_height(const std::string& text, double room, bool heading) const {
  return size_of(text, heading ? UiFont::kHeading : UiFont::kBody, static_cast<float>(std::max(1.0, room))).y;
}
std::vector<std::string> Ui::lines(const std::string& text, double room) const {
  const ImFont* f = font_of(UiFont::kBody);
  std::vector<std::string> out;
  const char *at = text.data(), *end = at + text.size();
  while (at < end) {
    const char* stop = std::max(f->CalcWordWrapPositionA(1, at, end, static_cast<float>(room)), at + 1);
    out.emplace_back(at, stop);
    for (at = stop; at < end && *at == ' ';) ++at;
  }
  return out;
}

double Ui::line_height() const { return UiParts::height(); }

void Ui::explain(const std::string& text) {
  const bool focused = ImGui::IsItemFocused() && !GImGui->NavDisableHighlight;
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByPopup) && !focused) return;
  if (focused && !ImGui::IsItemHovered()) {
    const ImVec2 below = ImGui::GetItemRectMin();
    const double wide = std::min(px(460), width_ - 16);
    ImGui::SetNextWindowPos(at(std::min<double>(below.x, width_ - wide), ImGui::GetItemRectMax().y + px(6)));
  }
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(static_cast<float>(px(440)));
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool Ui::pressed(const std::string& key) const {
  if (ImGui::GetIO().WantTextInput) return false;
  const std::int32_t code = key_from_name(key);
  const auto& down = ui_memory().pressed;
  return code != kKeyUnknown && std::find(down.begin(), down.end(), code) != down.end();
}

void Ui::keys_to_screen() { ui_memory().keys_to_screen = true; }

}  // namespace trocar
