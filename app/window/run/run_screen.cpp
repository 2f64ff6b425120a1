#include "app/window/run/run_screen.h"

#include <chrono>

#include "app/picture/attempt/attempt_picture.h"
#include "app/picture/attempt/attempt_scene.h"
#include "app/window/practice/practice_desk.h"
#include "app/window/run/coach.h"
#include "app/window/run/hud_words.h"
#include "app/window/run/run_sounds.h"
#include "app/window/run/run_view.h"
#include "app/window/ui/hud_draw_list.h"
#include "app/window/ui/ui.h"
#include "haptics/kinematics/device_geometry.h"

namespace trocar {
namespace {

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

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
  bool again = false;  // the overlay asks whether to start again
  RunMoment before;    // shown while nothing has been seen
  Camera camera;
  PixelRect picture;
  HudLayout layout;
  std::optional<double> rim;  // where the tip is when it is out of view
  bool bars = true, guides = true;
  Asked asked = Asked::kNothing;
  double dt_s = 0, event_s = 0;  // last frame's step; when the first event since the last intent was handed over
  double over_s = 0;             // since the result is there
  Coach coach;
  RunSounds sounds;
  LatencyMeter latency;

  void begin(PracticeDesk& desk);
  void steer(PracticeDesk& desk);
  void command(Action action, PracticeDesk& desk);
  Camera seen_by(PracticeDesk& desk) const;
  SceneView view(PracticeDesk& desk);
  void lay_out(const Hud& hud, PracticeDesk& desk, int width, int height);
  void pause(PracticeDesk& desk, bool paused);
  void mark(PracticeDesk& desk) const;
  void rim_arrow(double angle_rad, double size) const;
  std::optional<ScreenName> pause_panel(Ui& ui, PracticeDesk& desk);
  std::optional<ScreenName> restart(PracticeDesk& desk);
  std::optional<ScreenName> ended(PracticeDesk& desk);
  void coach_panel(Ui& ui, PracticeDesk& desk) const;
  void key_hints(Ui& ui, const PracticeDesk& desk) const;
};

RunScreen::RunScreen() : state_(std::make_unique<State>()) {}
RunScreen::~RunScreen() = default;

bool RunScreen::asks() const { return state_->overlay; }
bool RunScreen::takes_escape() const { return state_->overlay; }
const LatencyMeter& RunScreen::latency() const { return state_->latency; }

/// An attempt that has just begun.
void RunScreen::State::begin(PracticeDesk& desk) {
  const Scene& scene = desk.running()->scene();
  before = first_moment(scene);
  camera = attempt_camera(scene);
  steering = was_paused = overlay = again = false;
  bars = true;
  guides = scene.level.guides;
  asked = Asked::kNothing;
  over_s = 0;
  latency.forget();
  sounds = RunSounds();
  const Standing standing = desk.standing(desk.exercise_id, desk.level);
  coach.begin(desk.is_guest() && standing.passed == 0 && standing.attempts <= 1);
  begun = true;
}

/// Where the scope is now; until the person has taken hold, where the exercise has it.
Camera RunScreen::State::seen_by(PracticeDesk& desk) const {
  return moved_camera(camera, steering ? desk.steering().scope() : ScopeMove{}, desk.scope_tilt_rad());
}

/// Hands the newest intent to the attempt; from where the instrument is, once the device is ready.
void RunScreen::State::steer(PracticeDesk& desk) {
  AttemptRunner& run = *desk.running();
  Steering& hand = desk.steering();
  if (run.paused() != was_paused) hand.handle({.kind = InputEvent::Kind::kFocusLost});  // what was held is let go
  was_paused = run.paused();
  if (was_paused || !run.ready()) return;
  if (!steering) {
    const HandIntent& from = run.target();
    const Scene& scene = run.scene();
    hand.begin(from.X_TI, from.jaw_opening_m, scene.board.centre_T, steering_reach(scene.setup.exercise, scene.level));
    steering = true;
  }
  const std::uint64_t number = run.steer(hand.advance(dt_s, seen_by(desk), picture.height));
  if (event_s > 0) latency.steered(number, event_s);
  event_s = 0;
}

SceneView RunScreen::State::view(PracticeDesk& desk) {
  AttemptRunner& run = *desk.running();
  const RunMoment& newest = run.newest();
  const RunMoment& moment = newest.seen ? newest : before;
  if (newest.seen) latency.drawn(newest.steered);
  sounds.hear(run.scene(), moment, desk.sound());
  SceneView out = attempt_view(view_of(run.scene(), moment),
                               desk.is_demonstration() ? desk.who()
                               : desk.is_guest()       ? ""
                                                       : desk.trainee(),
                               seen_by(desk));
  if (!guides) hide_guides(out);
  if (steering) add_ghost(out, run.target());
  return out;
}

void RunScreen::State::lay_out(const Hud& hud, PracticeDesk& desk, int width, int height) {
  Hud shown = in_words(hud, desk.words());
  for (ForceBar& bar : shown.bars) {
    if (bars || bar.hidden) continue;
    bar.hidden = true;
    bar.hidden_note =
        desk.words()("hidden ({0} shows it)", {desk.words().name(key_name(desk.keys().key_of(Action::kForceBars)))});
  }
  picture = hud_scene_window(shown, width, height, desk.scale());
  layout = layout_hud(shown, width, height, desk.scale(), fonts);
  if (!desk.settings().left_handed) return;
  picture = picture_right(picture, width);
  layout = column_left(std::move(layout));
}

std::optional<Screen::Stage> RunScreen::stage(PracticeDesk& desk, int width, int height) {
  State& s = *state_;
  if (!desk.running()) return std::nullopt;
  if (!s.begun) s.begin(desk);
  s.latency.shown(now_s());  // the picture before this one is complete
  s.steer(desk);
  Stage out;
  out.view = s.view(desk);
  s.lay_out(out.view.hud, desk, width, height);
  s.rim = rim_angle(out.view.camera, s.picture, out.view.X_TI.p);
  out.x = s.picture.x;
  out.y = s.picture.y;
  out.width = s.picture.width;
  out.height = s.picture.height;
  out.dim = s.overlay ? 0.55 : 0;
  return out;
}

void RunScreen::State::pause(PracticeDesk& desk, bool paused) {
  if (!desk.running()->pause(paused)) desk.notice = desk.words()("An exam has no pause: the clock runs on.");
  overlay = paused;
  again = paused && again;
  RunSounds::hush(desk.sound());
}

/// A moment to come back to: the debrief's plots and the replay show it.
void RunScreen::State::mark(PracticeDesk& desk) const {
  AttemptRunner& run = *desk.running();
  if (run.newest().status.phase != Phase::kRun) {
    desk.notice = desk.words()("Nothing is marked before the clock begins.");
    return;
  }
  run.mark();
  desk.notice = desk.words()("Moment marked, at {0} s.", {desk.words().number(run.newest().status.run_time_s, 1)});
}

void RunScreen::State::command(Action action, PracticeDesk& desk) {
  switch (action) {
    case Action::kPause:
      asked = Asked::kPause;
      break;
    case Action::kRestart:
      asked = Asked::kPause;
      again = true;
      break;
    case Action::kMark:
      mark(desk);
      break;
    case Action::kForceBars:
      bars = !bars;
      break;
    case Action::kGuidance:
      if (desk.running()->scene().level.guides)
        guides = !guides;
      else
        desk.notice = desk.words()("This level has no guidance.");
      break;
    default:
      break;
  }
}

std::optional<ScreenName> RunScreen::handle(const InputEvent& event, PracticeDesk& desk) {
  State& s = *state_;
  if (!desk.running() || !s.begun) return {};
  if (event.kind == InputEvent::Kind::kFocusLost) {
    desk.steering().handle(event);
    if (!s.overlay) s.asked = State::Asked::kPause;  // nobody looks: nothing is missed, nothing counted
    return {};
  }
  if (s.overlay) return {};
  s.coach.saw(event, desk.keys());
  if (s.steering && desk.steering().handle(event)) {
    if (s.event_s <= 0) s.event_s = now_s();
    return {};
  }
  const bool pressed = event.kind == InputEvent::Kind::kKeyDown && !event.repeat;
  if (const auto action = desk.keys().action_of(event.key); pressed && action) s.command(*action, desk);
  return {};
}

/// Aborts this one and begins anew with a fresh board.
std::optional<ScreenName> RunScreen::State::restart(PracticeDesk& desk) {
  RunSounds::hush(desk.sound());
  desk.end_attempt();
  begun = overlay = false;
  if (const std::string hindered = desk.begin_attempt(); !hindered.empty()) {
    desk.notice = hindered;
    return ScreenName::kBriefing;
  }
  return {};
}

std::optional<ScreenName> RunScreen::State::ended(PracticeDesk& desk) {
  RunSounds::hush(desk.sound());
  begun = overlay = false;
  return desk.end_attempt() ? ScreenName::kDebrief : ScreenName::kBriefing;
}

std::optional<ScreenName> RunScreen::State::pause_panel(Ui& ui, PracticeDesk& desk) {
  const Words& w = desk.words();
  const bool stands = desk.running()->paused();
  const auto key = [&](Action action) { return key_name(desk.keys().key_of(action)); };
  const bool silent = !desk.running()->board_answers();
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
    to = restart(desk);
  } else if (again ? second : first) {
    pause(desk, false);
  } else if (left) {
    desk.end_attempt();
    begun = overlay = false;
    to = ScreenName::kBriefing;
  }
  ui.end_panel();
  return to;
}

