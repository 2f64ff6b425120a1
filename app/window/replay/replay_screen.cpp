#include "app/window/replay/replay_screen.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "app/picture/attempt/attempt_hud.h"
#include "app/picture/attempt/attempt_scene.h"
#include "app/picture/films/film.h"
#include "app/window/attempt/metric_words.h"
#include "app/window/practice/practice_model.h"
#include "app/window/replay/replay_plot.h"
#include "app/window/ui/ui.h"
#include "scenarios/kinds/kind.h"

namespace trocar {
namespace {

constexpr double kLead_s = 1;

/// What is said of the force: the bar that counts at this moment, if the exercise has any.
std::optional<ForceBar> telling_bar(const Scene& scene, const RunMoment& moment) {
  const std::vector<ForceBar> bars = attempt_hud(view_of(scene, moment), attempt_camera(scene), "").bars;
  if (bars.empty()) return std::nullopt;
  return watched_now(scene.setup.exercise, moment.status) == WatchedForce::kGrip ? bars.back() : bars.front();
}

/// Whose run it is: the person's own, or whoever the recording says did it.
std::string name_of(const RecordedRun& run, const std::filesystem::path& file, const PracticeModel& model) {
  if (file == model.recording()) return model.words()("You");
  const std::string& hand = run.scene().setup.hand;
  return hand == "expert" ? model.words()("Expert") : hand_words(model.words(), hand);
}

std::string speed_words(const Translator& w, double speed) {
  return w("speed {0}", {w.number(speed, speed < 1 ? 2 : 0)});
}

}  // namespace

void ReplayScreen::Side::look_after(const PracticeModel& model) {
  if (seen || !run || !run->has_pictures()) return;
  seen = true;
  name = name_of(*run, file, model);
}

void ReplayScreen::open(PracticeModel& model) {
  opened_ = true;
  const Translator& w = model.words();
  const std::filesystem::path file = model.replay_file.empty() ? model.recording() : model.replay_file;
  begin_at_s_ = std::exchange(model.replay_at_s, {});
  beside_file_ = model.replay_beside;
  beside_wanted_ = !beside_file_.empty();
  if (file.empty()) {
    nothing_ = model.result() && model.database() == ":memory:"
                   ? w("Nothing is kept in this session, so there is no recording of the attempt.")
               : model.result() ? w("This attempt has no recording.")
                                : w("There is no recording to show yet: it is made with every attempt.");
    return;
  }
  own_.file = file;
  own_.run = RecordedRun::in_background(file, model.assets());
}

void ReplayScreen::ask_beside(PracticeModel& model) {
  if (!beside_wanted_ || beside_.run || !own_.shown()) return;
  const bool expert = beside_file_.empty();
  const std::filesystem::path file =
      expert ? expert_.ask(expert_setup(own_.run->scene().setup), model.assets()) : beside_file_;
  if (file.empty()) return;
  beside_.file = file;
  beside_.run = RecordedRun::in_background(file, model.assets());
}

void ReplayScreen::look_after(PracticeModel& model, double dt_s) {
  if (!opened_) open(model);
  if (!own_.run) return;
  if (own_.run->stage() == RecordedRun::Stage::kFailed && !own_.shown()) nothing_ = own_.run->failure();
  const bool before = own_.shown();
  own_.look_after(model);
  beside_.look_after(model);
  ask_beside(model);
  if (!own_.shown()) return;
  const RecordedRun& run = *own_.run;
  const double length = two() ? std::max(film_length(run), film_length(*beside_.run)) : film_length(run);
  clock_.set_range(-std::min(kLead_s, run.begin_s()), length);
  if (!before) events_ = replay_events(run.events(), run.begin_s(), model.words());
  if (begin_at_s_) clock_.go(*std::exchange(begin_at_s_, {}) - run.begin_s());
  double known_s = run.stage() == RecordedRun::Stage::kReplaying ? run.available_until() - run.begin_s() : length;
  if (two() && beside_.run->stage() == RecordedRun::Stage::kReplaying)
    known_s = std::min(known_s, beside_.run->available_until() - beside_.run->begin_s());
  clock_.advance(dt_s, known_s);
}

void ReplayScreen::settle(PracticeModel& model, double wait_s) {
  using Run = RecordedRun::Stage;
  const auto begin = std::chrono::steady_clock::now();
  const auto working = [](const Side& side) {
    return side.run && (side.run->stage() == Run::kLoading || side.run->stage() == Run::kReplaying);
  };
  do {
    look_after(model, 0);
    if (!working(own_) && !working(beside_)) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  } while (std::chrono::steady_clock::now() - begin < std::chrono::duration<double>(wait_s));
}

Screen::Stage ReplayScreen::stage_of(const Side& side, double x, double width) const {
  const RunMoment moment = side.run->at(loop_time(*side.run, clock_.now_s()));
  Stage stage;
  stage.view = attempt_scene(view_of(side.run->scene(), moment));
  stage.x = x;
  stage.width = width;
  stage.height = picture_height_;
  return stage;
}

std::optional<Screen::Stage> ReplayScreen::stage(PracticeModel&, int width, int) {
  if (!own_.shown() || picture_height_ <= 0) return {};
  return stage_of(own_, 0, two() ? width / 2 - 1 : width);
}

std::optional<Screen::Stage> ReplayScreen::second_stage(PracticeModel&, int width, int) {
  if (!two() || picture_height_ <= 0) return {};
  return stage_of(beside_, width / 2 + 1, width - width / 2 - 1);
}

void ReplayScreen::keys(Ui& ui) {
  ui.keys_to_screen();
  if (ui.pressed("Left")) clock_.go(clock_.now_s() - 1);
  if (ui.pressed("Right")) clock_.go(clock_.now_s() + 1);
  if (ui.pressed("Home")) clock_.go(clock_.from_s());
  if (ui.pressed("End")) clock_.go(clock_.to_s());
  if (ui.pressed(",")) clock_.step(-1);
  if (ui.pressed(".")) clock_.step(1);
  std::vector<double> marks;
  for (const ReplayEvent& event : events_) marks.push_back(event.clock_s);
  if (ui.pressed("[")) clock_.jump(marks, -1);
  if (ui.pressed("]")) clock_.jump(marks, 1);
}

std::string ReplayScreen::state_words(const Translator& w) const {
  if (own_.run->stage() == RecordedRun::Stage::kFailed) return w("The replay stops here: {0}", {own_.run->failure()});
  if (!own_.run->torn().empty() && clock_.now_s() >= film_length(*own_.run))
    return w("The recording was cut off here.");
  if (beside_wanted_ && !two()) {
    const std::string why = beside_.run ? beside_.run->failure() : expert_.refusal();
    return why.empty() ? w("The run beside it is being made...") : w("The run beside it cannot be shown: {0}", {why});
  }
  const ReplayEvent* last = nullptr;
  for (const ReplayEvent& event : events_)
    if (event.clock_s <= clock_.now_s() + 1e-6 && event.clock_s > clock_.now_s() - 3) last = &event;
  return last ? w.number(last->clock_s, 1) + " s: " + last->words : "";
}

void ReplayScreen::heading(Ui& ui) const {
  const Translator& w = ui.words();
  const Area area = ui.drawing("heading", ui.line_height() / ui.px(1));
  const std::string place = w("{0} s of {1} s", {w.number(clock_.now_s(), 2), w.number(clock_.to_s(), 1)});
  const std::string time = place + ", " + speed_words(w, clock_.speed());
  const double mark = ui.line_height();
  if (clock_.playing()) ui.paint_mark(Mark::kPlay, area.x, area.y, mark);
  for (const double x : {0.25, 0.6})
    if (!clock_.playing()) ui.paint_box({area.x + x * mark, area.y + 0.15 * mark, 0.18 * mark, 0.7 * mark}, Ink::kText);
  const std::string state = state_words(w);
  const double x = area.x + mark + ui.px(8), room = area.x + area.width - x;
  const double said = state.empty() ? 0 : ui.text_width(state) + ui.px(20);
  // What happens comes before the speed, and for its seconds before the time, which the time line shows too.
  double right = x;
  for (const std::string& words : {time, place}) {
    if (right > x || ui.text_width(words) + said > room) continue;
    ui.text_at(x, area.y, words);
    right += ui.text_width(words) + ui.px(20);
  }
  if (!state.empty()) ui.text_at(right, area.y, state, Ink::kHeading, area.x + area.width - right);
}

void ReplayScreen::force_of(Ui& ui, const Side& side, const Area& area) const {
  const Translator& w = ui.words();
  const RunMoment moment = side.run->at(loop_time(*side.run, clock_.now_s()));
  const bool over = clock_.now_s() > film_length(*side.run);
  const std::optional<ForceBar> bar = telling_bar(side.run->scene(), moment);
  const std::string name = over ? w("{0}: ended", {side.name}) : side.name;
  if (!bar) {
    const std::string mm = w.number(1e3 * moment.status.position_error_m, 1),
                      degrees = w.number(moment.status.angle_error_rad * 57.29578, 0);
    const bool scope = is_scope(side.run->scene().setup.exercise);
    const std::string far = !moment.status.demand.oriented ? ""
                            : scope ? w("{0} mm from the sphere, {1} degrees off the middle", {mm, degrees})
                                    : w("{0} mm and {1} degrees from the pen", {mm, degrees});
    ui.text_at(area.x, area.y, name + (far.empty() ? "" : ". " + far), Ink::kText, area.width);
    return;
  }
  const bool banded = bar->band_high_n > 0, above = banded && bar->value_n > bar->band_high_n;
  const bool in = banded && !above && bar->value_n >= bar->band_low_n;
  const std::string value = w.number(bar->value_n, 2) + " N";
  const double room = area.width - ui.text_width("00.00 N") - ui.px(20);
  const std::string labelled = name + ", " + w.made(bar->label);
  ui.text_at(area.x, area.y, ui.text_width(labelled) <= room ? labelled : name, Ink::kText, room);
  ui.text_at(area.x + area.width, area.y, value, above ? Ink::kAlarm : in ? Ink::kGood : Ink::kText, 0, 1);
  const Area track{area.x, area.y + ui.line_height() + ui.px(3), area.width, ui.px(12)};
  const auto x = [&](double n) {
    return track.x + track.width * std::clamp(n / std::max(1e-6, bar->full_scale_n), 0.0, 1.0);
  };
  ui.paint_ground(track, 1, 3);
  ui.paint_frame(track, Ink::kDim, 1, 3);
  const double low = x(bar->band_low_n), high = x(bar->band_high_n);
  if (banded) ui.paint_box({low, track.y, high - low, track.height}, Ink::kGood, 0.35);
  if (bar->limit_n > 0)
    ui.paint_hatch({x(bar->limit_n), track.y, track.x + track.width - x(bar->limit_n), track.height}, Ink::kAlarm);
  const double inset = ui.px(3);
  const Ink ink = above ? Ink::kAlarm : in ? Ink::kGood : Ink::kAccent;
  ui.paint_box({track.x, track.y + inset, x(bar->value_n) - track.x, track.height - 2 * inset}, ink);
}

void ReplayScreen::forces(Ui& ui) const {
  const Area area = ui.drawing("forces", (ui.line_height() + ui.px(18)) / ui.px(1));
  const double gap = ui.px(24), wide = two() ? (area.width - gap) / 2 : area.width;
  force_of(ui, own_, {area.x, area.y, wide, area.height});
  if (two()) force_of(ui, beside_, {area.x + wide + gap, area.y, wide, area.height});
}

void ReplayScreen::time_line(Ui& ui, double height_px) {
  const Scene& scene = own_.run->scene();
  const Exercise& exercise = scene.setup.exercise;
  ReplayPlotContent content{*own_.run, two() ? &*beside_.run : nullptr, events_};
  const WatchedForce watched = kind_of(exercise).watched;
  content.grip = watched == WatchedForce::kGrip;
  if (watched == WatchedForce::kTip) {
    content.band = {scene.level.band_low_n, scene.level.band_high_n};
    content.limit_n = exercise.hard_force_n;
  }
  const Area area = ui.drawing("time", height_px / ui.px(1));
  ui.explain(
      ui.words()("Click or drag to go there. Left, Right: 1 s. Comma, full stop: a step. [, ]: events. Home, End."));
  replay_plot(ui, area, content, clock_);
}

std::vector<RowButton> ReplayScreen::buttons(const Translator& w) const {
  const std::string loop = clock_.loop_b_s()   ? w("End the loop")
                           : clock_.loop_a_s() ? w("Loop to here")
                                               : w("Loop from here");
  return {{"play", clock_.playing() ? w("Pause") : w("Play"), "Space", true},
          {"slower", w("Slower"), "-"},
          {"faster", w("Faster"), "="},
          {"beside", beside_wanted_ ? w("Alone") : w("Beside the expert"), "S"},
          {"loop", loop, "L"},
          {"back", w("Back"), "Esc"}};
}

std::optional<ScreenName> ReplayScreen::act(const std::string& chosen) {
  if (chosen == "play") clock_.toggle_play();
  if (chosen == "slower") clock_.change_speed(-1);
  if (chosen == "faster") clock_.change_speed(1);
  if (chosen == "beside") beside_wanted_ = !beside_wanted_;
  if (chosen == "loop") clock_.next_loop_point();
  return chosen == "back" ? std::optional(ScreenName::kBack) : std::nullopt;
}

/// The picture takes what is left. Large text: no force bars, the time line shows the same.
std::optional<ScreenName> ReplayScreen::panel(Ui& ui) {
  const std::vector<RowButton> row = buttons(ui.words());
  const bool compact = ui.height() < ui.px(500);
  const double line = ui.line_height(), bars = compact ? 0 : line + ui.px(18 + 7),
               rows = button_rows_height(ui, row, ui.width());
  const double others = line + ui.px(7) + bars + ui.px(7) + rows;
  const double plot = std::clamp(0.40 * ui.height() - others, ui.px(46), ui.px(190)) + line;
  picture_height_ = std::floor(ui.height() - others - plot);
  ui.begin_strip("replay", {0, picture_height_, ui.width(), ui.height() - picture_height_});
  heading(ui);
  if (!compact) forces(ui);
  time_line(ui, plot);
  const auto to = act(button_rows(ui, row));
  ui.end_panel();
  return to;
}

std::optional<ScreenName> ReplayScreen::frame(Ui& ui, PracticeModel& model, double dt_s) {
  look_after(model, dt_s);
  const Translator& w = model.words();
  if (own_.shown()) {
    keys(ui);
    return panel(ui);
  }
  picture_height_ = 0;
  const double wide = std::min(ui.px(560), 0.9 * ui.width());
  ui.begin_panel("replay-wait",
                 {(ui.width() - wide) / 2, 0.3 * ui.height(), wide, std::min(ui.px(260), 0.6 * ui.height())});
  ui.title(w("Replay"));
  if (nothing_.empty())
    ui.text(w("The recording is being opened..."));
  else
    ui.marked(Mark::kInfo, nothing_);
  ui.gap();
  const bool back = ui.button("back", w("Back"), "Esc", true);
  ui.end_panel();
  return back ? std::optional(ScreenName::kBack) : std::nullopt;
}

}  // namespace trocar
