#include "app/window/run/briefing_screen.h"

#include <algorithm>
#include <chrono>

#include "app/window/lessons/lesson_icons.h"
#include "app/window/ui/button_row.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/kind.h"
#include "tissue/organ/organ.h"

namespace trocar {
namespace {

constexpr double kMargin = 16, kBriefingGap = 10, kBriefingHead = 92, kIcon = 40, kLargeIcon = 66, kLimits = 290,
                 kStage = 158;

bool compact(const Ui& ui) { return ui.width() < ui.px(1150) || ui.height() < ui.px(690); }

/// Origin and licence of the organ; empty: it cannot be loaded, which starting an attempt will say.
std::string credit_of(const std::string& name, const AssetRoots& assets) {
  try {
    return load_organ(find_organ(name, assets.assets)).credit;
  } catch (const std::exception&) {
    return "";
  }
}

/// The level that opens the chosen one.
std::string level_before(const PracticeDesk& desk) {
  const std::vector<ExerciseLevel>& levels = desk.exercise().levels;
  const auto at =
      std::find_if(levels.begin(), levels.end(), [&](const ExerciseLevel& one) { return one.name == desk.level; });
  return at == levels.begin() || at == levels.end() ? desk.level : std::prev(at)->name;
}

Mark check_mark(DeviceCheck::State state) {
  switch (state) {
    case DeviceCheck::State::kPassed:
      return Mark::kTick;
    case DeviceCheck::State::kFailed:
      return Mark::kWarning;
    case DeviceCheck::State::kRunning:
      return Mark::kHalf;
    case DeviceCheck::State::kWaiting:
      return Mark::kOpen;
  }
  return Mark::kOpen;
}

std::string check_name(const Words& w, DeviceCheck::What what) {
  switch (what) {
    case DeviceCheck::What::kBoard:
      return w("Board and inputs");
    case DeviceCheck::What::kWeight:
      return w("Weight left over");
    case DeviceCheck::What::kFriction:
      return w("Friction");
    case DeviceCheck::What::kPassivity:
      return w("Passive contact");
  }
  return "";
}

}  // namespace

std::string check_words(const Words& w, const DeviceCheck::Line& line) {
  const std::string name = check_name(w, line.what);
  if (line.state == DeviceCheck::State::kWaiting) return w("{0}: waits", {name});
  if (line.state == DeviceCheck::State::kRunning) return w("{0}: being measured", {name});
  if (!line.detail.empty()) return name + ": " + line.detail;
  switch (line.what) {
    case DeviceCheck::What::kBoard:
      return w("{0}: {1} of {2} checks passed",
               {name, w.number(line.count - line.value, 0), std::to_string(line.count)});
    case DeviceCheck::What::kPassivity:
      return w("{0}: {1} mJ given back (limit {2})",
               {name, w.number(1e3 * line.value, 2), w.number(1e3 * line.limit, 1)});
    case DeviceCheck::What::kWeight:
    case DeviceCheck::What::kFriction:
      break;
  }
  return w("{0}: {1} N (limit {2})", {name, w.number(line.value, 2), w.number(line.limit, 2)});
}

void BriefingScreen::load(PracticeDesk& desk) {
  if (!check_) {
    SimulatedDaqConfig device;
    check_ = std::make_unique<DeviceCheck>(device, limits_);
  }
  if (!organ_.valid()) organ_ = std::async(std::launch::async, credit_of, desk.organ, desk.assets());
  if (credit_.empty() && organ_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) credit_ = organ_.get();
  const std::string now = desk.exercise_id + "/" + desk.level + "/" + desk.words().language();
  if (now == shown_) return;
  shown_ = now;
  locked_ = desk.locked();
  const Exercise& exercise = desk.exercise();
  const ExerciseLevel& level = find_level(exercise, desk.level);
  steps_ = lesson_steps(desk.words(), exercise, level);
  rows_ = lesson_limits(desk.words(), exercise, level);
  measures_ = lesson_measures(desk.words(), level);
}

void BriefingScreen::steps(Ui& ui) const {
  const double fits = ui.room_below() / ui.px(1) / static_cast<double>(steps_.size()) - 8;
  const double each = compact(ui) ? kIcon : std::clamp(fits, kIcon, kLargeIcon);
  const double side = ui.px(each);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Area row = ui.placed(each);
    paint_step(ui, steps_[i].icon, {row.x, row.y, side, side});
    const double x = row.x + side + ui.px(14), room = row.x + row.width - x;
    ui.text_in({x, row.y, room, side}, std::to_string(i + 1) + ". " + steps_[i].text);
  }
}

