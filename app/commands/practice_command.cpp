#include "app/commands/practice_command.h"

#include <chrono>
#include <ctime>
#include <functional>
#include <memory>
#include <ostream>
#include <thread>

#include "app/graphics/headless_context.h"
#include "app/interrupt.h"
#include "app/screens/practice_loop.h"
#include "app/screens/screen_table.h"
#include "app/window/window.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

constexpr double kStill_s = 1.0 / 30;   // between frames of a picture
constexpr double kMade_s = 30;          // for what a screen makes in the background
constexpr int kSettleFrames = 3;        // a panel knows its content's height in the second frame

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw EnvironmentError(folder.string() + ": cannot be made: " + error.message());
}

InputEvent key_event(InputEvent::Kind kind, std::int32_t key) {
  InputEvent event;
  event.kind = kind;
  event.key = key;
  return event;
}

/// A picture of the screen that is up, after some still frames.
void take(PracticeLoop& loop, const PracticeOptions& options, const std::string& name, std::ostream& out) {
  loop.frame(options.width, options.height, kStill_s, {});
  loop.settle(kMade_s);
  for (int i = 0; i < kSettleFrames; ++i) loop.frame(options.width, options.height, kStill_s, {});
  const std::filesystem::path file = options.screens / (name + ".png");
  write_png(file, loop.picture());
  out << file.string() << '\n';
}

/// Frames by the clock until `over` says so, or the time is up.
void play(PracticeLoop& loop, const PracticeOptions& options, double most_s, const std::function<bool()>& over) {
  const Clock::time_point begin = Clock::now();
  Clock::time_point last = begin;
  while (seconds_since(begin) < most_s && !over()) {
    const double dt_s = seconds_since(last);
    last = Clock::now();
    loop.frame(options.width, options.height, dt_s, {});
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

/// Those of an attempt, by a scripted hand, live: half way, and what follows its end.
void picture_attempt(const PracticeOptions& options, PracticeDesk& desk, PracticeLoop& loop, std::ostream& out) {
  constexpr double kHalfWay_s = 12, kLongest_s = 300;
  if (!make_screen(ScreenName::kRun)) return;
  const std::string hindered = desk.begin_attempt();
  if (!hindered.empty()) throw EnvironmentError("no attempt for the pictures: " + hindered);
  loop.go(ScreenName::kRun);
  play(loop, options, kHalfWay_s, [&] { return loop.here() != ScreenName::kRun; });
  take(loop, options, screen_name(ScreenName::kRun), out);
  play(loop, options, kLongest_s, [&] { return loop.here() != ScreenName::kRun; });
  for (const ScreenName name : {ScreenName::kDebrief, ScreenName::kProgress, ScreenName::kReplay}) {
    if (!make_screen(name)) continue;
    loop.go(name);
    if (loop.here() == name) take(loop, options, screen_name(name), out);
  }
}

/// Every screen as it is without an attempt, help and menu too; then those of an attempt.
int picture_screens(const PracticeOptions& given, std::ostream& out) {
  PracticeOptions options = given;
  if (options.desk.hand.empty()) options.desk.hand = "expert";
  PracticeDesk desk(options.desk, find_assets());
  make_folder(options.screens);
  desk.show_scene(30);
  HeadlessContext context;
  PracticeLoop loop(desk, context, false);
  const std::vector<InputEvent> help{key_event(InputEvent::Kind::kKeyDown, kKeyF1), key_event(InputEvent::Kind::kKeyUp, kKeyF1)};
  const std::vector<InputEvent> menu{key_event(InputEvent::Kind::kKeyDown, kKeyEscape), key_event(InputEvent::Kind::kKeyUp, kKeyEscape)};
  for (const ScreenName name : {ScreenName::kStart, ScreenName::kCurriculum, ScreenName::kBriefing, ScreenName::kSettings,
                                ScreenName::kNotch}) {
    if (!make_screen(name)) continue;
    loop.go(name);
    if (loop.here() == name) take(loop, options, screen_name(name), out);
  }
  loop.go(ScreenName::kStart);
  loop.frame(options.width, options.height, kStill_s, help);
  take(loop, options, "help", out);
  loop.frame(options.width, options.height, kStill_s, help);
  loop.frame(options.width, options.height, kStill_s, menu);
  take(loop, options, "menu", out);
  loop.frame(options.width, options.height, kStill_s, menu);
  picture_attempt(options, desk, loop, out);
  return 0;
}

/// Another window of the same size in place of one whose context is lost.
std::unique_ptr<Window> opened_anew(std::unique_ptr<Window> lost, PracticeLoop& loop) {
  const WindowOptions same{"Trocar", lost->width(), lost->height(), loop.fullscreen(), true};
  loop.lose_pictures();
  lost.reset();
  auto window = std::make_unique<Window>(same);
  loop.take_up(*window);
  return window;
}

/// Frames until the window is closed or a screen says quit. What a signal asks for is a quit too: an attempt ends as aborted.
void run_window(const PracticeOptions& options, PracticeDesk& desk, InterruptWatch& interrupt, Clock::time_point begin, std::ostream& err) {
  auto window = std::make_unique<Window>(WindowOptions{"Trocar", options.width, options.height, options.fullscreen, true});
  PracticeLoop loop(desk, *window, true);
  bool fullscreen = options.fullscreen, going = true;
  Clock::time_point last = Clock::now();
  double first_s = 0, first_cpu_s = 0;
  long frames = 0;
  while (going && !window->close_asked() && !interrupt.seen()) {
    const std::vector<InputEvent> events = window->poll();
    const double dt_s = seconds_since(last);
    last = Clock::now();
    going = loop.frame(window->width(), window->height(), dt_s, events);
    if (window->width() == 0 || window->height() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    window->present();
    if (window->lost()) window = opened_anew(std::move(window), loop);
    if (++frames == 1) {
      first_s = seconds_since(begin);
      first_cpu_s = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    }
    if (loop.fullscreen() != fullscreen) window->set_fullscreen(fullscreen = loop.fullscreen());
  }
  if (options.timing)
    err << "trocar: first frame after " << first_s << " s (" << first_cpu_s << " s of CPU), " << frames << " frames in "
        << seconds_since(begin) << " s on "
        << window->info().renderer << ", preset " << preset_name(loop.preset()) << '\n';
}

}  // namespace

int practice_command(const PracticeOptions& options, std::ostream& out, std::ostream& err) {
  const Clock::time_point begin = Clock::now();
  if (!options.screens.empty()) return picture_screens(options, out);
  InterruptWatch interrupt;  // before the desk starts a thread: it must inherit what is blocked
  PracticeDesk desk(options.desk, find_assets());
  run_window(options, desk, interrupt, begin, err);
  return 0;
}

}  // namespace trocar
