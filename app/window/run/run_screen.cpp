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
#include "app/window/ui/hud_draw_list.h"
#include "app/window/ui/ui.h"
#include "haptics/kinematics/device_geometry.h"
#include "scenarios/kinds/kind.h"

namespace trocar {
namespace {

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

constexpr double kTipRoom = 0.07;   // of the picture's height round tip and target: for the bar at the tip
constexpr double kStoring_s = 0.5;  // that a database may take before the debrief is shown all the same

/// Before anything has been seen of the run: the instrument as the jig holds it.
RunMoment first_moment(const Scene& scene) {
  RunMoment moment;
  moment.record.stylus.X_TI = scene.loop.map.instrument_pose(home_pose());
  moment.record.stylus.jaw_opening_m = 0.02;
  return moment;
}

}  // namespace

struct RunScreen::State {
  enum class Asked : std::uint8_t { kNothing, kPause };

  FontSet fonts;
  bool begun = false, steering = false, was_paused = false, overlay = false;
  bool again = false;    // the overlay asks whether to start again
  bool leaving = false;  // the overlay asks whether to leave an exam
  RunMoment before;      // shown while nothing has been seen
  Camera camera, seen;   // of the exercise; of the last picture
  PixelRect picture;
  HudLayout layout;
  std::optional<double> rim;  // where the tip is when it is out of view
  std::unique_ptr<Surroundings> surroundings;
  TipGuide guide;
  bool toast_above = false;
  bool bars = true, guides = true;
  Asked asked = Asked::kNothing;
  double dt_s = 0, event_s = 0;  // last frame's step; when the first event since the last intent was handed over
  double over_s = 0;             // since the result is there
  FirstRunHints hints;
  RunSounds sounds;
  LatencyMeter latency;

