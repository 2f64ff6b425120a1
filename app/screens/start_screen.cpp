#include "app/screens/start_screen.h"

#include <algorithm>

#include "app/screens/practice_desk.h"
#include "app/screens/show_scene.h"
#include "app/screens/ui.h"

namespace trocar {
namespace {

constexpr double kPanelWidth = 500, kMargin = 24;
constexpr double kFirstWait_s = 1.0;   // for the scene: the first frame is lit if it can be

/// px that are left to the scene beside the panel; 0: it lies behind it.
double free_width(const Ui& ui, double panel_right) {
  const double left = ui.width() - panel_right;
  return left >= 0.4 * ui.width() ? left : 0;
}

/// What a guest is led to: the exercise that is felt, else the first.
void choose_first(PracticeDesk& desk) {
  const auto& all = desk.exercises();
  const auto touch = std::find_if(all.begin(), all.end(), [](const Exercise& e) { return e.kind == ExerciseKind::kTouch; });
  desk.exercise_id = touch == all.end() ? all.front().id : touch->id;
  desk.level = desk.exercise().levels.front().name;
}

}  // namespace

std::optional<Screen::Stage> StartScreen::stage(PracticeDesk& desk, int width, int height) {
  if (!scene_) {
    scene_ = desk.show_scene(t_s_ == 0 ? kFirstWait_s : 0);
    if (scene_) organ_T_ = std::make_shared<const TriangleSurface>(scene_->organ_T);
    if (scene_) film_ = std::make_unique<FilmLoop>(scene_->setup, desk.assets());
  }
  if (!scene_) return {};
  Stage stage;
  stage.view = film_->ready() ? film_->view() : show_view(*scene_, organ_T_, t_s_);
  const double left = panel_right_ > 0 && width - panel_right_ >= 0.4 * width ? panel_right_ : 0;
  stage.x = left;
  stage.width = width - left;
  stage.height = height;
  stage.dim = left > 0 ? 0 : 0.45;
  return stage;
}

std::optional<ScreenName> StartScreen::guest_part(Ui& ui, PracticeDesk& desk) {
  const Words& w = desk.words();
  std::optional<ScreenName> to;
  if (ui.button("try", w("Try now as a guest"), "Enter", true, kPanelWidth - 36)) {
    choose_first(desk);
    to = ScreenName::kBriefing;
  }
  ui.text(w("No account, mouse and keyboard are enough."), Ink::kDim);
  ui.gap(6);
  ui.heading(w("Sign in"));
  const bool entered = ui.field("code", w("Your code"), code_);
  if (ui.button("signin", w("Sign in")) || entered) {
    wrong_ = desk.sign_in(code_);
    if (wrong_.empty()) to = ScreenName::kCurriculum;
  }
  if (!wrong_.empty()) ui.marked(Mark::kWarning, wrong_, Ink::kAlarm);
  return to;
}

std::optional<ScreenName> StartScreen::trainee_part(Ui& ui, PracticeDesk& desk) {
  const Words& w = desk.words();
  const PracticeDesk::Advice advice = desk.next();
  std::optional<ScreenName> to;
  ui.marked(Mark::kTick, w("Signed in as {0}", {desk.trainee()}));
  if (ui.button("next", w("Next: {0} {1}", {advice.exercise_id, advice.level}), "Enter", true, kPanelWidth - 36)) {
    desk.exercise_id = advice.exercise_id;
    desk.level = advice.level;
    to = ScreenName::kBriefing;
  }
  ui.text(advice.why, Ink::kDim);
  if (ui.button("exercises", w("All exercises"))) to = ScreenName::kCurriculum;
  ui.same_line();
  if (ui.button("progress", w("My progress"))) to = ScreenName::kProgress;
  ui.same_line();
  if (ui.button("signout", w("Sign out"))) desk.sign_out();
  return to;
}

std::optional<ScreenName> StartScreen::foot(Ui& ui, PracticeDesk& desk) {
  const Words& w = desk.words();
  std::optional<ScreenName> to;
  if (languages_.empty()) languages_ = languages(desk.assets().assets / "languages");
  std::vector<std::string> names;
  int chosen = 0;
  for (const Language& language : languages_) {
    if (language.code == desk.words().language()) chosen = static_cast<int>(names.size());
    names.push_back(language.name);
  }
  if (names.size() > 1 && ui.choice("language", w("Language"), names, chosen)) {
    desk.settings().language = languages_[static_cast<std::size_t>(chosen)].code;
    desk.settings_changed();
  }
  const auto resize = [&](double by) {
    desk.settings().scale = std::clamp(desk.scale() + by, 1.0, 2.0);
    desk.settings_changed();
  };
  if (ui.button("smaller", w("Smaller"), "-")) resize(-0.25);
  ui.same_line();
  if (ui.button("larger", w("Larger"), "=")) resize(0.25);
  ui.same_line();
  if (ui.button("settings", w("Settings"))) to = ScreenName::kSettings;
  return to;
}

/// What is seen, and where it comes from; beside the device that is used.
void StartScreen::caption(Ui& ui, const PracticeDesk& desk) const {
  const Words& w = desk.words();
  const double free = free_width(ui, panel_right_);
  if (!scene_ || free <= 0) return;
  const double room = free - ui.px(2 * kMargin), x = panel_right_ + ui.px(kMargin), high = ui.line_height();
  const double y = ui.height() - 2 * high - ui.px(22), pad = ui.px(10);
  const std::string seen = film_->ready() ? w("Replay of the expert: {0}", {scene_->organ.name}) : w("Still scene: {0}", {scene_->organ.name});
  const double wide = std::min(room, std::max(ui.text_width(scene_->organ.credit), ui.text_width(seen)));
  ui.paint_ground({x - pad, y - pad / 2, wide + 2 * pad, 2 * high + ui.px(4) + pad}, 0.85, ui.px(6));
  ui.text_at(x, y, seen, Ink::kText, room);
  ui.text_at(x, y + high + ui.px(4), scene_->organ.credit, Ink::kDim, room);
}

std::optional<ScreenName> StartScreen::frame(Ui& ui, PracticeDesk& desk, double dt_s) {
  t_s_ += dt_s;
  if (film_) film_->advance(dt_s);
  const Words& w = desk.words();
  const double margin = std::min(ui.px(kMargin), 0.02 * ui.width());
  const Area area{margin, margin, std::min(ui.px(kPanelWidth), ui.width() - 2 * margin), ui.height() - 2 * margin};
  panel_right_ = area.x + area.width;
  caption(ui, desk);
  ui.begin_panel("start", area);
  ui.title("Trocar");
  ui.text(w("Practise laparoscopy and feel what you touch."), Ink::kDim);
  ui.gap(10);
  std::optional<ScreenName> to = desk.is_guest() ? guest_part(ui, desk) : trainee_part(ui, desk);
  ui.to_bottom(246);
  ui.heading(w("Teacher"));
  ui.text(w("Results, trends and export: trocar cohort, trocar trainee show."), Ink::kDim);
  ui.gap(10);
  if (const auto chosen = foot(ui, desk)) to = chosen;
  ui.gap(4);
  ui.marked(Mark::kInfo, w("Device: simulated, loop at 1000 Hz. F1 help, Esc menu."), Ink::kDim);
  ui.end_panel();
  return to;
}

}  // namespace trocar
