// What the sources of Ui share: measuring and noting a text, an item's place in the order of Tab. Only
// app/window/ui/*.cpp includes this.
//
// Thread: the window's, within a frame.
#pragma once

#include <string>

#include "app/window/ui/ui.h"
#include "app/window/ui/ui_memory.h"

struct ImVec2;

namespace trocar {

ImVec2 at(double x, double y);

class UiParts {
 public:
  /// Notes a text that stands at x, y; what a panel's edge hides is left out. @param room px that it may take.
  static void note(Ui& ui, const std::string& text, double x, double y, double width, double height, double room,
                   bool shortened = false);
  /// `text`, or its longest beginning with an ellipsis that is no wider than room.
  static std::string fitted(const std::string& text, double room, UiFont font = UiFont::kBody);
  static double width(const std::string& text, UiFont font = UiFont::kBody);
  static double height(UiFont font = UiFont::kBody);
  /// Draws `text` at a place of the current panel, shortened to `room`, and notes it. @return its width.
  static double draw(Ui& ui, double x, double y, const std::string& text, Ink ink, double room,
                     UiFont font = UiFont::kBody);
  /// Wrapped text at a place; moves the cursor. @return its height.
  static double wrapped_at(Ui& ui, const Area& place, const std::string& text, Ink ink);
  /// The item that was just submitted takes part in Tab; one that types goes into typing when Tab comes to it.
  static void in_order(bool types = false);
  /// Enter on the item that has the ring; pressing `key` counts as well. @return chosen.
  static bool chosen_by_key(const std::string& key);
  /// "name" and "##id": ImGui's label without text.
  static std::string hidden(const char* id) { return std::string("##") + id; }
};

}  // namespace trocar