void BriefingScreen::stage_words(Ui& ui, PracticeDesk& desk) const {
  const Words& w = desk.words();
  const Exercise& exercise = desk.exercise();
  const ExerciseLevel& level = find_level(exercise, desk.level);
  ui.text(lesson_tool(w, exercise, level));
  const auto key = [&](Action action) { return w.name(key_name(desk.keys().key_of(action))); };
  ui.text(lesson_scope(w, desk.scope(), key(Action::kPostLeft), key(Action::kPostRight)));
  if (kind_of(exercise).on_organ)
    ui.text(credit_.empty() ? w("On the organ {0}.", {desk.organ}) : w.made(credit_), Ink::kDim);
  else
    ui.text(w("On a training board; each attempt has another layout."), Ink::kDim);
  ui.text(lesson_display(w, level), Ink::kAccent);
}

void BriefingScreen::limits(Ui& ui, PracticeDesk& desk) const {
  ui.heading(desk.words()("Limits"));
  for (const LessonLimit& row : rows_) ui.pair(row.what, row.value);
}

void BriefingScreen::measures(Ui& ui, PracticeDesk& desk) const {
  const Words& w = desk.words();
  ui.heading(w("What is measured"));
  for (const LessonMeasure& m : measures_) ui.pair(m.gate.empty() ? m.name : w("{0} (safety)", {m.name}), m.weight);
  const double pass = find_level(desk.exercise(), desk.level).rubric.pass_at;
  ui.text(w("Pass from {0} of 100. M explains each measure.", {w.number(pass, 0)}), Ink::kDim);
}

void BriefingScreen::device(Ui& ui, PracticeDesk& desk) const {
  const Words& w = desk.words();
  ui.heading(w("Device check: simulated device"));
  for (const DeviceCheck::Line& line : check_->lines())
    ui.marked(check_mark(line.state), check_words(w, line),
              line.state == DeviceCheck::State::kFailed ? Ink::kAlarm : Ink::kText);
}

std::optional<ScreenName> BriefingScreen::start(PracticeDesk& desk) {
  const Words& w = desk.words();
  if (find_level(desk.exercise(), desk.level).exam && !check_->sound()) {
    wrong_ = check_->finished() ? w("No exam on a device that fails its check. Other levels may be practised.")
                                : w("An exam waits for the device check: try again in a moment.");
    return std::nullopt;
  }
  wrong_ = desk.begin_attempt();
  return wrong_.empty() ? std::optional(ScreenName::kRun) : std::nullopt;
}

void BriefingScreen::head(Ui& ui, PracticeDesk& desk) const {
  const Words& w = desk.words();
  ui.title(lesson_title(w, desk.exercise(), desk.level), desk.who());
  ui.text(w(desk.exercise().goal));
  if (!locked_.empty()) ui.marked(Mark::kLock, locked_, Ink::kCaution);
  if (!wrong_.empty()) ui.marked(Mark::kWarning, wrong_, Ink::kAlarm);
}

/// Large text or a small window: one column.
void BriefingScreen::column(Ui& ui, PracticeDesk& desk, const Area& area) {
  ui.begin_panel("briefing", area);
  ui.scroll_by_keys();
  head(ui, desk);
  steps(ui);
  limits(ui, desk);
  measures(ui, desk);
  stage_words(ui, desk);
  device(ui, desk);
  ui.end_panel();
}

void BriefingScreen::sheet(Ui& ui, PracticeDesk& desk, const Area& area) {
  const double gap = ui.px(kBriefingGap),
               head_high = ui.px(kBriefingHead + (wrong_.empty() ? 0 : 26) + (locked_.empty() ? 0 : 26)),
               left = 0.5 * (area.width - gap);
  const double top = area.y + head_high + gap, below = area.y + area.height - top, stage_high = ui.px(kStage),
               limits_high = ui.px(kLimits);
  const double x = area.x + left + gap, half = 0.56 * (left - gap);
  const auto panel = [&](const char* id, const Area& place, const auto& inside) {
    ui.begin_panel(id, place);
    inside();
    ui.end_panel();
  };
  panel("briefing.head", {area.x, area.y, area.width, head_high}, [&] { head(ui, desk); });
  panel("briefing.steps", {area.x, top, left, below - stage_high - gap}, [&] { steps(ui); });
  panel("briefing.stage", {area.x, top + below - stage_high, left, stage_high}, [&] { stage_words(ui, desk); });
  panel("briefing.limits", {x, top, half, limits_high}, [&] { limits(ui, desk); });
  panel("briefing.measures", {x + half + gap, top, left - half - gap, limits_high}, [&] { measures(ui, desk); });
  panel("briefing.device", {x, top + limits_high + gap, left, below - limits_high - gap}, [&] { device(ui, desk); });
}

