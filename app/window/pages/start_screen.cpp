#include "app/window/pages/start_screen.h"

#include <algorithm>
#include <utility>

#include "app/window/pages/show_scene.h"
#include "app/window/practice/practice_model.h"
#include "app/window/ui/theme.h"
#include "app/window/ui/ui.h"
#include "haptics/device/backends/make_backend.h"

namespace trocar {
namespace {

constexpr double kPanelWidth = 500, kStartMargin = 24;
constexpr double kFirstWait_s = 1.0;  // for the scene: the first frame is lit if it can be

/// Where the panel stands: left of the scene, or over it where there is no room for both.
Area panel_area(double scale, double width, double height) {
  const double unit = ui_unit(scale, width, height), margin = std::min(unit * kStartMargin, 0.02 * width);
  const double wide = std::min(unit * kPanelWidth, width - 2 * margin);
  const bool beside = width - margin - wide >= 0.4 * width;
  return {margin, margin, beside ? wide : width - 2 * margin, height - 2 * margin};
}

/// px that are left to the scene beside the panel; 0: it lies behind it.
double free_width(const Area& panel, double width) {
  const double left = width - panel.x - panel.width;
  return left >= 0.4 * width ? left : 0;
}

std::string title_of(const PracticeModel& model, const std::string& id) {
  for (const Exercise& exercise : model.exercises())
    if (exercise.id == id) return exercise.number + " " + model.words()(exercise.title);
  return id;
}

}  // namespace

std::optional<Screen::Stage> StartScreen::stage(PracticeModel& model, int width, int height) {
  if (!scene_) scene_ = model.show_scene(t_s_ == 0 ? kFirstWait_s : 0);
  if (!scene_) return {};
  if (!film_) film_ = std::make_unique<FilmLoop>(model.show_setup(), model.assets());
  Stage stage;
  stage.view = film_->ready() ? film_->view() : show_view(*scene_, t_s_);
  const double beside = free_width(panel_area(model.scale(), width, height), width);
  stage.x = beside > 0 ? width - beside : 0;
  stage.width = beside > 0 ? beside : width;
  stage.height = height;
  stage.dim = beside > 0 ? 0 : 0.45;
  return stage;
}

std::optional<ScreenName> StartScreen::guest_part(Ui& ui, PracticeModel& model) {
  const Translator& w = model.words();
  std::optional<ScreenName> to;
  const bool coded = !code_.empty();  // what Enter means is blue
  if (ui.button("try", w("Try now as a guest"), coded ? "" : "Enter", !coded, kPanelWidth - 36)) {
    const PracticeModel::Advice advice = model.next();
    model.exercise_id = advice.exercise_id;
    model.level = advice.level;
    to = ScreenName::kBriefing;
  }
  ui.text(w("No account, mouse and keyboard are enough."), Ink::kDim);
  if (const auto chosen = plays(ui, model)) to = chosen;
  ui.gap(6);
  ui.heading(w("Sign in"));
  const bool entered = ui.field("code", w("Your code"), code_);
  if (ui.button("signin", w("Sign in"), coded ? "Enter" : "", coded) || entered) {
    asked_ = model.code_asks(code_);
    pin_begins_ = asked_ == PracticeModel::CodeAsks::kPin;
    if (asked_ == PracticeModel::CodeAsks::kNothing)
      to = sign_in(model);
    else
      wrong_.clear();
  }
  if (!wrong_.empty()) ui.marked(Mark::kWarning, wrong_, Ink::kAlarm);
  return to;
}

/// With what has been typed.
std::optional<ScreenName> StartScreen::sign_in(PracticeModel& model) {
  wrong_ = model.sign_in(code_, pin_);
  pin_.clear();
  pin_begins_ = asked_ == PracticeModel::CodeAsks::kPin;
  if (!wrong_.empty()) return {};
  asked_ = PracticeModel::CodeAsks::kNothing;
  return ScreenName::kCurriculum;
}

/// A slip of the keys makes no trainee.
std::optional<ScreenName> StartScreen::new_code_part(Ui& ui, PracticeModel& model) {
  const Translator& w = model.words();
  std::optional<ScreenName> to;
  ui.heading(w("Nobody has the code {0}", {code_}));
  ui.text(w("Was it typed as you always write it? A new trainee begins with no attempts."), Ink::kDim);
  const bool back = ui.button("back", w("Back to the code"), "Enter", true, kPanelWidth - 36);
  if (ui.button("new", w("New trainee {0}", {code_}), "", false, kPanelWidth - 36)) to = sign_in(model);
  if (back || ui.pressed("Esc")) asked_ = PracticeModel::CodeAsks::kNothing;
  if (!wrong_.empty()) ui.marked(Mark::kWarning, wrong_, Ink::kAlarm);
  return to;
}

std::optional<ScreenName> StartScreen::pin_part(Ui& ui, PracticeModel& model) {
  const Translator& w = model.words();
  std::optional<ScreenName> to;
  ui.heading(w("Sign in as {0}", {code_}));
  if (std::exchange(pin_begins_, false)) ui.focus_next();
  const bool entered = ui.field("pin", w("PIN or password"), pin_, true);
  if (ui.button("signin", w("Sign in"), "Enter", true) || entered) to = sign_in(model);
  ui.same_line();
  if (ui.button("back", w("Another code")) || ui.pressed("Esc")) {
    asked_ = PracticeModel::CodeAsks::kNothing;
    pin_.clear();
    wrong_.clear();
  }
  if (!wrong_.empty()) ui.marked(Mark::kWarning, wrong_, Ink::kAlarm);
  ui.text(w("Your teacher gave it to you, and can give a new one."), Ink::kDim);
  return to;
}

std::optional<ScreenName> StartScreen::trainee_part(Ui& ui, PracticeModel& model) {
  const Translator& w = model.words();
  const PracticeModel::Advice advice = model.next();
  std::optional<ScreenName> to;
  ui.marked(Mark::kTick, w("Signed in as {0}", {model.trainee()}));
  if (ui.button("next", w("Next: {0}, {1}", {title_of(model, advice.exercise_id), advice.level}), "Enter", true,
                kPanelWidth - 36)) {
    model.exercise_id = advice.exercise_id;
    model.level = advice.level;
    to = ScreenName::kBriefing;
  }
  ui.text(advice.why, Ink::kDim);
  if (ui.button("exercises", w("All exercises"))) to = ScreenName::kCurriculum;
  ui.same_line();
  if (ui.button("progress", w("My progress"))) to = ScreenName::kProgress;
  ui.same_line();
  if (ui.button("signout", w("Sign out"))) model.sign_out();
  if (const auto chosen = plays(ui, model)) to = chosen;
  return to;
}

/// What is not graded.
std::optional<ScreenName> StartScreen::plays(Ui& ui, PracticeModel& model) {
  const Translator& w = model.words();
  std::optional<Play> chosen;
  if (ui.button("tutorial", w("Tutorial"))) chosen = Play::kTutorial;
  ui.explain(w("One minute: move, see depth, press, grip, look round."));
  ui.same_line();
  if (ui.button("free", w("Free play"))) chosen = Play::kFree;
  ui.explain(w("Touch what you like: no clock, no score."));
  ui.same_line();
  if (ui.button("gallbladder", w("Gallbladder"))) chosen = Play::kGallbladder;
  ui.explain(w("Peel the gallbladder off its bed: no clock, no score."));
  if (ui.button("stitching", w("Stitching"))) chosen = Play::kStitching;
  ui.explain(w("A needle and a thread: no clock, no score."));
  ui.same_line();
  if (ui.button("flap", w("Flap"))) chosen = Play::kFlap;
  ui.explain(w("Lift the flap and look beneath: no clock, no score."));
  if (t_s_ > kFirstWait_s && model.tutorial_due()) chosen = Play::kTutorial;
  if (!chosen) return {};
  if (const std::string hindered = model.begin_play(*chosen); !hindered.empty()) {
    model.notice = hindered;
    return {};
  }
  return ScreenName::kRun;
}

std::optional<ScreenName> StartScreen::foot(Ui& ui, PracticeModel& model) {
  const Translator& w = model.words();
  std::optional<ScreenName> to;
  if (languages_.empty()) languages_ = languages(model.assets().assets / "languages");
  std::vector<std::string> names;
  int chosen = 0;
  for (const Language& language : languages_) {
    if (language.code == model.words().language()) chosen = static_cast<int>(names.size());
    names.push_back(language.name);
  }
  if (names.size() > 1 && ui.choice("language", w("Language"), names, chosen)) {
    model.choose_language(languages_[static_cast<std::size_t>(chosen)].code);
  }
  const auto resize = [&](double by) { model.choose_scale(model.scale() + by); };
  if (ui.button("smaller", w("Smaller"), "-")) resize(-0.25);
  ui.same_line();
  if (ui.button("larger", w("Larger"), "=")) resize(0.25);
  ui.same_line();
  if (ui.button("settings", w("Settings"))) to = ScreenName::kSettings;
  return to;
}

/// What is seen, and that it is nobody.
void StartScreen::caption(Ui& ui, const PracticeModel& model) const {
  const Area panel = panel_area(model.scale(), ui.width(), ui.height());
  const double free = free_width(panel, ui.width());
  if (!scene_ || free <= 0) return;
  const Translator& w = model.words();
  const std::string said = film_ && film_->ready() ? w("Replay of the expert: {0}", {w.name(film_->scene().organ.name)})
                                                   : w("Still scene, synthetic: no patient.");
  const double room = free - ui.px(2 * kStartMargin), x = panel.x + panel.width + ui.px(kStartMargin),
               line = ui.line_height(), pad = ui.px(10);
  const std::vector<std::string> lines = ui.lines(said, room);
  const double high = line * static_cast<double>(lines.size());
  double y = ui.height() - high - ui.px(22), wide = 0;
  for (const std::string& words : lines) wide = std::max(wide, ui.text_width(words));
  ui.paint_ground({x - pad, y - pad / 2, wide + 2 * pad, high + pad}, 0.85, ui.px(6));
  for (const std::string& words : lines) {
    ui.text_at(x, y, words, Ink::kDim);
    y += line;
  }
}

std::optional<ScreenName> StartScreen::frame(Ui& ui, PracticeModel& model, double dt_s) {
  t_s_ += dt_s;
  if (film_) film_->advance(dt_s);
  const Translator& w = model.words();
  caption(ui, model);
  ui.begin_panel("start", panel_area(model.scale(), ui.width(), ui.height()));
  ui.title("Trocar");
  ui.text(w("Practise laparoscopy and feel what you touch."), Ink::kDim);
  ui.gap(10);
  using Asks = PracticeModel::CodeAsks;
  std::optional<ScreenName> to = !model.is_guest()      ? trainee_part(ui, model)
                                 : asked_ == Asks::kNew ? new_code_part(ui, model)
                                 : asked_ == Asks::kPin ? pin_part(ui, model)
                                                        : guest_part(ui, model);
  ui.to_bottom(236);
  if (const auto chosen = foot(ui, model)) to = chosen;
  ui.gap(4);
  ui.marked(Mark::kInfo,
            model.at_pointer() ? w("Without a device: mouse, keyboard or pad. F1 help, Esc menu.")
            : model.backend() == kSimulatedBackend
                ? w("Device: simulated, loop at 1000 Hz. F1 help, Esc menu.")
                : w("Device: {0}, loop at 1000 Hz. F1 help, Esc menu.", {model.backend()}),
            Ink::kDim);
  ui.gap(4);
  ui.heading(w("Teacher"));
  ui.text(w("Results, notes, sign-off and export: trocar review serve."), Ink::kDim);
  ui.end_panel();
  return to;
}

}  // namespace trocar
