#include "app/window/ui/button_row.h"

#include <algorithm>

namespace trocar {
namespace {

constexpr double kGap = 10, kPadding = 12;

double wide(const Ui& ui, const RowButton& button) {
  const double hint = button.key.empty() ? 0 : ui.text_width("[" + ui.words().name(button.key) + "]") + ui.px(10);
  return ui.text_width(button.text) + hint + ui.px(2 * kPadding) + 1;
}

/// Of each button: does it begin a row?
std::vector<bool> breaks(const Ui& ui, const std::vector<RowButton>& buttons, double room) {
  std::vector<bool> out;
  double used = 0;
  for (const RowButton& button : buttons) {
    const double needed = wide(ui, button);
    out.push_back(used > 0 && used + ui.px(kGap) + needed > room);
    used = out.back() || used == 0 ? needed : used + ui.px(kGap) + needed;
  }
  return out;
}

}  // namespace

double button_rows_height(const Ui& ui, const std::vector<RowButton>& buttons, double width) {
  const std::vector<bool> new_row = breaks(ui, buttons, ui.strip_room(width));
  return ui.strip_height(1 + static_cast<int>(std::count(new_row.begin(), new_row.end(), true)));
}

std::string button_rows(Ui& ui, const std::vector<RowButton>& buttons) {
  std::string chosen;
  const std::vector<bool> new_row = breaks(ui, buttons, ui.room());
  for (std::size_t i = 0; i < buttons.size(); ++i) {
    if (i > 0 && !new_row[i]) ui.same_line(kGap);
    if (ui.button(buttons[i].id, buttons[i].text, buttons[i].key, buttons[i].strong)) chosen = buttons[i].id;
  }
  return chosen;
}

}  // namespace trocar
