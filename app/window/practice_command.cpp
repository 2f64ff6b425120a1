#include "app/window/practice_command.h"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <iostream>
#include <memory>
#include <thread>
#include <utility>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/session/interrupt.h"
#include "app/window/glfw/window.h"
#include "app/window/practice/practice_loop.h"
#include "app/window/practice_pictures.h"
#include "haptics/device/backends/make_backend.h"
#include "trainees/records/demo_record.h"
#include "trainees/records/replica_facts.h"

namespace trocar {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

/// Each attempt starts threads; with heaps of their own for all of them the process grew by 28 MiB in 39 attempts, with
/// two it stays.
constexpr int kHeaps = 2;

/// Another window of the same size in place of one whose context is lost.
std::unique_ptr<Window> opened_anew(std::unique_ptr<Window> lost, PracticeLoop& loop) {
  const WindowOptions same{"Trocar", lost->width(), lost->height(), loop.fullscreen(), true};
  loop.lose_pictures();
  lost.reset();
  auto window = std::make_unique<Window>(same);
  loop.take_up(*window);
  return window;
}

/// How soon the debrief stands after an exercise's end, by the clock: the longest wait of all attempts.
class DebriefWait {
 public:
  /// After each frame.
  void look(const PracticeLoop& loop, PracticeModel& model) {
    AttemptRunner* run = model.running();
    const bool over = run && loop.here() == ScreenName::kRun && run->newest().status.phase >= Phase::kDone;
    if (over && !waiting_) since_ = Clock::now();
    const bool waited = std::exchange(waiting_, over) && !over;
    if (waited && loop.here() == ScreenName::kDebrief) longest_s_ = std::max(longest_s_, seconds_since(since_));
  }
  double longest_s() const { return longest_s_; }

