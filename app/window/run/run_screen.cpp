#include "app/window/run/run_screen.h"

#include <algorithm>
#include <chrono>

#include "app/picture/attempt/attempt_picture.h"
#include "app/picture/attempt/attempt_scene.h"
#include "app/window/attempt/surroundings.h"
#include "app/window/practice/practice_model.h"
#include "app/window/run/first_run_hints.h"
#include "app/window/run/hud_words.h"
#include "app/window/run/overlays.h"
#include "app/window/run/run_sounds.h"
#include "app/window/run/run_view.h"
#include "app/window/run/tip_guide.h"
#include "app/window/run/tutorial.h"
#include "app/window/ui/hud_draw_list.h"
#include "app/window/ui/ui.h"
#include "haptics/kinematics/device_geometry.h"
#include "scenarios/kinds/kind.h"

namespace trocar {
namespace {

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

constexpr double kHintsMost = 0.25;   // of the picture's height
constexpr double kTipRoom = 0.07;     // of the picture's height round tip and target: for the bar at the tip
constexpr double kSameDepth = 0.004;  // m: neither nearer nor farther
constexpr double kScopeTold_s = 1.5;
constexpr double kStoring_s = 0.5;  // that a database may take before the debrief is shown all the same

/// Before anything has been seen of the run: the instrument as the jig holds it, or where it comes in.
RunMoment first_moment(const Scene& scene) {
  RunMoment moment;
  moment.record.stylus.X_TI = scene.loop.map.instrument_pose(home_pose());
  if (!scene.loop.daq.motors) moment.record.stylus.X_TI.p = entry_T(scene);
  moment.record.stylus.jaw_opening_m = 0.02;
  return moment;
}

/// Of what nobody grades there is no clock, no count, and nothing that stands in a record.
void leave_out_grading(Hud& hud) {
  hud.elapsed_s = -1;
  hud.steps.clear();
  hud.rows.clear();
  hud.device.clear();
}

}  // namespace

struct RunScreen::State {
  enum class Asked : std::uint8_t { kNothing, kPause };

  FontSet fonts;
  bool begun = false, steering = false, was_paused = false, overlay = false;
  bool again = false;    // the overlay asks whether to start again
  bool leaving = false;  // the overlay asks whether to leave an exam
  RunMoment before;      // shown while nothing has been seen
  Camera seen;           // of the last picture
  PixelRect picture;
  HudLayout layout;
  std::optional<double> rim, lit_rim;  // where tip and lit target are when they are out of view
  std::unique_ptr<Surroundings> surroundings;
  TipGuide guide;
  double toast_at = 1;             // as Hud has it
  std::optional<HudBox> hints_at;  // the hints' panel
  bool bars = true, guides = true;
  Asked asked = Asked::kNothing;
  double dt_s = 0, event_s = 0;  // last frame's step; when the first event since the last intent was handed over
  double over_s = 0;             // since the result is there
  ScopeMove scope;               // of the last frame
  double scope_stopped_s = 0;    // that it is still to be told
  FirstRunHints hints;
  Play play = Play::kAttempt;
  std::optional<Tutorial> tutorial;
  RunSounds sounds;
  LatencyMeter latency;

