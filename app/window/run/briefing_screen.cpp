#include "app/window/run/briefing_screen.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/picture/attempt/attempt_scene.h"
#include "app/window/attempt/number_words.h"
#include "app/window/lessons/lesson_icons.h"
#include "app/window/run/first_run_hints.h"
#include "app/window/ui/button_row.h"
#include "haptics/device/backends/make_backend.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/kinds/camera/camera_rules.h"
#include "scenarios/kinds/kind.h"
#include "tissue/organ/organ.h"

namespace trocar {
namespace {

constexpr double kMargin = 16, kBriefingGap = 10, kBriefingHead = 92, kIcon = 40, kLargeIcon = 66, kLimits = 275,
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
std::string level_before(const PracticeModel& model) {
  const std::vector<ExerciseLevel>& levels = model.exercise().levels;
  const auto at =
      std::find_if(levels.begin(), levels.end(), [&](const ExerciseLevel& one) { return one.name == model.level; });
  return at == levels.begin() || at == levels.end() ? model.level : std::prev(at)->name;
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

std::string check_name(const Translator& w, DeviceCheck::What what) {
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

std::string check_words(const Translator& w, const DeviceCheck::Line& line) {
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

void BriefingScreen::load(PracticeModel& model) {
  const bool pointer = model.at_pointer();
  if (!check_ && !pointer && !is_real_device(model.backend()))
    check_ = std::make_unique<DeviceCheck>(SimulatedDaqConfig{}, limits_, model.backend());
  if (!organ_.valid()) organ_ = std::async(std::launch::async, credit_of, model.organ, model.assets());
  if (credit_.empty() && organ_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) credit_ = organ_.get();
  const std::string now =
      model.exercise_id + "/" + model.level + "/" + model.words().language() + (pointer ? "/pointer" : "");
  if (now == shown_) return;
  shown_ = now;
  locked_ = model.locked();
  const Exercise& exercise = model.exercise();
  const ExerciseLevel& level = find_level(exercise, model.level);
  steps_ = lesson_steps(model.words(), exercise, level, pointer);
  rows_ = lesson_limits(model.words(), exercise, level);
  measures_ = lesson_measures(model.words(), level, pointer);
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

void BriefingScreen::stage_words(Ui& ui, PracticeModel& model) const {
  const Translator& w = model.words();
  const Exercise& exercise = model.exercise();
  const ExerciseLevel& level = find_level(exercise, model.level);
  ui.text(lesson_tool(w, exercise, level, model.at_pointer()));
  const auto key = [&](Action action) { return w.name(key_name(model.keys().key_of(action))); };
  ui.text(is_scope(exercise) ? w("Scope {0}, in your hand.", {degrees(w, own_rules<CameraLevel>(level).tilt_rad)})
                             : lesson_scope(w, model.scope(), key(Action::kPostLeft), key(Action::kPostRight)));
  if (kind_of(exercise).on_organ)
    ui.text(credit_.empty() ? w("On the organ {0}.", {model.organ}) : w.made(credit_), Ink::kDim);
  else
    ui.text(w("On a training board; each attempt has another layout."), Ink::kDim);
  ui.text(lesson_display(w, exercise, level, model.at_pointer()), Ink::kAccent);
}

void BriefingScreen::limits(Ui& ui, PracticeModel& model) const {
  ui.heading(model.words()("Limits"));
  for (const LessonLimit& row : rows_) ui.pair(row.what, row.value);
}

void BriefingScreen::measures(Ui& ui, PracticeModel& model) const {
  const Translator& w = model.words();
  ui.heading(w("What is measured"));
  const Exercise& exercise = model.exercise();
  const Rubric& rubric = find_level(exercise, model.level).rubric;
  for (const ExerciseStage& stage : exercise.stages) {  // each is more than a line has room for
    double weight = 0;
    for (const SubscoreRule& rule : rubric.subscores)
      if (&judged_part(exercise, rule.metric) == stage.exercise.get()) weight += rule.weight;
    ui.pair(w("{0} (safety)", {w(stage.exercise->title)}), w("{0} %", {brief(w, std::round(1000 * weight) / 10)}));
  }
  for (const LessonMeasure& m : measures_)
    if (&judged_part(exercise, m.metric) == &exercise)
      ui.pair(m.gate.empty() ? m.name : w("{0} (safety)", {m.name}), m.weight);
  const double pass = rubric.pass_at;
  ui.text(w("Pass from {0} of 100. M explains each measure.", {w.number(pass, 0)}), Ink::kDim);
}

/// What moves what, or whether the device is as it should be.
void BriefingScreen::hand(Ui& ui, PracticeModel& model) const {
  const Translator& w = model.words();
  if (model.at_pointer()) {
    FirstRunHints hints;
    hints.begin(false, hand_tries(model.exercise(), find_level(model.exercise(), model.level)));
    ui.heading(w("How to move"));
    for (const FirstRunHints::Hint& hint : hints.marks(w, model.keys(), model.steering().kind())) ui.text(hint.text);
    ui.text(w("No device is needed. F1 lists every key."), Ink::kDim);
    return;
  }
  const std::string device = model.backend();
  if (is_real_device(device)) {
    ui.heading(w("Device: {0}", {device}));
    ui.text(w("It is checked as each attempt begins: self-test, then homing in its jig. No torque before both."));
    return;
  }
  ui.heading(device == kSimulatedBackend ? w("Device check: simulated device")
                                         : w("Device check: simulated device behind {0}", {device}));
  for (const DeviceCheck::Line& line : check_->lines())
    ui.marked(check_mark(line.state), check_words(w, line),
              line.state == DeviceCheck::State::kFailed ? Ink::kAlarm : Ink::kText);
}

std::optional<ScreenName> BriefingScreen::start(PracticeModel& model) {
  const Translator& w = model.words();
  const bool checked = model.at_pointer() || is_real_device(model.backend()) || check_->sound();
  if (find_level(model.exercise(), model.level).exam && !checked) {
    wrong_ = check_->finished() ? w("No exam on a device that fails its check. Other levels may be practised.")
                                : w("An exam waits for the device check: try again in a moment.");
    return std::nullopt;
  }
  wrong_ = model.begin_attempt();
  return wrong_.empty() ? std::optional(ScreenName::kRun) : std::nullopt;
}

void BriefingScreen::head(Ui& ui, PracticeModel& model) const {
  const Translator& w = model.words();
  ui.title(lesson_title(w, model.exercise(), model.level), model.who());
  ui.text(w(model.exercise().goal));
  if (!locked_.empty()) ui.marked(Mark::kLock, locked_, Ink::kCaution);
  if (!wrong_.empty()) ui.marked(Mark::kWarning, wrong_, Ink::kAlarm);
}

/// Large text or a small window: one column.
void BriefingScreen::column(Ui& ui, PracticeModel& model, const Area& area) {
  ui.begin_panel("briefing", area);
  ui.scroll_by_keys();
  head(ui, model);
  steps(ui);
  limits(ui, model);
  measures(ui, model);
  stage_words(ui, model);
  hand(ui, model);
  ui.end_panel();
}

void BriefingScreen::sheet(Ui& ui, PracticeModel& model, const Area& area) {
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
  panel("briefing.head", {area.x, area.y, area.width, head_high}, [&] { head(ui, model); });
  panel("briefing.steps", {area.x, top, left, below - stage_high - gap}, [&] { steps(ui); });
  panel("briefing.stage", {area.x, top + below - stage_high, left, stage_high}, [&] { stage_words(ui, model); });
  panel("briefing.limits", {x, top, half, limits_high}, [&] { limits(ui, model); });
  panel("briefing.measures", {x + half + gap, top, left - half - gap, limits_high}, [&] { measures(ui, model); });
  panel("briefing.hand", {x, top + limits_high + gap, left, below - limits_high - gap}, [&] { hand(ui, model); });
}

std::string BriefingScreen::page(Ui& ui, PracticeModel& model) {
  const Translator& w = model.words();
  const double m = ui.px(kMargin), gap = ui.px(kBriefingGap), wide = ui.width() - 2 * m;
  const RowButton first = locked_.empty()
                              ? RowButton{"start", w("Start"), "Enter", true}
                              : RowButton{"before", w("Go to {0}", {w(level_before(model))}), "Enter", true};
  const std::vector<RowButton> buttons{first,
                                       {"explain", w("Measures explained"), "M"},
                                       {"watch", w("Watch the expert"), "V"},
                                       {"back", w("Course"), "Esc"}};
  const double foot = button_rows_height(ui, buttons, wide), high = ui.height() - 2 * m - foot - gap;
  if (compact(ui))
    column(ui, model, {m, m, wide, high});
  else
    sheet(ui, model, {m, m, wide, high});
  ui.begin_strip("briefing.foot", {m, m + high + gap, wide, foot});
  const std::string chosen = button_rows(ui, buttons);
  ui.end_panel();
  return chosen;
}

std::string BriefingScreen::explanation(Ui& ui, PracticeModel& model) {
  const Translator& w = model.words();
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
  ui.text(lesson_rule(w, find_level(model.exercise(), model.level).rubric), Ink::kDim);
  ui.end_panel();
  ui.begin_strip("measures.foot", {m, m + high + gap, wide, foot});
  const std::string button = button_rows(ui, buttons);
  ui.end_panel();
  return button;
}

void BriefingScreen::settle(PracticeModel& model, double wait_s) {
  load(model);
  if (check_) check_->wait(wait_s);
  organ_.wait_for(std::chrono::duration<double>(wait_s));
}

std::optional<ScreenName> BriefingScreen::frame(Ui& ui, PracticeModel& model, double /*dt_s*/) {
  ui.keys_to_screen();
  load(model);
  const std::string chosen = explaining_ ? explanation(ui, model) : page(ui, model);
  if (chosen == "explain" || chosen == "close") {
    explaining_ = !explaining_;
    measure_ = std::min(measure_, measures_.size() - 1);
  }
  if (chosen == "start") return start(model);
  if (chosen == "before") model.level = level_before(model);
  if (chosen == "back") return ScreenName::kCurriculum;
  if (chosen == "watch") {
    model.replay_file = model.expert_recording();
    if (!model.replay_file.empty()) return ScreenName::kReplay;
    wrong_ = model.words()("The expert's run is being made: try again in a moment.");
  }
  return std::nullopt;
}

}  // namespace trocar
