#include "app/window/pages/curriculum_screen.h"

#include <algorithm>
#include <cmath>

#include "app/window/lessons/lesson_words.h"
#include "app/window/ui/button_row.h"
#include "app/window/ui/sparkline.h"
#include "scenarios/files/exercise_loader.h"

namespace trocar {
namespace {

constexpr double kListMargin = 16, kListGap = 10, kTree = 410, kListHead = 140, kPicture = 420, kMiddle = 312;

/// Too little room beside the tree for a card in parts: large text, or a small window.
bool compact_list(const Ui& ui) { return ui.width() < ui.px(1150) || ui.height() < ui.px(650); }

std::string score_words(const Translator& w, const std::optional<double>& score) {
  return score ? w.number(*score, 0) : w("none");
}

}  // namespace

Mark progress_mark(const LevelProgress& s) {
  if (!s.unlocked) return Mark::kLock;
  if (s.passed >= 2) return Mark::kTick;
  return s.passed == 1 ? Mark::kHalf : Mark::kOpen;
}

std::string progress_words(const Translator& w, const Exercise& exercise, const std::string& level,
                           const LevelProgress& s) {
  if (!s.unlocked) {
    const auto at = std::find_if(exercise.levels.begin(), exercise.levels.end(),
                                 [&](const ExerciseLevel& l) { return l.name == level; });
    const std::string before = at == exercise.levels.begin() || at == exercise.levels.end() ? "" : std::prev(at)->name;
    return w("{0}: needs {1} 3 x", {w(level), w(before)});
  }
  if (s.passed >= 2) return w("{0}: passed {1} x", {w(level), std::to_string(s.passed)});
  if (s.passed == 1) return w("{0}: passed once", {w(level)});
  return s.attempts > 0 ? w("{0}: tried", {w(level)}) : w("{0}: open", {w(level)});
}

void CurriculumScreen::load(PracticeModel& model) {
  rows_.clear();
  last_.reset();
  for (const Exercise& exercise : model.exercises()) {
    for (const ExerciseLevel& level : exercise.levels) {
      rows_.push_back({&exercise, level.name, model.progress(exercise.id, level.name)});
      const auto& newest = rows_.back().progress.newest_first;
      if (!newest.empty() && (!last_ || newest.front().started_utc > last_->started_utc))
        last_ = {exercise.id, level.name, newest.front().started_utc};
      if (exercise.id == model.exercise_id && level.name == model.level) chosen_ = rows_.size() - 1;
    }
  }
  next_ = model.next();
}

void CurriculumScreen::choose(PracticeModel& model, std::size_t row) {
  chosen_ = std::min(row, rows_.size() - 1);
  model.exercise_id = rows_[chosen_].exercise->id;
  model.level = rows_[chosen_].level;
  wrong_.clear();
}

void CurriculumScreen::keys(const Ui& ui, PracticeModel& model) {
  if (ui.pressed("Down") && chosen_ + 1 < rows_.size()) choose(model, chosen_ + 1);
  if (ui.pressed("Up") && chosen_ > 0) choose(model, chosen_ - 1);
  if (ui.pressed("Home")) choose(model, 0);
  if (ui.pressed("End")) choose(model, rows_.size() - 1);
}

void CurriculumScreen::tree(Ui& ui, PracticeModel& model, const Area& area) {
  const Translator& w = model.words();
  ui.begin_panel("course", area);
  if (!compact_list(ui)) ui.title(w("Course"));
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    if (i == 0 || row.exercise != rows_[i - 1].exercise)
      ui.heading(row.exercise->number + " " + w(row.exercise->title));
    const std::string id = row.exercise->id + row.level,
                      best = row.progress.best ? w.number(*row.progress.best, 0) : "";
    const std::string said = progress_words(w, *row.exercise, row.level, row.progress);
    if (ui.selectable(id.c_str(), progress_mark(row.progress), said, i == chosen_, best)) choose(model, i);
    if (i == chosen_ && revealed_ != chosen_) ui.reveal();
  }
  revealed_ = chosen_;
  ui.end_panel();
}