  void begin(PracticeModel& model);
  void steer(PracticeModel& model);
  void command(Action action, PracticeModel& model);
  const RunMoment& shown_moment(PracticeModel& model) const;
  Camera framed(PracticeModel& model) const;
  Camera seen_by(PracticeModel& model) const;
  void stop_scope(PracticeModel& model);
  TipGuide guide_at(const Scene& scene, const SceneView& view, const RunMoment& moment);
  std::string to_start(const Translator& words, const Scene& scene, const Vec3& tip_T) const;
  SceneView view(PracticeModel& model);
  void teach(const RunMoment& moment, PracticeModel& model);
  void tell(Hud& hud, PracticeModel& model) const;
  int covered(const HudBox& box, double margin = 0) const;
  bool covers(const HudBox& box) const;
  void lay_out_clear(Hud& shown, const PracticeModel& model, int width, int height);
  void lay_out(const Hud& hud, PracticeModel& model, int width, int height);
  void pause(PracticeModel& model, bool paused);
  void mark(PracticeModel& model) const;
  std::vector<HudBox> messages() const;
  std::vector<HudBox> over_picture() const;
  void rim_arrow(double angle_rad, double size, Ink colour, double within = 0) const;
  std::optional<ScreenName> pause_panel(Ui& ui, PracticeModel& model);
  ScreenName back() const { return play == Play::kAttempt ? ScreenName::kBriefing : ScreenName::kStart; }
  std::optional<ScreenName> leave_panel(Ui& ui, PracticeModel& model);
  ScreenName leave(PracticeModel& model);
  std::optional<ScreenName> restart(PracticeModel& model);
  std::optional<ScreenName> ended(PracticeModel& model);
  void hint_panel(Ui& ui, PracticeModel& model);
  bool paint_hints(Ui& ui, const std::vector<FirstRunHints::Hint>& marks, double most);
  void key_hints(Ui& ui, const PracticeModel& model) const;
};

RunScreen::RunScreen() : state_(std::make_unique<State>()) {}
RunScreen::~RunScreen() = default;

bool RunScreen::asks() const { return state_->overlay; }
bool RunScreen::takes_escape() const { return state_->overlay || (state_->begun && state_->play != Play::kAttempt); }
bool RunScreen::holds_pointer() const { return state_->steering && !state_->overlay; }
const LatencyMeter& RunScreen::latency() const { return state_->latency; }
const Tutorial* RunScreen::tutorial() const { return state_->tutorial ? &*state_->tutorial : nullptr; }

/// An attempt that has just begun.
void RunScreen::State::begin(PracticeModel& model) {
  const Scene& scene = model.running()->scene();
  before = first_moment(scene);
  surroundings = std::make_unique<Surroundings>(scene);
  guide = {};
  steering = was_paused = overlay = again = leaving = false;
  bars = true;
  guides = scene.level.guides;
  asked = Asked::kNothing;
  over_s = scope_stopped_s = 0;
  scope = {};
  latency.forget();
  sounds = RunSounds();
  play = model.playing();
  tutorial.reset();
  if (play == Play::kTutorial) tutorial.emplace();
  const LevelProgress progress = model.progress(model.exercise_id, model.level);
  const bool first = play == Play::kAttempt && model.is_guest() && progress.passed == 0 && progress.attempts <= 1;
  hints.begin(first || play > Play::kTutorial, hand_tries(scene.setup.exercise, scene.level));
  begun = true;
}

/// What is shown of the run: nothing has been seen of it yet, or it is not ready, the instrument where it comes in.
const RunMoment& RunScreen::State::shown_moment(PracticeModel& model) const {
  AttemptRunner& run = *model.running();
  const RunMoment& newest = run.newest();
  return newest.seen && (run.ready() || run.scene().loop.daq.motors) ? newest : before;
}

/// Where the exercise has the scope.
Camera RunScreen::State::framed(PracticeModel& model) const {
  return attempt_camera(view_of(model.running()->scene(), shown_moment(model)));
}

/// Where the scope is now; until the person has taken hold, where the exercise has it.
Camera RunScreen::State::seen_by(PracticeModel& model) const {
  if (is_scope(model.running()->scene().setup.exercise)) return framed(model);
  return moved_camera(framed(model), steering ? model.steering().scope() : ScopeMove{}, model.scope_tilt_rad());
}

/// The assistant's hand pushes and turns it into nothing: it is drawn back from what it would touch. One that rests
/// stays where it is, whatever comes to it.
void RunScreen::State::stop_scope(PracticeModel& model) {
  scope_stopped_s = std::max(0.0, scope_stopped_s - dt_s);
  const ScopeMove wanted = model.steering().scope();
  const Scene& scene = model.running()->scene();
  if (wanted == scope || is_scope(scene.setup.exercise)) return;
  const RunMoment& moment = shown_moment(model);
  std::vector<SurfacePtr> surfaces = moment.thin_T.empty() ? scene.thin_T : moment.thin_T;
  surfaces.push_back(moment.organ_T ? moment.organ_T : scene.organ_T);
  const double depth = clear_depth(framed(model), wanted, model.scope_tilt_rad(), surfaces, moment.record.stylus.X_TI);
  if (depth < wanted.depth_m) scope_stopped_s = kScopeTold_s;
  model.steering().stop_scope_at(depth);
  scope = model.steering().scope();
}

/// Hands the newest intent to the attempt; from where the instrument is, once the device is ready.
void RunScreen::State::steer(PracticeModel& model) {
  AttemptRunner& run = *model.running();
  Steering& hand = model.steering();
  if (run.paused() != was_paused) hand.handle({.kind = InputEvent::Kind::kFocusLost});  // what was held is let go
  was_paused = run.paused();
  if (was_paused || !run.ready()) return;
  if (!steering) {
    const HandIntent& from = run.target();
    const Scene& scene = run.scene();
    hand.begin(from.X_TI, from.jaw_opening_m, scene.board.centre_T, steering_reach(scene.setup.exercise, scene.level));
    steering = true;
  }
  const RunMoment& now = run.newest();
  const AtHand around = surroundings->around(now, run.target());
  const std::uint64_t number = run.steer(hand.advance(dt_s, seen_by(model), picture.height, around));
  if (hand.refuses_exchange()) model.notice = model.words()("Let go and draw back before you change instruments.");
  stop_scope(model);
  if (event_s > 0) latency.steered(number, event_s);
  event_s = 0;
}

/// The bar that counts now, where it is shown at all; the plumb line where the level has guides.
TipGuide RunScreen::State::guide_at(const Scene& scene, const SceneView& view, const RunMoment& moment) {
  TipGuide out;
  out.tip_T = view.X_TI.p;
  if (hold_shown(scene.setup.exercise, scene.level)) out.held = moment.status.hold_progress;
  out.lit_T = lit_outline(view_of(scene, moment), view.camera);
  if (is_scope(scene.setup.exercise)) {  // the tip is the lens: what is held is round the sphere
    out.tip_T = moment.status.demand.object.X_TO.p;
    return out;
  }
  const StylusState& stylus = moment.record.stylus;
  const bool carries = moment.status.cue == Cue::kCarry || moment.status.cue == Cue::kPlace;
  if (carries) out.plumb_T = moment.status.demand.object.X_TO.p;
  if (guides) {
    const Vec3 hangs_T = out.plumb_T.value_or(out.tip_T);
    out.foot_T = touched_at(stylus, hangs_T);
    if (!out.foot_T) out.foot_T = surroundings->below(hangs_T);
  }
  if (view.hud.bars.empty()) return out;
  const ForceBar& bar = watched_now(scene.setup.exercise, moment.status) == WatchedForce::kGrip ? view.hud.bars.back()
                                                                                                : view.hud.bars.front();
  if (bars && !bar.hidden) out.force = bar;
  return out;
}

/// How far the start ball is, and whether beyond the tip or before it.
std::string RunScreen::State::to_start(const Translator& words, const Scene& scene, const Vec3& tip_T) const {
  const Vec3 way = scene.board.start_T - tip_T;
  if (way.norm() < scene.setup.exercise.start_sphere_m) return "";
  const std::string far = words.number(1000 * way.norm(), 0);
  const double deeper = way.dot((seen.look_at_T - seen.eye_T).normalized());
  if (std::abs(deeper) < kSameDepth) return words("{0} mm to go", {far});
  return deeper > 0 ? words("{0} mm to go, farther away", {far}) : words("{0} mm to go, nearer to you", {far});
}

SceneView RunScreen::State::view(PracticeModel& model) {
  AttemptRunner& run = *model.running();
  const RunMoment& newest = run.newest();
  const RunMoment& moment = shown_moment(model);
  if (newest.seen) latency.drawn(newest.steered);
  sounds.hear(run.scene(), moment, model.sound());
  SceneView out = attempt_view(view_of(run.scene(), moment),
                               model.is_demonstration() ? model.who()
                               : model.is_guest()       ? ""
                                                        : model.trainee(),
                               seen_by(model));
  if (play != Play::kAttempt) leave_out_grading(out.hud);
  if (steering && tutorial) teach(moment, model);
  if (!guides) hide_guides(out);
  if (steering && !is_scope(run.scene().setup.exercise)) add_ghost(out, run.target());
  guide = steering ? guide_at(run.scene(), out, moment) : TipGuide{};
  if (steering && waits_for_start(moment.status.phase))
    guide.to_go = to_start(model.words(), run.scene(), moment.record.stylus.X_TI.p);
  return out;
}

/// A disc that is held is heard already.
void RunScreen::State::teach(const RunMoment& moment, PracticeModel& model) {
  if (model.running()->paused()) return;
  const Vec3 below_T = surroundings->below(moment.record.stylus.X_TI.p);
  const auto done = tutorial->see({moment, below_T, model.steering().scope()}, dt_s);
  if (done && *done != Tutorial::Step::kKeep && *done != Tutorial::Step::kAgain) model.sound().play(Tone::kGood);
}

/// What runs and how to leave it, above; what to do, as a message.
void RunScreen::State::tell(Hud& hud, PracticeModel& model) const {
  const Translator& w = model.words();
  if (scope_stopped_s > 0) {
    hud.toast = w("Something is in the scope's way");
    hud.toast_hint.clear();
    hud.toast_warning = false;
  }
  if (play == Play::kAttempt) return;
  hud.title =
      w(model.running()->scene().setup.exercise.title) + " \u00b7 " + w("{0}: leave", {w.name(key_name(kKeyEscape))});
  if (!tutorial) return;
  hud.steps = tutorial->list(w);
  if (tutorial->over()) return;
  const Tutorial::Said said = tutorial->says(w, model.keys(), model.steering().kind());
  hud.toast = said.message;
  hud.toast_hint = said.hint;
  hud.toast_warning = said.warning;
  hud.toast_done = said.done;
}

/// Points that it would lie over of what the hand is at and what is lit; the hand counts for all. @param margin px.
int RunScreen::State::covered(const HudBox& box, double margin) const {
  const ScopeOptics optics(seen, picture);
  const auto hides = [&](const Vec3& p) {
    const auto at = optics.project(p);
    return at && at->x() > box.x - margin && at->x() < box.right() + margin && at->y() > box.y - margin &&
           at->y() < box.bottom() + margin;
  };
  int hidden = 0, points = 0;
  for (const auto& line : guide.lit_T) {
    hidden += static_cast<int>(std::count_if(line.begin(), line.end(), hides));
    points += static_cast<int>(line.size());
  }
  return hidden + (steering && hides(guide.tip_T) ? 1 + points : 0);
}

/// Whether it would lie over what is to be seen, or over a message.
bool RunScreen::State::covers(const HudBox& box) const {
  return covered(box) > 0 || std::any_of(layout.shapes.begin(), layout.shapes.end(), [&](const HudShape& shape) {
           const HudBox& other = shape.box;
           return shape.kind == HudShape::Kind::kToast && other.x < box.right() && other.right() > box.x &&
                  other.y < box.bottom() && other.bottom() > box.y;
         });
}

/// With the message where it covers nothing that is to be seen, else the least; it stays where it is while it covers
/// nothing.
void RunScreen::State::lay_out_clear(Hud& shown, const PracticeModel& model, int width, int height) {
  int least = -1;
  HudLayout best;
  for (const double at : {toast_at, 1.0, 0.0, 0.75, 0.25, 0.5}) {
    shown.toast_at = at;
    layout = layout_hud(shown, width, height, model.scale(), fonts);
    if (shown.toast.empty()) return;
    const auto toast = std::find_if(layout.shapes.rbegin(), layout.shapes.rend(), [](const HudShape& shape) {
      return shape.kind == HudShape::Kind::kToast;  // notices come before it
    });
    const int hides = covered(toast->box, kTipRoom * picture.height);
    if (least < 0 || hides < least) {
      least = hides;
      toast_at = at;
      best = layout;
    }
    if (hides == 0) break;
  }
  layout = std::move(best);
}

void RunScreen::State::lay_out(const Hud& hud, PracticeModel& model, int width, int height) {
  Hud shown = in_words(hud, model.words());
  tell(shown, model);
  for (ForceBar& bar : shown.bars) {
    if (bars || bar.hidden) continue;
    bar.hidden = true;
    bar.hidden_note =
        model.words()("hidden ({0} shows it)", {model.words().name(key_name(model.keys().key_of(Action::kForceBars)))});
  }
  picture = hud_scene_window(shown, width, height, model.scale());
  lay_out_clear(shown, model, width, height);
  if (!model.settings().left_handed) return;
  picture = picture_right(picture, width);
  layout = column_left(std::move(layout));
}

std::optional<Screen::Stage> RunScreen::stage(PracticeModel& model, int width, int height) {
  State& s = *state_;
  if (!model.running()) return std::nullopt;
  if (!s.begun) s.begin(model);
  s.latency.shown(now_s());  // the picture before this one is complete
  s.steer(model);
  Stage out;
  out.view = s.view(model);
  s.seen = out.view.camera;
  s.lay_out(out.view.hud, model, width, height);
  const bool scope = is_scope(model.running()->scene().setup.exercise);
  s.rim = scope ? std::nullopt : rim_angle(out.view.camera, s.picture, out.view.X_TI.p);
  s.lit_rim = s.guide.lit_T.empty() ? std::nullopt : rim_angle(out.view.camera, s.picture, middle_of(s.guide.lit_T));
  out.x = s.picture.x;
  out.y = s.picture.y;
  out.width = s.picture.width;
  out.height = s.picture.height;
  out.dim = s.overlay ? 0.55 : 0;
  return out;
}

void RunScreen::State::pause(PracticeModel& model, bool paused) {
  if (!model.running()->pause(paused)) model.notice = model.words()("An exam has no pause: the clock runs on.");
  overlay = paused;
  again = paused && again;
  leaving = false;
  RunSounds::hush(model.sound());
}

/// A moment to come back to: the debrief's plots and the replay show it.
void RunScreen::State::mark(PracticeModel& model) const {
  AttemptRunner& run = *model.running();
  if (run.newest().status.phase != Phase::kRun) {
    model.notice = model.words()("Nothing is marked before the clock begins.");
    return;
  }
  run.mark();
  model.notice = model.words()("Moment marked, at {0} s.", {model.words().number(run.newest().status.run_time_s, 1)});
}

void RunScreen::State::command(Action action, PracticeModel& model) {
  switch (action) {
    case Action::kPause:
      asked = Asked::kPause;
      break;
    case Action::kRestart:
      asked = Asked::kPause;
      again = true;
      break;
    case Action::kMark:
      if (play == Play::kAttempt) mark(model);
      break;
    case Action::kForceBars:
      bars = !bars;
      break;
    case Action::kGuidance:
      if (model.running()->scene().level.guides)
        guides = !guides;
      else
        model.notice = model.words()("This level has no guidance.");
      break;
    default:
      break;
  }
}

std::optional<ScreenName> RunScreen::handle(const InputEvent& event, PracticeModel& model) {
  State& s = *state_;
  if (!model.running() || !s.begun) return {};
  if (event.kind == InputEvent::Kind::kFocusLost) {
    model.steering().handle(event);
    if (!s.overlay) s.asked = State::Asked::kPause;  // nobody looks: nothing is missed, nothing counted
    return {};
  }
  if (s.overlay) return {};
  s.hints.saw(event, model.keys());
  if (s.steering && model.steering().handle(event)) {
    if (s.event_s <= 0) s.event_s = now_s();
    return {};
  }
  const bool pressed = event.kind == InputEvent::Kind::kKeyDown && !event.repeat;
  if (const auto action = model.keys().action_of(event.key); pressed && action) s.command(*action, model);
  return {};
}

/// Aborts this one and begins anew with a fresh board.
std::optional<ScreenName> RunScreen::State::restart(PracticeModel& model) {
  RunSounds::hush(model.sound());
  model.end_attempt();
  begun = overlay = false;
  const std::string hindered = play == Play::kAttempt ? model.begin_attempt() : model.begin_play(play);
  if (!hindered.empty()) {
    model.notice = hindered;
    return back();
  }
  return {};
}

std::optional<ScreenName> RunScreen::State::ended(PracticeModel& model) {
  RunSounds::hush(model.sound());
  begun = overlay = false;
  return model.end_attempt() ? ScreenName::kDebrief : back();
}

std::optional<ScreenName> RunScreen::State::pause_panel(Ui& ui, PracticeModel& model) {
  const Translator& w = model.words();
  if (leaving) return leave_panel(ui, model);
  const bool stands = model.running()->paused();
  const auto key = [&](Action action) { return key_name(model.keys().key_of(action)); };
  const bool silent = !model.running()->board_answers(), graded = play == Play::kAttempt;
  const std::string said =
      silent    ? w("Instrument and clock stand still, nothing is lost. Plug it in again, then continue.")
      : !graded ? w("Nothing here is graded or kept.")
      : again   ? w("This attempt then ends, and counts as not passed.")
      : stands  ? w("Instrument and clock stand still. The pause is noted in the result.")
                : w("An exam has no pause: the clock runs on.");
  const double width = std::min(ui.px(430), ui.width());
  const double height = std::min(ui.px(216) + ui.text_height(said, width - ui.px(36)), ui.height());
  ui.begin_panel("pause", {(ui.width() - width) / 2, (ui.height() - height) / 2, width, height}, 0.97);
  ui.title(silent   ? w("The device does not answer")
           : again  ? w("Start again?")
           : stands ? w("Paused")
                    : w("The exam goes on"));
  ui.text(said, Ink::kDim);
  ui.gap();
  const auto go_on = [&] {
    const bool chosen = ui.button("continue", w("Continue"), key(Action::kPause), !again, 390);
    return chosen || ui.pressed("Esc");
  };
  const auto anew = [&] {
    return ui.button("restart", graded ? w("Start again with a fresh board") : w("Start again"), key(Action::kRestart),
                     again, 390);
  };
  const bool first = again ? anew() : go_on(), second = again ? go_on() : anew();
  const bool left = ui.button("leave", graded ? w("Leave this attempt") : w("Start page"), "", false, 390);
  std::optional<ScreenName> to;
  if (again ? first : second) {
    to = restart(model);
  } else if (again ? second : first) {
    pause(model, false);
  } else if (left && model.running()->scene().level.name == kExamLevel) {
    leaving = true;
  } else if (left) {
    to = leave(model);
  }
  ui.end_panel();
  return to;
}

ScreenName RunScreen::State::leave(PracticeModel& model) {
  model.end_attempt();
  begun = overlay = false;
  return back();
}

std::optional<ScreenName> RunScreen::State::leave_panel(Ui& ui, PracticeModel& model) {
  const std::optional<bool> left = leave_exam_overlay(ui, model.words());
  if (left == true) return leave(model);
  if (left == false || ui.pressed("Esc")) pause(model, false);
  return {};
}

/// Painted, not a panel: the pointer over it still steers. In the first corner of the picture where nothing is to be
/// seen that it would cover; where there is none, only what is to be tried next, and else nothing.
void RunScreen::State::hint_panel(Ui& ui, PracticeModel& model) {
  hints_at.reset();
  if (!hints.speaks() || !steering) return;
  const auto marks = hints.marks(model.words(), model.keys(), model.steering().kind());
  if (paint_hints(ui, marks, kHintsMost * picture.height)) return;
  const auto open =
      std::find_if(marks.begin(), marks.end(), [](const FirstRunHints::Hint& mark) { return !mark.done; });
  if (open != marks.end()) paint_hints(ui, {*open}, picture.height);
}

/// @param most px of height. @return false: no corner is free, nothing was painted.
bool RunScreen::State::paint_hints(Ui& ui, const std::vector<FirstRunHints::Hint>& marks, double most) {
  const double line = ui.line_height(), gap = 0.25 * line, pad = ui.px(12), side = 0.8 * line;
  std::vector<std::vector<std::string>> texts;
  double wide = 0, height = pad;
  for (const FirstRunHints::Hint& mark : marks) {
    texts.push_back(ui.lines(mark.text, picture.width - side - 5 * pad));
    for (const std::string& words : texts.back()) wide = std::max(wide, ui.text_width(words));
    height += line * static_cast<double>(texts.back().size()) + gap;
  }
  if (height > most) return false;
  const double width = wide + side + 3 * pad;
  const double left = picture.x + pad, right = picture.x + picture.width - pad - width;
  const double top = picture.y + pad, bottom = picture.y + picture.height - pad - height;
  const Area corners[] = {{left, top, width, height}, {right, top, width, height}, {right, bottom, width, height}};
  const Area* free = std::find_if(std::begin(corners), std::end(corners), [&](const Area& corner) {
    return !covers({corner.x, corner.y, corner.width, corner.height});
  });
  if (free == std::end(corners)) return false;
  hints_at = HudBox{free->x, free->y, free->width, free->height};
  ui.paint_ground(*free, 0.85, ui.px(8));
  double y = free->y + 0.5 * pad + 0.5 * gap;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    ui.paint_mark(marks[i].done ? Mark::kTick : Mark::kOpen, free->x + pad, y + 0.5 * (line - side), side);
    for (const std::string& words : texts[i]) {
      ui.text_at(free->x + 2 * pad + side, y, words, marks[i].done ? Ink::kDim : Ink::kText);
      y += line;
    }
    y += gap;
  }
  return true;
}