  void begin(PracticeModel& model);
  void steer(PracticeModel& model);
  void command(Action action, PracticeModel& model);
  Camera seen_by(PracticeModel& model) const;
  TipGuide guide_at(const Scene& scene, const SceneView& view, const RunMoment& moment);
  SceneView view(PracticeModel& model);
  bool covers(const HudBox& box, double margin = 0) const;
  void lay_out(const Hud& hud, PracticeModel& model, int width, int height);
  void pause(PracticeModel& model, bool paused);
  void mark(PracticeModel& model) const;
  void rim_arrow(double angle_rad, double size) const;
  std::optional<ScreenName> pause_panel(Ui& ui, PracticeModel& model);
  std::optional<ScreenName> leave_panel(Ui& ui, PracticeModel& model);
  ScreenName leave(PracticeModel& model);
  std::optional<ScreenName> restart(PracticeModel& model);
  std::optional<ScreenName> ended(PracticeModel& model);
  void hint_panel(Ui& ui, PracticeModel& model) const;
  void key_hints(Ui& ui, const PracticeModel& model) const;
};

RunScreen::RunScreen() : state_(std::make_unique<State>()) {}
RunScreen::~RunScreen() = default;

bool RunScreen::asks() const { return state_->overlay; }
bool RunScreen::takes_escape() const { return state_->overlay; }
bool RunScreen::holds_pointer() const { return state_->steering && !state_->overlay; }
const LatencyMeter& RunScreen::latency() const { return state_->latency; }

/// An attempt that has just begun.
void RunScreen::State::begin(PracticeModel& model) {
  const Scene& scene = model.running()->scene();
  before = first_moment(scene);
  surroundings = std::make_unique<Surroundings>(scene);
  guide = {};
  camera = attempt_camera(scene);
  steering = was_paused = overlay = again = leaving = false;
  bars = true;
  guides = scene.level.guides;
  asked = Asked::kNothing;
  over_s = 0;
  latency.forget();
  sounds = RunSounds();
  const LevelProgress progress = model.progress(model.exercise_id, model.level);
  hints.begin(model.is_guest() && progress.passed == 0 && progress.attempts <= 1);
  begun = true;
}

/// Where the scope is now; until the person has taken hold, where the exercise has it.
Camera RunScreen::State::seen_by(PracticeModel& model) const {
  return moved_camera(camera, steering ? model.steering().scope() : ScopeMove{}, model.scope_tilt_rad());
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
  if (event_s > 0) latency.steered(number, event_s);
  event_s = 0;
}

/// The bar that counts now, where it is shown at all; the plumb line where the level has guides.
TipGuide RunScreen::State::guide_at(const Scene& scene, const SceneView& view, const RunMoment& moment) {
  TipGuide out;
  out.tip_T = view.X_TI.p;
  if (hold_shown(scene.setup.exercise, scene.level)) out.held = moment.status.hold_progress;
  out.lit_T = lit_outline(view_of(scene, moment), view.camera);
  const StylusState& stylus = moment.record.stylus;
  if (guides) out.foot_T = stylus.contact ? stylus.contact_point_T : surroundings->below(view.X_TI.p);
  if (view.hud.bars.empty()) return out;
  const ForceBar& bar = moment.status.cue == Cue::kGrip ? view.hud.bars.back() : view.hud.bars.front();
  if (bars && !bar.hidden) out.force = bar;
  return out;
}

SceneView RunScreen::State::view(PracticeModel& model) {
  AttemptRunner& run = *model.running();
  const RunMoment& newest = run.newest();
  const RunMoment& moment = newest.seen ? newest : before;
  if (newest.seen) latency.drawn(newest.steered);
  sounds.hear(run.scene(), moment, model.sound());
  SceneView out = attempt_view(view_of(run.scene(), moment),
                               model.is_demonstration() ? model.who()
                               : model.is_guest()       ? ""
                                                        : model.trainee(),
                               seen_by(model));
  if (!guides) hide_guides(out);
  if (steering) add_ghost(out, run.target());
  guide = steering ? guide_at(run.scene(), out, moment) : TipGuide{};
  return out;
}

/// Whether it would lie over what the hand is at, what is lit, or a message. @param margin px round tip and target.
bool RunScreen::State::covers(const HudBox& box, double margin) const {
  const ScopeOptics optics(seen, picture);
  std::vector<Vec3> points;
  if (steering) points.push_back(guide.tip_T);
  for (const auto& line : guide.lit_T) points.insert(points.end(), line.begin(), line.end());
  const bool hides = std::any_of(points.begin(), points.end(), [&](const Vec3& p) {
    const auto at = optics.project(p);
    return at && at->x() > box.x - margin && at->x() < box.right() + margin && at->y() > box.y - margin &&
           at->y() < box.bottom() + margin;
  });
  return hides || std::any_of(layout.shapes.begin(), layout.shapes.end(), [&](const HudShape& shape) {
           const HudBox& other = shape.box;
           const bool itself = other.x == box.x && other.y == box.y;
           return shape.kind == HudShape::Kind::kToast && !itself && other.x < box.right() && other.right() > box.x &&
                  other.y < box.bottom() && other.bottom() > box.y;
         });
}

void RunScreen::State::lay_out(const Hud& hud, PracticeModel& model, int width, int height) {
  Hud shown = in_words(hud, model.words());
  for (ForceBar& bar : shown.bars) {
    if (bars || bar.hidden) continue;
    bar.hidden = true;
    bar.hidden_note =
        model.words()("hidden ({0} shows it)", {model.words().name(key_name(model.keys().key_of(Action::kForceBars)))});
  }
  picture = hud_scene_window(shown, width, height, model.scale());
  layout = layout_hud(shown, width, height, model.scale(), fonts);
  toast_above = std::any_of(layout.shapes.begin(), layout.shapes.end(), [&](const HudShape& shape) {
    return shape.kind == HudShape::Kind::kToast && shape.box.y > picture.y + 0.5 * picture.height &&
           covers(shape.box, kTipRoom * picture.height);
  });
  if (toast_above) {
    shown.toast_above = true;
    layout = layout_hud(shown, width, height, model.scale(), fonts);
  }
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
  s.rim = rim_angle(out.view.camera, s.picture, out.view.X_TI.p);
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
      mark(model);
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
  if (const std::string hindered = model.begin_attempt(); !hindered.empty()) {
    model.notice = hindered;
    return ScreenName::kBriefing;
  }
  return {};
}

std::optional<ScreenName> RunScreen::State::ended(PracticeModel& model) {
  RunSounds::hush(model.sound());
  begun = overlay = false;
  return model.end_attempt() ? ScreenName::kDebrief : ScreenName::kBriefing;
}

std::optional<ScreenName> RunScreen::State::pause_panel(Ui& ui, PracticeModel& model) {
  const Translator& w = model.words();
  if (leaving) return leave_panel(ui, model);
  const bool stands = model.running()->paused();
  const auto key = [&](Action action) { return key_name(model.keys().key_of(action)); };
  const bool silent = !model.running()->board_answers();
  const std::string said =
      silent   ? w("Instrument and clock stand still, nothing is lost. Plug it in again, then continue.")
      : again  ? w("This attempt then ends, and counts as not passed.")
      : stands ? w("Instrument and clock stand still. The pause is noted in the result.")
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
    return ui.button("restart", w("Start again with a fresh board"), key(Action::kRestart), again, 390);
  };
  const bool first = again ? anew() : go_on(), second = again ? go_on() : anew();
  const bool left = ui.button("leave", w("Leave this attempt"), "", false, 390);
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
  return ScreenName::kBriefing;
}

