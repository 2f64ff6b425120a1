#include "app/window/practice/practice_loop.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "app/picture/gl/frame_target.h"
#include "app/picture/scene/renderer.h"
#include "app/window/attempt/file_stamp.h"
#include "app/window/device/device_panel.h"
#include "app/window/practice/screen_table.h"
#include "app/window/run/overlays.h"
#include "app/window/ui/theme.h"
#include "app/window/ui/ui_layer.h"
#include "haptics/input_error.h"
#include "trainees/store/database.h"

namespace trocar {
namespace {

/// Before anything has been timed.
Preset guessed_preset(bool software) { return software ? Preset::kSoft : Preset::kFull; }

/// What lives on the GPU, and goes with its context.
struct Drawn {
  GraphicsContext& context;
  FrameTarget target;
  UiLayer layer;
  Renderer renderer;
  std::unique_ptr<FrameTarget> small = {};  // once a desk has looked
  std::unique_ptr<Renderer> second = {};    // keeps its own organ on the GPU; while two runs are compared

  Drawn(PracticeModel& model, GraphicsContext& given, bool to_window, Preset preset)
      : context(given),
        target(context, to_window),
        layer(context, model.scale()),
        renderer(context, model.assets().assets, {.preset = preset}) {}

  /// What the scope shows, for a desk that looks: small, and made small by the GPU, so that reading it takes no time.
  Image small_picture(unsigned texture, const PixelRect& part) {
    constexpr int kHigh = 270, kWidest = 640;
    const int wide = std::clamp(kHigh * part.width / std::max(1, part.height), 64, kWidest);
    if (!small) small = std::make_unique<FrameTarget>(context, false);
    small->begin(wide, kHigh);
    small->place(texture, {0, 0, wide, kHigh}, 0);
    return small->read();
  }
};

}  // namespace

std::filesystem::path pictures_folder() {
  if (const char* folder = std::getenv("XDG_PICTURES_DIR"); folder && *folder) return folder;
  return default_database_path().parent_path() / "pictures";
}

struct PracticeLoop::State {
  PracticeModel& model;
  bool to_window, software;
  std::optional<Drawn> drawn;  // empty: the context was lost
  ScreenName name = ScreenName::kStart;
  std::vector<ScreenName> before;  // the way to this one, each once; without the run, which is over when it is left
  std::unique_ptr<Screen> screen;
  DevicePanel device;
  MenuChoice asked = MenuChoice::kNone;  // would end an exam: done when the person says so once more
  bool menu = false, help = false, fullscreen = false, picture_wanted = false;
  bool paused_by_menu = false;
  HelpPage help_page = HelpPage::kKeys;
  SoundPage sounds;
  double notice_age_s = 0;
  std::string notice;
  std::vector<DrawnText> texts;
  std::vector<std::string> scrolling;

  std::optional<PictureThrift> thrift, thrift_in_run;  // a page's picture costs another time than a run's
  bool timed = false, keeps_rate = false, plainer_told = false;
  bool draws_scopes = true;
  double size = 1;              // of the scope's pictures relative to their places
  std::string preset = "auto";  // as the settings had it when it was last followed
  long frames = 0;

  State(PracticeModel& given, GraphicsContext& context, bool window)
      : model(given), to_window(window), software(context.info().software), keeps_rate(window) {
    drawn.emplace(model, context, to_window, guessed_preset(software));
  }