std::string BriefingScreen::page(Ui& ui, PracticeDesk& desk) {
  const Words& w = desk.words();
  const double m = ui.px(kMargin), gap = ui.px(kBriefingGap), wide = ui.width() - 2 * m;
  const RowButton first = locked_.empty() ? RowButton{"start", w("Start"), "Enter", true}
                                          : RowButton{"before", w("Go to {0}", {w(level_before(desk))}), "Enter", true};
  const std::vector<RowButton> buttons{first,
                                       {"explain", w("Measures explained"), "M"},
                                       {"watch", w("Watch the expert"), "V"},
                                       {"back", w("Course"), "Esc"}};
  const double foot = button_rows_height(ui, buttons, wide), high = ui.height() - 2 * m - foot - gap;
  if (compact(ui))
    column(ui, desk, {m, m, wide, high});
  else
    sheet(ui, desk, {m, m, wide, high});
  ui.begin_strip("briefing.foot", {m, m + high + gap, wide, foot});
  const std::string chosen = button_rows(ui, buttons);
  ui.end_panel();
  return chosen;
}

std::string BriefingScreen::explanation(Ui& ui, PracticeDesk& desk) {
  const Words& w = desk.words();
  const double m = ui.px(kMargin), gap = ui.px(kBriefingGap), wide = ui.width() - 2 * m;
  const std::vector<RowButton> buttons{{"close", w("Back to the briefing"), "M", true}};
  const double foot = button_rows_height(ui, buttons, wide), high = ui.height() - 2 * m - foot - gap;
  const double left = std::min(ui.px(380), 0.42 * wide);
  if (ui.pressed("Down") && measure_ + 1 < measures_.size()) ++measure_;
  if (ui.pressed("Up") && measure_ > 0) --measure_;
  ui.begin_panel("measures", {m, m, left, high});
  ui.heading(w("What is measured"));
  for (std::size_t i = 0; i < measures_.size(); ++i)
    if (ui.selectable(measures_[i].metric.c_str(), Mark::kNone, measures_[i].name, i == measure_, measures_[i].weight))
      measure_ = i;
  ui.end_panel();
  const LessonMeasure& chosen = measures_[measure_];
  ui.begin_panel("measure", {m + left + gap, m, wide - left - gap, high});
  ui.scroll_by_keys();
  ui.title(chosen.name);
  ui.text(chosen.meaning);
  ui.pair(w("Weight"), chosen.weight);
  ui.pair(w("Full at"), chosen.full);
  ui.pair(w("Nothing at"), chosen.none);
  ui.pair(w("Name in tables"), chosen.metric);
  if (!chosen.gate.empty()) ui.marked(Mark::kWarning, chosen.gate, Ink::kCaution);
  ui.gap();
  ui.text(lesson_rule(w, find_level(desk.exercise(), desk.level).rubric), Ink::kDim);
  ui.end_panel();
  ui.begin_strip("measures.foot", {m, m + high + gap, wide, foot});
  const std::string button = button_rows(ui, buttons);
  ui.end_panel();
  return button;
}

void BriefingScreen::settle(PracticeDesk& desk, double wait_s) {
  load(desk);
  check_->wait(wait_s);
  organ_.wait_for(std::chrono::duration<double>(wait_s));
}

std::optional<ScreenName> BriefingScreen::frame(Ui& ui, PracticeDesk& desk, double /*dt_s*/) {
  ui.keys_to_screen();
  load(desk);
  const std::string chosen = explaining_ ? explanation(ui, desk) : page(ui, desk);
  if (chosen == "explain" || chosen == "close") {
    explaining_ = !explaining_;
    measure_ = std::min(measure_, measures_.size() - 1);
  }
  if (chosen == "start") return start(desk);
  if (chosen == "before") desk.level = level_before(desk);
  if (chosen == "back") return ScreenName::kCurriculum;
  if (chosen == "watch") {
    desk.replay_file = desk.expert_recording();
    if (!desk.replay_file.empty()) return ScreenName::kReplay;
    wrong_ = desk.words()("The expert's run is being made: try again in a moment.");
  }
  return std::nullopt;
}

}  // namespace trocar