std::optional<ScreenName> RunScreen::State::leave_panel(Ui& ui, PracticeModel& model) {
  const std::optional<bool> left = leave_exam_overlay(ui, model.words());
  if (left == true) return leave(model);
  if (left == false || ui.pressed("Esc")) pause(model, false);
  return {};
}

/// Painted, not a panel: the pointer over it still steers. In the first corner of the picture where nothing is to be
/// seen that it would cover.
void RunScreen::State::hint_panel(Ui& ui, PracticeModel& model) const {
  if (!hints.speaks() || !steering) return;
  const auto marks = hints.marks(model.words(), model.keys(), model.steering().kind());
  const double line = 1.25 * ui.line_height(), pad = ui.px(12), side = 0.8 * ui.line_height();
  double wide = 0;
  for (const FirstRunHints::Hint& mark : marks) wide = std::max(wide, ui.text_width(mark.text));
  const double width = std::min(wide + side + 3 * pad, picture.width - 2 * pad), room = width - side - 3 * pad;
  const double height = line * static_cast<double>(marks.size()) + pad;
  const double left = picture.x + pad, right = picture.x + picture.width - pad - width;
  const double top = picture.y + pad, bottom = picture.y + picture.height - pad - height;
  const Area corners[] = {{left, top, width, height}, {right, top, width, height}, {right, bottom, width, height}};
  const Area* free = std::find_if(std::begin(corners), std::end(corners), [&](const Area& corner) {
    return !covers({corner.x, corner.y, corner.width, corner.height});
  });
  if (free == std::end(corners)) free = corners;  // a window too small for both
  ui.paint_ground(*free, 0.85, ui.px(8));
  double y = free->y + 0.5 * pad + 0.5 * (line - ui.line_height());
  for (const FirstRunHints::Hint& mark : marks) {
    ui.paint_mark(mark.done ? Mark::kTick : Mark::kOpen, free->x + pad, y + 0.5 * (ui.line_height() - side), side);
    ui.text_at(free->x + 2 * pad + side, y, mark.text, mark.done ? Ink::kDim : Ink::kText, room);
    y += line;
  }
}

/// In the black corner below the round field.
void RunScreen::State::key_hints(Ui& ui, const PracticeModel& model) const {
  const Translator& w = model.words();
  const auto key = [&](Action action) { return w.name(key_name(model.keys().key_of(action))); };
  std::vector<std::string> lines{key(Action::kPause) + "  " + w("Pause"), key(Action::kHelp) + "  " + w("Help")};
  if (model.scope() != "0")
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

/// At the rim of the round field, and clear of the messages that lie over it.
void RunScreen::State::rim_arrow(double angle_rad, double size) const {
  std::vector<HudBox> messages;
  for (const HudShape& shape : layout.shapes)
    if (shape.kind == HudShape::Kind::kToast) messages.push_back(shape.box);
  draw_rim_arrow(picture.x + 0.5 * picture.width, picture.y + 0.5 * picture.height,
                 rim_reach(picture, angle_rad, size, messages), angle_rad, size);
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
  s.hints.pass(dt_s);
  if (!s.overlay) paint_tip_guide(ui, ScopeOptics(s.seen, s.picture), s.guide);
  draw_hud(s.layout);
  if (s.rim && s.steering) s.rim_arrow(*s.rim, ui.px(26));
  s.key_hints(ui, model);
  if (s.overlay) return s.pause_panel(ui, model);
  s.hint_panel(ui, model);
  if (std::exchange(s.asked, State::Asked::kNothing) != State::Asked::kNothing) s.pause(model, true);
  return {};
}

}  // namespace trocar