/// In the black corner below the round field.
void RunScreen::State::key_hints(Ui& ui, const PracticeModel& model) const {
  const Translator& w = model.words();
  const auto key = [&](Action action) { return w.name(key_name(model.keys().key_of(action))); };
  std::vector<std::string> lines{key(Action::kPause) + "  " + w("Pause"), key(Action::kHelp) + "  " + w("Help")};
  if (model.scope() != "0" && !is_scope(model.exercise()))
    lines.insert(lines.begin(), key(Action::kPostLeft) + " " + key(Action::kPostRight) + "  " + w("Light post"));
  const double room = 0.5 * picture.width - 0.42 * picture.height - ui.px(8);
  double y = picture.y + picture.height - static_cast<double>(lines.size()) * ui.line_height() - ui.px(6);
  double toast = picture.x + picture.width;  // its left edge: small windows have no corner beside it
  for (const HudShape& shape : layout.shapes)
    if (shape.kind == HudShape::Kind::kToast && shape.box.bottom() > y) toast = std::min(toast, shape.box.x);
  for (const std::string& line : lines) {
    if (ui.text_width(line) < std::min(room, toast - picture.x - ui.px(16)))
      ui.text_at(picture.x + ui.px(10), y, line, Ink::kDim);
    y += ui.line_height();
  }
}