  void show(ScreenName to);
  void remember(ScreenName to);
  void open_menu(bool open);
  void choose(MenuChoice choice);
  void answer(HelpChoice choice);
  void show_play(Play play);
  bool exam_runs() const;
  void ask(MenuChoice what);
  void answer(bool leave);
  bool command(const InputEvent& event);
  void dispatch(const std::vector<InputEvent>& events);
  void follow_preset(int width, int height);
  void use_preset(Preset wanted);
  void keep_rate(double dt_s);
  void draw_stage(int width, int height);
  void draw_interface(int width, int height, double dt_s, const std::vector<InputEvent>& events);
  void save_picture();
};

PracticeLoop::PracticeLoop(PracticeModel& model, GraphicsContext& context, bool to_window)
    : state_(std::make_unique<State>(model, context, to_window)) {
  const bool briefing = model.exercise_given() && make_screen(ScreenName::kBriefing);
  if (const auto play = model.play_given())
    state_->show_play(*play);
  else
    state_->show(briefing ? ScreenName::kBriefing : ScreenName::kStart);
}

PracticeLoop::~PracticeLoop() {
  if (state_->model.running()) state_->model.end_attempt();
}

/// The way back from `to`: a page that is gone to again is no step of it any more, the start page has none.
void PracticeLoop::State::remember(ScreenName to) {
  if (screen && name != to && name != ScreenName::kRun) {
    std::erase(before, name);
    before.push_back(name);
  }
  std::erase(before, to);
  if (to == ScreenName::kStart) before.clear();
}

void PracticeLoop::State::show(ScreenName to) {
  if (to == ScreenName::kQuit) {
    name = to;
    return;
  }
  if (to == ScreenName::kBack) {
    to = before.empty() ? ScreenName::kStart : before.back();
    if (!before.empty()) before.pop_back();
  } else {
    remember(to);
  }
  std::unique_ptr<Screen> made = make_screen(to);
  if (!made) {
    model.notice = model.words()("This page does not exist yet.");
    return;
  }
  screen = std::move(made);
  name = to;
}

/// An attempt stands still while the menu or the help is over it; an exam goes on.
void PracticeLoop::State::open_menu(bool open) {
  AttemptRunner* run = model.running();
  menu = open;
  if (!open) asked = MenuChoice::kNone;
  const bool covered = menu || help;
  if (run && covered && !run->paused()) {
    run->pause(true);
    paused_by_menu = true;
  } else if (run && !covered && paused_by_menu) {
    run->pause(false);
  }
  if (!covered) paused_by_menu = false;
}

bool PracticeLoop::State::exam_runs() const {
  AttemptRunner* run = model.running();
  return run && !run->finished() && run->scene().level.name == kExamLevel;
}

/// Over the menu, which takes keys and pointer from the exam below it.
void PracticeLoop::State::ask(MenuChoice what) {
  help = false;
  open_menu(true);
  asked = what;
}

void PracticeLoop::State::answer(bool leave) {
  const MenuChoice what = asked;
  open_menu(false);
  if (!leave) return;
  model.end_attempt();
  choose(what);
}

void PracticeLoop::State::choose(MenuChoice choice) {
  if (choice == MenuChoice::kNone) return;
  const bool stays = choice == MenuChoice::kBack || choice == MenuChoice::kFullscreen;
  if (!stays && exam_runs()) return ask(choice);
  open_menu(false);
  const auto leave = [this](ScreenName to) {
    if (model.running()) model.end_attempt();
    show(to);
  };
  switch (choice) {
    case MenuChoice::kLeaveAttempt:
      return leave(ScreenName::kBriefing);
    case MenuChoice::kStart:
      return leave(ScreenName::kStart);
    case MenuChoice::kSettings:
      return leave(ScreenName::kSettings);
    case MenuChoice::kQuit:
      return show(ScreenName::kQuit);
    case MenuChoice::kFullscreen:
      fullscreen = !fullscreen;
      return;
    case MenuChoice::kNone:
    case MenuChoice::kBack:
      return;
  }
}

void PracticeLoop::State::answer(HelpChoice choice) {
  if (choice == HelpChoice::kNone) return;
  help = false;
  open_menu(false);
  if (choice != HelpChoice::kTutorial) return;
  if (model.running()) model.end_attempt();
  show_play(Play::kTutorial);
}

/// Or the start page, which then says what hindered it.
void PracticeLoop::State::show_play(Play play) {
  const std::string hindered = model.begin_play(play);
  if (!hindered.empty()) model.notice = hindered;
  show(hindered.empty() ? ScreenName::kRun : ScreenName::kStart);
}

/// Keys that work on every screen. @return true when the event was one.
bool PracticeLoop::State::command(const InputEvent& event) {
  if (event.kind != InputEvent::Kind::kKeyDown || event.repeat) return false;
  if (event.key == kKeyF11) {
    fullscreen = !fullscreen;
    return true;
  }
  const std::optional<Action> action = model.keys().action_of(event.key);
  if (action == Action::kPicture) {
    picture_wanted = true;
  } else if (action == Action::kHelp) {
    help = !help;
    open_menu(false);
  } else if (action == Action::kDevicePanel && model.running()) {
    const bool there = model.running()->scene().loop.daq.motors;
    device.open = there && !device.open;
    if (!there) model.notice = model.words()("There is no device to be shown.");
  } else if (action == Action::kMenu && !menu && !help && screen && screen->takes_escape()) {
    return true;  // its button hears it
  } else if (action == Action::kMenu && !drawn->layer.popup_open()) {
    const bool close_help = std::exchange(help, false);
    open_menu(!close_help && !menu);
  } else {
    return false;
  }
  return true;
}

void PracticeLoop::State::dispatch(const std::vector<InputEvent>& events) {
  using Kind = InputEvent::Kind;
  const bool covered = menu || help;
  for (const InputEvent& event : events) {
    if (screen && !covered && screen->takes_all()) {
      if (const auto to = screen->handle(event, model)) show(*to);
      continue;
    }
    if (command(event) || covered || !screen) continue;
    const bool key = event.kind == Kind::kKeyDown || event.kind == Kind::kText;
    const bool press = event.kind == Kind::kButtonDown || event.kind == Kind::kWheel;
    // What was let go is told to the screen always: nothing stays held because a panel lay under the pointer.
    const bool over_panel = press && drawn->layer.wants_pointer() && !screen->holds_pointer();
    if ((key && drawn->layer.wants_keys()) || over_panel) continue;
    if (const auto to = screen->handle(event, model)) show(*to);
  }
}

/// What the settings say. "auto" in a window: timed once, after the first frame stands and as soon as the show scene is
/// made; in memory: a guess, so that pictures do not depend on how busy the machine is.
void PracticeLoop::State::follow_preset(int width, int height) {
  const std::string& wanted = model.settings().preset;
  if (preset != wanted) {
    preset = wanted;
    timed = false;
    thrift.reset();
    size = 1;
    use_preset(preset_named(wanted).value_or(guessed_preset(software)));
  }
  if (wanted != "auto" || timed || !to_window || frames == 0) return;
  const std::shared_ptr<const SceneView> scene = model.show_scene(0);
  if (!scene) return;
  timed = true;
  thrift.reset();
  size = 1;
  use_preset(measure_preset(drawn->renderer, guessed_preset(software), *scene, width, height));
}

void PracticeLoop::State::use_preset(Preset wanted) {
  RenderOptions options = drawn->renderer.options();
  options.preset = wanted;
  drawn->renderer.set_options(options);
  if (drawn->second) drawn->second->set_options(options);
}

/// A picture that was chosen by speed and comes too slowly is drawn more plainly, and says so once; a preset that a
/// person chose stays.
void PracticeLoop::State::keep_rate(double dt_s) {
  if (!keeps_rate || model.settings().preset != "auto" || frames < 3) return;
  if (!thrift) {
    thrift.emplace(drawn->renderer.options().preset, guessed_preset(software));
    thrift_in_run = thrift;
  }
  PictureThrift& now = name == ScreenName::kRun ? *thrift_in_run : *thrift;
  const bool changed = now.picture(dt_s), slower = changed && dt_s > PictureThrift::kQuick_s;
  size = now.now().size;
  if (now.now().preset == drawn->renderer.options().preset) return;
  use_preset(now.now().preset);
  if (!slower || std::exchange(plainer_told, true)) return;
  model.notice =
      model.words()("The picture had become slow and is drawn more plainly now. The settings can change that.");
}

/// Both pictures first, then both into the frame: drawing a picture binds framebuffers of its own.
void PracticeLoop::State::draw_stage(int width, int height) {
  follow_preset(width, height);
  struct Placed {
    unsigned texture;
    PixelRect part;
    double dim;
  };
  std::vector<Placed> placed;
  const bool room = !too_small(width, height);
  const auto draw = [&](const std::optional<Screen::Stage>& stage, Renderer& with) {
    PixelRect part{0, 0, width, height};
    if (stage->width > 0)
      part = {static_cast<int>(stage->x), static_cast<int>(stage->y), static_cast<int>(stage->width),
              static_cast<int>(stage->height)};
    if (part.width < 64 || part.height < 48 || !draws_scopes) return;
    const auto sized = [this](int length, int least) {
      return std::max(least, static_cast<int>(std::lround(size * length)));
    };
    placed.push_back({with.draw_scope(stage->view, sized(part.width, 64), sized(part.height, 48)), part,
                      std::max(stage->dim, menu || help ? 0.6 : 0.0)});
  };
  if (const auto stage = screen && room ? screen->stage(model, width, height) : std::nullopt)
    draw(stage, drawn->renderer);
  if (const auto beside = screen && room ? screen->second_stage(model, width, height) : std::nullopt) {
    if (!drawn->second)
      drawn->second = std::make_unique<Renderer>(drawn->context, model.assets().assets, drawn->renderer.options());
    draw(beside, *drawn->second);
  } else {
    drawn->second.reset();
  }
  if (!placed.empty() && name == ScreenName::kRun && model.desk_wants_picture())
    model.show_desk(drawn->small_picture(placed.front().texture, placed.front().part));
  drawn->target.begin(width, height);
  for (const Placed& one : placed) drawn->target.place(one.texture, one.part, one.dim);
}

void PracticeLoop::State::draw_interface(int width, int height, double dt_s, const std::vector<InputEvent>& events) {
  drawn->layer.set_scale(model.scale());
  drawn->layer.begin(width, height, dt_s, events);
  Ui ui(model.words(), model.scale(), width, height);
  std::optional<ScreenName> to;
  if (too_small(width, height))
    small_window(ui);
  else if (asked != MenuChoice::kNone) {
    if (const auto leave = leave_exam_overlay(ui, model.words()); leave || !exam_runs()) answer(leave.value_or(false));
  } else if (menu)
    choose(menu_overlay(ui, model, model.running() != nullptr));
  else if (help)
    answer(help_overlay(ui, model, help_page, sounds));
  else if (screen)
    to = screen->frame(ui, model, dt_s);
  sounds.pass(model.sound(), help && help_page == HelpPage::kSounds, dt_s);
  if (AttemptRunner* run = model.running();
      run && !too_small(width, height) && !menu && !help && !(screen && screen->asks()))
    device.frame(ui, model, run->newest().record, run->scene().loop, dt_s,
                 device_panel_area(ui, model.settings().left_handed));
  if (!too_small(width, height)) notice_overlay(ui, model, dt_s, notice_age_s, notice);
  texts = ui.text_audit();
  scrolling = ui.scrolling();
  drawn->layer.end();
  if (to) show(*to);
}

void PracticeLoop::State::save_picture() {
  picture_wanted = false;
  try {
    const std::filesystem::path folder = pictures_folder();
    std::filesystem::create_directories(folder);
    std::filesystem::path file = folder / ("trocar-" + file_stamp() + ".png");
    for (int n = 2; std::filesystem::exists(file); ++n)
      file = folder / ("trocar-" + file_stamp() + "-" + std::to_string(n) + ".png");
    write_png(file, drawn->target.read());
    model.notice = model.words()("Picture saved: {0}", {file.string()});
  } catch (const std::exception& error) {
    model.notice = model.words()("No picture could be saved: {0}", {error.what()});
  }
}

bool PracticeLoop::frame(int width, int height, double dt_s, const std::vector<InputEvent>& events) {
  State& s = *state_;
  if (!s.drawn) return true;
  s.dispatch(events);
  if (width >= 64 && height >= 48) {
    s.keep_rate(dt_s);
    s.draw_stage(width, height);
    s.draw_interface(width, height, dt_s, events);
    ++s.frames;
    if (s.picture_wanted) s.save_picture();
  }
  s.model.pass(dt_s);
  return s.name != ScreenName::kQuit;
}

bool PracticeLoop::close() {
  if (!state_->exam_runs()) return true;
  state_->ask(MenuChoice::kQuit);
  return false;
}

void PracticeLoop::lose_pictures() {
  State& s = *state_;
  InputEvent looks_away;
  looks_away.kind = InputEvent::Kind::kFocusLost;  // an attempt stands still, nothing stays held
  s.dispatch({looks_away});
  if (s.model.running()) s.model.running()->pause(true);
  s.drawn.reset();
}

void PracticeLoop::take_up(GraphicsContext& context) {
  State& s = *state_;
  s.software = context.info().software;
  s.drawn.emplace(s.model, context, s.to_window, preset_named(s.preset).value_or(guessed_preset(s.software)));
  s.timed = false;
  s.thrift.reset();
  s.size = 1;
  s.model.notice = s.model.words()("The graphics driver was started anew; nothing of the attempt is lost.");
}

void PracticeLoop::settle(double wait_s) {
  if (state_->screen) state_->screen->settle(state_->model, wait_s);
}

void PracticeLoop::draw_scopes(bool wanted) { state_->draws_scopes = wanted; }
void PracticeLoop::keep_rate() { state_->keeps_rate = true; }
void PracticeLoop::go(ScreenName name) { state_->show(name); }
ScreenName PracticeLoop::here() const { return state_->name; }
const Screen* PracticeLoop::screen() const { return state_->screen.get(); }
bool PracticeLoop::menu_open() const { return state_->menu; }
Preset PracticeLoop::preset() const { return state_->drawn->renderer.options().preset; }
bool PracticeLoop::holds_pointer() const {
  const State& s = *state_;
  return s.screen && !s.menu && !s.help && s.screen->holds_pointer();
}
bool PracticeLoop::fullscreen() const { return state_->fullscreen; }
void PracticeLoop::finish() const { state_->drawn->renderer.finish(); }
Image PracticeLoop::picture() const { return state_->drawn->target.read(); }
const std::vector<DrawnText>& PracticeLoop::texts() const { return state_->texts; }
const std::vector<std::string>& PracticeLoop::scrolling() const { return state_->scrolling; }

}  // namespace trocar
