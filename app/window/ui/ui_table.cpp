// Tables, and places to draw into.
#include <algorithm>
#include <numeric>

#include <imgui.h>
#include <imgui_internal.h>

#include "app/window/input/input_event.h"
#include "app/window/ui/theme.h"
#include "app/window/ui/ui_parts.h"
#include "app/window/ui/ui_style.h"

namespace trocar {
namespace {

struct Column {
  double x, room;
};

/// Left edges and widths within `all` px, with air between.
std::vector<Column> columns(const std::vector<double>& shares, double x, double all, double air) {
  const double sum = std::max(1e-9, std::accumulate(shares.begin(), shares.end(), 0.0));
  std::vector<Column> out;
  for (const double share : shares) {
    const double width = all * share / sum;
    out.push_back({x, std::max(1.0, width - air)});
    x += width;
  }
  return out;
}

void draw_cell(Ui& ui, const Ui::Cell& cell, Column column, double y, double side) {
  if (cell.mark != Mark::kNone) {
    ui.paint_mark(cell.mark, column.x, y, side);
    column.x += side + ui.px(8);
    column.room = std::max(1.0, column.room - side - ui.px(8));
  }
  const double w = std::min(UiParts::width(cell.text), column.room);
  UiParts::draw(ui, cell.right ? column.x + column.room - w : column.x, y, cell.text, cell.ink, column.room + 0.5);
}

}  // namespace

int Ui::table(const char* id, const std::vector<std::string>& heads, const std::vector<double>& shares,
              const std::vector<std::vector<Cell>>& rows, double height_at_720) {
  const double side = UiParts::height(), pad = px(5), high = side + 2 * pad, all = room();
  const ImVec2 top = ImGui::GetCursorScreenPos();
  const std::vector<Column> place = columns(shares, top.x + pad, all - 2 * pad, px(10));
  if (!heads.empty()) {
    for (std::size_t i = 0; i < std::min(heads.size(), place.size()); ++i) {
      const bool right = !rows.empty() && i < rows.front().size() && rows.front()[i].right;
      draw_cell(*this, {heads[i], Ink::kDim, Mark::kNone, right}, place[i], top.y + pad, side);
    }
    ImGui::Dummy(at(all, high));
  }
  const bool scrolls = height_at_720 > 0;
  if (scrolls) ImGui::BeginChild(id, at(0, px(height_at_720)), false, ImGuiWindowFlags_None);
  ImGui::PushID(id);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
  int chosen = -1;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    ImGui::PushID(static_cast<int>(r));
    const ImVec2 from = ImGui::GetCursorScreenPos();
    if (r % 2 == 0)
      ImGui::GetWindowDrawList()->AddRectFilled(from, at(from.x + all, from.y + high),
                                                packed(ground_colour(Ground::kRow)), static_cast<float>(px(4)));
    if (ImGui::Selectable("##row", false, ImGuiSelectableFlags_None, at(all, high))) chosen = static_cast<int>(r);
    UiParts::in_order();
    if (UiParts::chosen_by_key("")) chosen = static_cast<int>(r);
    for (std::size_t i = 0; i < std::min(rows[r].size(), place.size()); ++i)
      draw_cell(*this, rows[r][i], place[i], from.y + pad, side);
    ImGui::PopID();
  }
  ImGui::PopStyleVar();
  ImGui::PopID();
  if (scrolls) ImGui::EndChild();
  return chosen;
}

Area Ui::drawing(const char* id, double height_at_720) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const Area area{from.x, from.y, room(), std::max(1.0, px(height_at_720))};
  ImGui::InvisibleButton(UiParts::hidden(id).c_str(), at(area.width, area.height));
  UiParts::in_order();
  if (GImGui->NavId == ImGui::GetItemID() && !GImGui->NavDisableHighlight)
    ImGui::GetWindowDrawList()->AddRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), packed(okabe_ito::kYellow), 4,
                                        0, static_cast<float>(px(2)));
  return area;
}

Ui::Pointer Ui::pointer() const {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  return {ImGui::IsItemHovered(), ImGui::IsItemClicked(), ImGui::IsItemActive(), mouse.x, mouse.y};
}

int Ui::key_steps() const {
  const ImGuiContext& g = *GImGui;
  if (g.NavId != ImGui::GetItemID() || g.NavDisableHighlight) return 0;
  int steps = 0;
  for (const std::int32_t key : ui_memory().pressed) {
    if (key == '.' || key == kKeyPageDown) steps += key == '.' ? 1 : 10;
    if (key == ',' || key == kKeyPageUp) steps -= key == ',' ? 1 : 10;
    if (key != kKeyLeft && key != kKeyRight) continue;
    steps += key == kKeyRight ? 1 : -1;
    ImGui::NavMoveRequestCancel();  // the focus stays
  }
  return steps;
}

}  // namespace trocar
