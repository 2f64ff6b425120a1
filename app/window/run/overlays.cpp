#include "app/window/run/overlays.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/window/ui/button_row.h"
#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

constexpr double kNoticeSeconds = 6, kPerCharacter_s = 0.07;  // long ones take longer to read
constexpr double kLongestStep_s = 0.1;                // a frame that took long (the first) takes nothing off a notice
constexpr double kNoticeTop = 50, kNoticeSides = 36;  // below the clock of a run

/// A panel in the middle, as large as asked or as there is room.
Area middle(const Ui& ui, double width_at_720, double height_at_720) {
  const double margin = ui.px(12);
  const double w = std::min(ui.px(width_at_720), ui.width() - 2 * margin),
               h = std::min(ui.px(height_at_720), ui.height() - 2 * margin);
  return {(ui.width() - w) / 2, (ui.height() - h) / 2, w, h};
}

std::vector<Ui::Cell> key_row(const PracticeModel& model, const ActionName& action) {
  return {{model.words().name(key_name(model.keys().key_of(action.action))), Ink::kAccent},
          {model.words()(action.words)}};
}

void key_tables(Ui& ui, const PracticeModel& model) {
  const Translator& w = model.words();
  ui.heading(w("Mouse"));
  ui.text(w(
      "Move: the tip; at L1 it keeps its height by itself. Wheel: deeper, back. Left button held: press, or close the "
      "jaws; let go, the force stays; a click lets off. Right button held: lean the shaft, with the wheel roll it. "
      "Middle button held: move the scope."));
  const auto key = [&](Action action) { return w.name(key_name(model.keys().key_of(action))); };
  ui.text(
      w("In free play {0} held closes the jaws and the left button presses with closed ones; {1} takes the next "
        "instrument, {2} held is its pedal. On a pad: right trigger, right stick pressed, left trigger.",
        {key(Action::kGrip), key(Action::kExchange), key(Action::kPedal)}));
  ui.gap();
  for (const bool steering : {true, false}) {
    ui.heading(steering ? w("Steering with keys") : w("Commands"));
    std::vector<std::vector<Ui::Cell>> rows;
    for (const ActionName& action : action_names())
      if (action.steering == steering) rows.push_back(key_row(model, action));
    if (!steering) rows.push_back({{"F11", Ink::kAccent}, {w("Fill the screen")}});
    ui.table(steering ? "keys.steering" : "keys.commands", {w("Key"), w("What it does")}, {0.3, 0.7}, rows);
    ui.gap();
  }
}

void metric_table(Ui& ui, const PracticeModel& model) {
  const Translator& w = model.words();
  for (const MetricDefinition& metric : metric_catalogue()) {
    ui.heading(metric.unit.empty() ? std::string(metric.name)
                                   : std::string(metric.name) + "  [" + std::string(metric.unit) + "]");
    ui.text(w(metric.meaning));
    ui.gap(4);
  }
}

}  // namespace

MenuChoice menu_overlay(Ui& ui, const PracticeModel& model, bool attempt_runs) {
  const Translator& w = model.words();
  MenuChoice choice = MenuChoice::kNone;
  ui.begin_panel("menu", middle(ui, 460, attempt_runs ? 308 : 269), 0.97);
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

std::optional<bool> leave_exam_overlay(Ui& ui, const Translator& w) {
  const std::string said = w("The clock runs on. Left now, the exam ends and counts as not passed.");
  const double width = std::min(ui.px(460), ui.width() - 2 * ui.px(12));
  const double height = std::min(ui.px(182) + ui.text_height(said, width - ui.px(36)), ui.height());
  std::optional<bool> leave;
  ui.begin_panel("leave.exam", {(ui.width() - width) / 2, (ui.height() - height) / 2, width, height}, 0.97);
  ui.in_front();
  ui.title(w("Leave the exam?"));
  ui.text(said, Ink::kDim);
  ui.gap();
  if (ui.button("stay", w("Go on with the exam"), "Enter", true, 424)) leave = false;
  if (ui.button("leave", w("Leave the exam"), "", false, 424)) leave = true;
  ui.end_panel();
  return leave;
}

HelpChoice help_overlay(Ui& ui, PracticeModel& model, HelpPage& page, SoundPage& sounds) {
  const Translator& w = model.words();
  const Area all = middle(ui, 900, 680);
  const bool keys = page == HelpPage::kKeys;
  std::vector<RowButton> buttons{{"close", w("Close"), "Enter", true},
                                 {"page", keys ? w("What is measured") : w("Keys"), "F2"},
                                 {"sounds", w("Sounds"), "F4"}};
  if (!model.running() || model.playing() != Play::kAttempt) buttons.push_back({"tutorial", w("Tutorial"), "F6"});
  const double foot = button_rows_height(ui, buttons, all.width), gap = ui.px(8);
  const bool told = page != HelpPage::kSounds;  // nothing to choose from: the arrows scroll
  ui.begin_panel(keys   ? "help"
                 : told ? "help.measures"
                        : "help.sounds",
                 {all.x, all.y, all.width, all.height - foot - gap}, 0.97);
  ui.in_front();
  ui.scroll_by_keys(told);
  ui.title(keys ? w("Keys") : told ? w("What is measured") : w("Sounds"));
  if (keys)
    key_tables(ui, model);
  else if (told)
    metric_table(ui, model);
  else
    sounds.frame(ui, model);
  ui.end_panel();
  ui.begin_strip("help.foot", {all.x, all.y + all.height - foot, all.width, foot}, 0.97);
  ui.in_front();
  const std::string chosen = button_rows(ui, buttons);
  ui.end_panel();
  if (chosen == "page") page = keys ? HelpPage::kMetrics : HelpPage::kKeys;
  if (chosen == "sounds") page = HelpPage::kSounds;
  return chosen == "close" ? HelpChoice::kClose : chosen == "tutorial" ? HelpChoice::kTutorial : HelpChoice::kNone;
}

void small_window(Ui& ui) {
  ui.begin_strip("small", {0, 0, ui.width(), ui.height()});
  ui.text(ui.words()("Please make the window larger."));
  ui.end_panel();
}

void notice_overlay(Ui& ui, PracticeModel& model, double dt_s, double& age_s, std::string& shown) {
  if (!model.notice.empty()) {
    shown = std::exchange(model.notice, "");
    age_s = 0;
  }
  if (shown.empty()) return;
  age_s += std::min(dt_s, kLongestStep_s);
  if (age_s > std::max(kNoticeSeconds, kPerCharacter_s * static_cast<double>(shown.size()))) return shown.clear();
  const double mark = ui.line_height() + ui.px(10), sides = ui.px(kNoticeSides),
               most = std::min(ui.px(720), ui.width() - ui.px(24));
  const double wide = std::min(most, ui.text_width(shown) + mark + sides + 2);
  const double high = ui.strip_height(1) - ui.px(14) + ui.text_height(shown, wide - mark - sides) - ui.line_height();
  ui.begin_strip("notice", {(ui.width() - wide) / 2, ui.px(kNoticeTop), wide, std::min(high, ui.height())}, 0.97);
  ui.in_front();
  ui.marked(Mark::kInfo, shown);
  ui.end_panel();
}

}  // namespace trocar
