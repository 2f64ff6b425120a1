// Buttons at a page's foot: side by side, in further rows where they do not fit; the page asks first how tall they will
// be.
//
// Thread: the window's.
#pragma once

#include <string>
#include <vector>

#include "app/window/ui/ui.h"

namespace trocar {

struct RowButton {
  const char* id;
  std::string text, key;
  bool strong = false;
};

/// px of a strip `width` px wide that holds them.
double button_rows_height(const Ui& ui, const std::vector<RowButton>& buttons, double width);
/// In the panel that is open. @return the one that was chosen, empty.
std::string button_rows(Ui& ui, const std::vector<RowButton>& buttons);

}  // namespace trocar