void CurriculumScreen::head(Ui& ui, PracticeModel& model) const {
  const Translator& w = model.words();
  ui.title(lesson_title(w, model.exercise(), model.level), model.who());
  ui.text(w(model.exercise().goal));
  ui.text(lesson_skill(w, model.exercise()), Ink::kDim);
}

void CurriculumScreen::facts(Ui& ui, PracticeModel& model, double sparkline_at_720) const {
  const Translator& w = model.words();
  const Row& row = rows_[chosen_];
  const LevelProgress& s = row.progress;
  const double pass = find_level(*row.exercise, row.level).rubric.pass_at;
  ui.marked(progress_mark(s), progress_words(w, *row.exercise, row.level, s));
  const std::string best = score_words(w, s.best), last = score_words(w, s.last);
  if (s.best || s.last)
    ui.text(w("Best {0}, last {1}, pass line {2}.", {best, last, w.number(pass, 0)}));
  else
    ui.text(w("Pass line: {0} of 100.", {w.number(pass, 0)}));
  const std::string tried = std::to_string(s.attempts), passed = std::to_string(s.passed),
                    row_of = std::to_string(std::min(3, s.passed_in_a_row));
  ui.text(w("Attempts {0}, passed {1}, in a row {2} of 3.", {tried, passed, row_of}), Ink::kDim);
  const std::vector<double> scores = scores_oldest_first(s);
  if (scores.empty())
    ui.text(w("The curve of your scores begins with the first attempt."), Ink::kDim);
  else if (sparkline_at_720 > 40)
    paint_sparkline(ui, w, ui.drawing("scores", sparkline_at_720), scores, pass);
}

void CurriculumScreen::advice(Ui& ui, PracticeModel& model) const {
  const Translator& w = model.words();
  if (const auto note = model.teacher_note()) {
    ui.heading(w("Your teacher"));
    ui.marked(Mark::kInfo, *note);
  }
  const auto& all = model.exercises();
  const auto at = std::find_if(all.begin(), all.end(), [this](const Exercise& e) { return e.id == next_.exercise_id; });
  ui.heading(w("Next for you"));
  if (at != all.end()) ui.marked(Mark::kPlay, lesson_title(w, *at, next_.level) + ": " + next_.why);
  if (!wrong_.empty()) ui.marked(Mark::kWarning, wrong_, Ink::kAlarm);
  programme(ui, model);
}

/// What is to be done of the trainee's programmes besides next_, the latest first: as much as there is room for.
void CurriculumScreen::programme(Ui& ui, const PracticeModel& model) const {
  constexpr int kShown = 2;
  const Translator& w = model.words();
  if (model.due().empty()) return;
  ui.heading(w("Your programme: {0} to do", {std::to_string(model.due().size())}));
  int shown = 0;
  for (const Reminder& one : model.due()) {
    const auto at = std::find_if(model.exercises().begin(), model.exercises().end(),
                                 [&one](const Exercise& e) { return e.id == one.step.exercise_id; });
    if (one.step.exercise_id == next_.exercise_id && one.step.level == next_.level) continue;
    if (++shown > kShown) return;
    const bool late = one.state == StepState::kOverdue;
    ui.marked(late ? Mark::kWarning : Mark::kOpen, lesson_title(w, *at, one.step.level) + ": " + model.due_words(one),
              late ? Ink::kAlarm : Ink::kText);
  }
}

void CurriculumScreen::caption(Ui& ui, const PracticeModel& model) const {
  const Area& a = picture_area_;
  const std::string said = picture_.caption(model.words());
  ui.paint_frame(a, Ink::kDim, 1);
  const double middle = a.y + a.height / 2 - ui.line_height() / 2;
  if (said.empty())
    return ui.text_at(a.x + a.width / 2, middle, model.words()("Picture is being made"), Ink::kDim, a.width, 0.5);
  const double wide = std::min(a.width, ui.text_width(said) + ui.px(16)), high = ui.line_height() + ui.px(8);
  ui.paint_ground({a.x, a.y + a.height - high, wide, high}, 0.85);
  ui.text_at(a.x + ui.px(8), a.y + a.height - high + ui.px(4), said, Ink::kDim, wide);
}