 private:
  bool waiting_ = false;
  Clock::time_point since_ = {};
  double longest_s_ = 0;
};

/// Frames until the window is closed or a screen says quit. What a signal asks for is a quit too: an attempt ends as
/// aborted.
void run_window(const PracticeOptions& options, PracticeModel& model, InterruptWatch& interrupt,
                Clock::time_point begin, std::ostream& err) {
  auto window =
      std::make_unique<Window>(WindowOptions{"Trocar", options.width, options.height, options.fullscreen, true});
  PracticeLoop loop(model, *window, true);
  bool fullscreen = options.fullscreen, going = true;
  Clock::time_point last = Clock::now();
  double first_s = 0, first_cpu_s = 0;
  long frames = 0;
  DebriefWait debrief;
  while (going && !interrupt.seen()) {
    if (window->close_asked()) {
      if (loop.close()) break;
      window->stay_open();
    }
    const std::vector<InputEvent> events = window->poll();
    const double dt_s = seconds_since(last);
    last = Clock::now();
    going = loop.frame(window->width(), window->height(), dt_s, events);
    if (window->width() == 0 || window->height() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    window->present();
    debrief.look(loop, model);
    if (window->lost()) window = opened_anew(std::move(window), loop);
    if (++frames == 1) {
      first_s = seconds_since(begin);
      first_cpu_s = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    }
    window->hold_pointer(loop.holds_pointer());
    if (loop.fullscreen() != fullscreen) window->set_fullscreen(fullscreen = loop.fullscreen());
  }
  if (options.timing)
    err << "trocar: first frame after " << first_s << " s (" << first_cpu_s << " s of CPU), " << frames << " frames in "
        << seconds_since(begin) << " s on " << window->info().renderer << ", preset " << preset_name(loop.preset())
        << '\n';
  if (options.timing && debrief.longest_s() > 0)
    err << "trocar: debrief at most " << debrief.longest_s() << " s after the end of an exercise\n";
}

}  // namespace

int practice_command(const PracticeOptions& options, std::ostream& out, std::ostream& err) {
  ::mallopt(M_ARENA_MAX, kHeaps);
  const Clock::time_point begin = Clock::now();
  if (!options.screens.empty()) return picture_screens(options, out);
  InterruptWatch interrupt;  // before the model starts a thread: it must inherit what is blocked
  PracticeModel model(options.model, find_assets());
  if (const std::string& on = options.model.backend; !on.empty() && is_real_device(on))
    for (const std::string& doubt : device_doubts(model.device_files(), on)) err << "trocar: " << doubt << '\n';
  // Told now, not after the first exercise.
  if (model.database() != ":memory:") {
    const Database database(model.database(), OpenMode::kExisting);
    require_no_replica(database);
    require_no_demo(database, "no attempt of anybody is kept there. Give another with --db FILE");
  }
  run_window(options, model, interrupt, begin, err);
  return 0;
}

namespace {

struct PracticeArguments {
  PracticeOptions options;
  double scale = 1;
  std::int64_t seed = 0;
};

}  // namespace

void add_practice(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<PracticeArguments>();
  PracticeOptions& o = given->options;
  CLI::App* practice = parent.add_subcommand("practice", "The trainee's window: see, feel, be judged, try again");
  CLI::Option* exercise =
      practice->add_option("exercise", o.model.exercise, "Exercise id, number or FILE.toml: straight to its briefing");
  CLI::Option* level =
      practice->add_option("--level", o.model.level, "Level: L1, L2, L3 or exam")->capture_default_str();
  practice->add_option("--trainee", o.model.trainee,
                       "Trainee code, created when new (default: a guest, until signed in)");
  for (const auto& [flag, play, words] :
       {std::tuple("--free", Play::kFree, "Straight to free play on the organ: no clock, no score, nothing kept"),
        std::tuple("--gallbladder", Play::kGallbladder, "Straight to a gallbladder on its bed, likewise"),
        std::tuple("--stitching", Play::kStitching, "Straight to a needle and its thread, likewise"),
        std::tuple("--flap", Play::kFlap, "Straight to a flap of tissue to lift, likewise")})
    practice
        ->add_flag_callback(
            flag, [&o, play] { o.model.play = play; }, words)
        ->excludes(exercise)
        ->excludes(level);
  practice
      ->add_option("--input", o.model.input,
                   "What steers: auto (the first that moves), mouse, keyboard, gamepad, spacemouse or device")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "mouse", "keyboard", "gamepad", "spacemouse", "device"}));
  practice
      ->add_option(
          "--backend", o.model.backend,
          "Device of --input device: simulated, hostmot2 (a card on the network), mc4000 (the thesis' boards), or "
          "hostmot2-fake, mc4000-emulated")
      ->check(CLI::IsMember(
          {kSimulatedBackend, kHostmot2Backend, kFakeHostmot2Backend, kMc4000Backend, kEmulatedMc4000Backend}));
  practice->add_option("--card", o.model.card, kCardForms);
  practice->add_option("--sensor", o.model.force_sensor, kSensorForms);
  add_device_file_options(*practice, o.model.calibration, o.model.device);
  practice->add_option("--organ", o.model.organ, kOrganForms)->capture_default_str();
  add_tissue_option(*practice, o.model.tissue);
  practice->add_option("--db", o.model.database, "Database file, or :memory:, which keeps nothing")
      ->check(writable_path());
  CLI::Option* scale =
      practice->add_option("--scale", given->scale, "Size of text and buttons, this time (default: as in the settings)")
          ->check(CLI::Range(1.0, 2.0));
  practice->add_option("--language", o.model.language,
                       "en, fr or de, this time (default: as in the settings, else of LANG)");
  practice
      ->add_option(
          "--scope", o.model.scope,
          "Tip of the scope, degrees, this time: 0 or 30, turned by its light post (default: as in the settings)")
      ->check(CLI::IsMember({"0", "30"}));
  practice
      ->add_option("--settings", o.model.settings, "Settings file (default: trocar/settings.toml in $XDG_CONFIG_HOME)")
      ->check(writable_path());
  practice->add_option("--hand", o.model.hand,
                       "A scripted hand in place of a person: expert, novice, ... or SCRIPT.toml");
  CLI::Option* seed = practice->add_option("--seed", given->seed,
                                           "Every attempt draws its board from this (default: a fresh one each)");
  practice->add_option("--width", o.width, "Of the window, px")->capture_default_str()->check(CLI::Range(200, 16384));
  practice->add_option("--height", o.height, "Of the window, px")->capture_default_str()->check(CLI::Range(100, 16384));
  practice->add_flag("--fullscreen", o.fullscreen, "Fill the screen (F11 turns it on and off)");
  practice->add_option("--screens", o.screens, "No window: a PNG of every screen into this folder")
      ->check(writable_path());
  practice->add_flag("--timing", o.timing,
                     "Say how soon the first frame and the debrief stood, and how many frames there were");
  practice->callback([given, scale, seed, &chosen] {
    if (scale->count() > 0) given->options.model.scale = given->scale;
    if (seed->count() > 0) given->options.model.seed = given->seed;
    chosen = [given] { return practice_command(given->options, std::cout, std::cerr); };
  });
}

}  // namespace trocar