std::vector<HudBox> RunScreen::State::messages() const {
  std::vector<HudBox> out;
  for (const HudShape& shape : layout.shapes)
    if (shape.kind == HudShape::Kind::kToast) out.push_back(shape.box);
  if (hints_at) out.push_back(*hints_at);
  return out;
}

/// Messages, and the display beside them.
std::vector<HudBox> RunScreen::State::over_picture() const {
  std::vector<HudBox> out = messages();
  for (const HudShape& shape : layout.shapes)
    if (shape.kind == HudShape::Kind::kPanel) out.push_back(shape.box);
  return out;
}

/// At the rim of the round field, and clear of the messages that lie over it.
void RunScreen::State::rim_arrow(double angle_rad, double size, Ink colour, double within) const {
  draw_rim_arrow(picture.x + 0.5 * picture.width, picture.y + 0.5 * picture.height,
                 rim_reach(picture, angle_rad, size, messages()) - within, angle_rad, size, colour);
}

std::optional<ScreenName> RunScreen::frame(Ui& ui, PracticeModel& model, double dt_s) {
  State& s = *state_;
  s.dt_s = dt_s;
  if (!model.running()) return ScreenName::kBriefing;
  if (model.running()->finished()) s.over_s += dt_s;
  if (model.running()->stored() || s.over_s > kStoring_s) return s.ended(model);
  if (!s.begun) return {};
  if (!s.overlay && !model.running()->board_answers()) s.asked = State::Asked::kPause;
  if (!s.overlay) ui.keys_to_screen();
  if (s.tutorial && s.tutorial->over()) {
    model.notice = model.words()("That was all. The start page offers it again; F1 lists the keys.");
    return s.ended(model);
  }
  if (s.play != Play::kAttempt && !s.overlay && ui.pressed("Esc")) return s.ended(model);
  s.hints.pass(dt_s);
  if (!s.overlay) paint_tip_guide(ui, ScopeOptics(s.seen, s.picture), s.guide, s.over_picture());
  draw_hud(ui, s.layout);
  if (!s.overlay) s.hint_panel(ui, model);
  const double arrow = ui.px(26);
  if (s.lit_rim) s.rim_arrow(*s.lit_rim, arrow, Ink::kAccent);
  if (s.rim && s.steering) s.rim_arrow(*s.rim, arrow, Ink::kTip, s.lit_rim ? 1.5 * arrow : 0);
  s.key_hints(ui, model);
  if (s.overlay) return s.pause_panel(ui, model);
  if (std::exchange(s.asked, State::Asked::kNothing) != State::Asked::kNothing) s.pause(model, true);
  return {};
}

}  // namespace trocar