void CurriculumScreen::wide_card(Ui& ui, PracticeModel& model, const Area& area) {
  const double gap = ui.px(kListGap), head_high = ui.px(kListHead), middle = ui.px(kMiddle);
  const double picture = std::min(ui.px(kPicture), 0.55 * area.width);
  ui.begin_panel("card.head", {area.x, area.y, area.width, head_high});
  head(ui, model);
  ui.end_panel();
  const double y = area.y + head_high + gap;
  picture_area_ = {area.x, y, picture, middle};
  caption(ui, model);
  ui.begin_panel("card.facts", {area.x + picture + gap, y, area.width - picture - gap, middle});
  facts(ui, model, 130);
  ui.end_panel();
  const double below = y + middle + gap;
  ui.begin_panel("card.next", {area.x, below, area.width, area.y + area.height - below});
  advice(ui, model);
  ui.end_panel();
}

void CurriculumScreen::card(Ui& ui, PracticeModel& model, const Area& area) {
  if (!compact_list(ui)) return wide_card(ui, model, area);
  picture_area_ = {};
  ui.begin_panel("card", area);
  ui.scroll_by_keys();
  head(ui, model);
  ui.gap(4);
  facts(ui, model, 90);
  ui.gap(4);
  advice(ui, model);
  ui.end_panel();
}

std::optional<ScreenName> CurriculumScreen::act(const std::string& chosen, PracticeModel& model) {
  if (chosen == "brief") return ScreenName::kBriefing;
  if (chosen == "progress") return ScreenName::kProgress;
  if (chosen == "notch") return ScreenName::kNotch;
  if (chosen == "back") return ScreenName::kStart;
  if (chosen != "repeat" || !last_) return std::nullopt;
  model.exercise_id = last_->exercise_id;
  model.level = last_->level;
  load(model);
  if (find_level(model.exercise(), model.level).exam) return ScreenName::kBriefing;  // where the device is checked
  wrong_ = model.begin_attempt();
  return wrong_.empty() ? std::optional(ScreenName::kRun) : std::nullopt;
}

std::optional<ScreenName> CurriculumScreen::frame(Ui& ui, PracticeModel& model, double dt_s) {
  if (rows_.empty()) load(model);
  dt_s_ = dt_s;
  ui.keys_to_screen();
  keys(ui, model);
  const Translator& w = model.words();
  const double margin = ui.px(kListMargin), gap = ui.px(kListGap), wide = ui.width() - 2 * margin;
  std::vector<RowButton> buttons{{"brief", w("Briefing"), "Enter", true}};
  if (last_) buttons.push_back({"repeat", w("Repeat last"), "R"});
  buttons.push_back({"progress", w("Progress"), "P"});
  buttons.push_back({"notch", w("Feel the notch"), "N"});
  buttons.push_back({"back", w("Start page"), "Esc"});
  const double foot = button_rows_height(ui, buttons, wide), high = ui.height() - 2 * margin - foot - gap;
  const double tree_wide = std::min(ui.px(kTree), 0.5 * wide);
  tree(ui, model, {margin, margin, tree_wide, high});
  card(ui, model, {margin + tree_wide + gap, margin, wide - tree_wide - gap, high});
  ui.begin_strip("course.foot", {margin, margin + high + gap, wide, foot});
  const std::string chosen = button_rows(ui, buttons);
  ui.end_panel();
  return act(chosen, model);
}

std::optional<Screen::Stage> CurriculumScreen::stage(PracticeModel& model, int /*width*/, int /*height*/) {
  if (rows_.empty() || picture_area_.width <= 0) return std::nullopt;
  std::optional<SceneView> view = picture_.view(model, dt_s_);
  if (!view) return std::nullopt;
  return Stage{*view, picture_area_.x, picture_area_.y, picture_area_.width, picture_area_.height, 0};
}

}  // namespace trocar
