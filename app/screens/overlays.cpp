#include "app/screens/overlays.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

constexpr double kNoticeSeconds = 6, kPerCharacter_s = 0.07;   // long ones take longer to read
constexpr double kLongestStep_s = 0.1;                          // a frame that took long (the first) takes nothing off a notice

/// A panel in the middle, as large as asked or as there is room.
Area middle(const Ui& ui, double width_at_720, double height_at_720) {
  const double margin = ui.px(12);
  const double w = std::min(ui.px(width_at_720), ui.width() - 2 * margin), h = std::min(ui.px(height_at_720), ui.height() - 2 * margin);
  return {(ui.width() - w) / 2, (ui.height() - h) / 2, w, h};
}

std::vector<Ui::Cell> key_row(const PracticeDesk& desk, const ActionName& action) {
  return {{desk.words().name(key_name(desk.keys().key_of(action.action))), Ink::kAccent}, {desk.words()(action.words)}};
}

void key_tables(Ui& ui, const PracticeDesk& desk) {
  const Words& w = desk.words();
  for (const bool steering : {true, false}) {
    ui.heading(steering ? w("Steering with keys") : w("Commands"));
    std::vector<std::vector<Ui::Cell>> rows;
    for (const ActionName& action : action_names())
      if (action.steering == steering) rows.push_back(key_row(desk, action));
    if (!steering) rows.push_back({{"F11", Ink::kAccent}, {w("Fill the screen")}});
    ui.table(steering ? "keys.steering" : "keys.commands", {w("Key"), w("What it does")}, {0.3, 0.7}, rows);
    ui.gap();
  }
  ui.heading(w("Mouse"));
  ui.text(w("Move: the tip in the plane of the picture. Wheel: in and out. Left button: close the jaws. Right button held: roll and turn the shaft."));
}

void metric_table(Ui& ui, const PracticeDesk& desk) {
  const Words& w = desk.words();
  for (const MetricDefinition& metric : metric_catalogue()) {
    ui.heading(metric.unit.empty() ? std::string(metric.name) : std::string(metric.name) + "  [" + std::string(metric.unit) + "]");
    ui.text(w(metric.meaning));
    ui.gap(4);
  }
}

}  // namespace

MenuChoice menu_overlay(Ui& ui, const PracticeDesk& desk, bool attempt_runs) {
  const Words& w = desk.words();
  MenuChoice choice = MenuChoice::kNone;
  ui.begin_panel("menu", middle(ui, 460, attempt_runs ? 400 : 350), 0.97);
  ui.in_front();
  ui.title(w("Menu"));
  const auto item = [&](const char* id, const std::string& text, MenuChoice what, bool strong = false) {
    if (ui.button(id, text, "", strong, 424)) choice = what;
  };
  item("back", attempt_runs ? w("Go on with the attempt") : w("Back"), MenuChoice::kBack, true);
  if (attempt_runs) item("leave", w("Leave this attempt"), MenuChoice::kLeaveAttempt);
  item("start", w("Start page"), MenuChoice::kStart);
  item("settings", w("Settings"), MenuChoice::kSettings);
  item("fullscreen", w("Fill the screen"), MenuChoice::kFullscreen);
  item("quit", w("Quit"), MenuChoice::kQuit);
  ui.end_panel();
  return choice;
}

bool help_overlay(Ui& ui, const PracticeDesk& desk, int& page) {
  const Words& w = desk.words();
  const Area all = middle(ui, 900, 680);
  const double foot = ui.px(74);
  ui.begin_panel("help", {all.x, all.y, all.width, all.height - foot}, 0.97);
  ui.in_front();
  ui.title(page == 0 ? w("Keys") : w("What is measured"));
  if (page == 0) key_tables(ui, desk);
  else metric_table(ui, desk);
  ui.end_panel();
  ui.begin_panel("help.foot", {all.x, all.y + all.height - foot, all.width, foot}, 0.97);
  ui.in_front();
  const bool close = ui.button("close", w("Close"), "Enter", true);
  ui.same_line();
  if (ui.button("page", page == 0 ? w("What is measured") : w("Keys"), "F2")) page = 1 - page;
  ui.end_panel();
  return close;
}

void notice_overlay(Ui& ui, PracticeDesk& desk, double dt_s, double& age_s, std::string& shown) {
  if (!desk.notice.empty()) {
    shown = std::exchange(desk.notice, "");
    age_s = 0;
  }
  if (shown.empty()) return;
  age_s += std::min(dt_s, kLongestStep_s);
  if (age_s > std::max(kNoticeSeconds, kPerCharacter_s * static_cast<double>(shown.size()))) return shown.clear();
  const double wide = std::min(ui.px(720), ui.width() - ui.px(24)), inner = wide - ui.px(84);
  const double lines = std::ceil(ui.text_width(shown) / std::max(1.0, inner) + 0.15);
  const double high = std::min(ui.px(40) + lines * ui.line_height(), ui.height());
  ui.begin_panel("notice", {(ui.width() - wide) / 2, ui.height() - high - ui.px(14), wide, high}, 0.97);
  ui.in_front();
  ui.marked(Mark::kInfo, shown);
  ui.end_panel();
}

}  // namespace trocar