/// Painted, not a panel: the pointer over it still steers.
void RunScreen::State::coach_panel(Ui& ui, PracticeDesk& desk) const {
  if (!coach.speaks() || !steering) return;
  const auto marks = coach.marks(desk.words(), desk.keys(), desk.steering().kind());
  const double line = 1.25 * ui.line_height(), pad = ui.px(12), side = 0.8 * ui.line_height();
  double wide = 0;
  for (const Coach::CoachMark& mark : marks) wide = std::max(wide, ui.text_width(mark.text));
  const double width = std::min(wide + side + 3 * pad, picture.width - 2 * pad), room = width - side - 3 * pad;
  const double x = picture.x + pad;
  double y = picture.y + pad;
  ui.paint_ground({x, y, width, line * static_cast<double>(marks.size()) + pad}, 0.85, ui.px(8));
  y += 0.5 * pad + 0.5 * (line - ui.line_height());
  for (const Coach::CoachMark& mark : marks) {
    ui.paint_mark(mark.done ? Mark::kTick : Mark::kOpen, x + pad, y + 0.5 * (ui.line_height() - side), side);
    ui.text_at(x + 2 * pad + side, y, mark.text, mark.done ? Ink::kDim : Ink::kText, room);
    y += line;
  }
}

/// In the black corner below the round field.
void RunScreen::State::key_hints(Ui& ui, const PracticeDesk& desk) const {
  const Words& w = desk.words();
  const auto key = [&](Action action) { return w.name(key_name(desk.keys().key_of(action))); };
  std::vector<std::string> lines{key(Action::kPause) + "  " + w("Pause"), key(Action::kHelp) + "  " + w("Help")};
  if (desk.scope() != "0")
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

std::optional<ScreenName> RunScreen::frame(Ui& ui, PracticeDesk& desk, double dt_s) {
  State& s = *state_;
  s.dt_s = dt_s;
  if (!desk.running()) return ScreenName::kBriefing;
  if (desk.running()->finished()) s.over_s += dt_s;
  if (desk.running()->stored() || s.over_s > kStoring_s) return s.ended(desk);
  if (!s.begun) return {};
  if (!s.overlay && !desk.running()->board_answers()) s.asked = State::Asked::kPause;
  if (!s.overlay) ui.keys_to_screen();
  s.coach.pass(dt_s);
  draw_hud(s.layout);
  if (s.rim && s.steering) s.rim_arrow(*s.rim, ui.px(26));
  s.key_hints(ui, desk);
  if (s.overlay) return s.pause_panel(ui, desk);
  s.coach_panel(ui, desk);
  if (std::exchange(s.asked, State::Asked::kNothing) != State::Asked::kNothing) s.pause(desk, true);
  return {};
}

}  // namespace trocar
