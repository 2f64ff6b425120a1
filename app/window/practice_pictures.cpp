#include "app/window/practice_pictures.h"

#include <chrono>
#include <functional>
#include <ostream>
#include <thread>

#include "app/picture/gl/headless_context.h"
#include "app/window/practice/practice_loop.h"
#include "app/window/practice/screen_table.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

using Clock = std::chrono::steady_clock;

double picture_seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

constexpr double kStill_s = 1.0 / 30;  // between frames of a picture
constexpr double kMade_s = 30;         // for what a screen makes in the background
constexpr int kSettleFrames = 3;       // a panel knows its content's height in the second frame
constexpr double kHalfWay_s = 12, kLongest_s = 300;

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw EnvironmentError(folder.string() + ": cannot be made: " + error.message());
}

/// One person who goes through all pages and takes a picture of each.
class Photographer {
 public:
  Photographer(const PracticeOptions& options, std::ostream& out)
      : options_(options), out_(out), model_(options.model, find_assets()), loop_(model_, context_, false) {}

  void all() {
    model_.show_scene(kMade_s);
    for (const ScreenName name : {ScreenName::kStart, ScreenName::kCurriculum, ScreenName::kBriefing,
                                  ScreenName::kSettings, ScreenName::kNotch})
      page(name);
    over_start();
    attempt();
    for (const ScreenName name : {ScreenName::kDebrief, ScreenName::kProgress, ScreenName::kReplay}) page(name);
  }

 private:
  void press(std::int32_t key) {
    InputEvent event;
    event.kind = InputEvent::Kind::kKeyDown;
    event.key = key;
    InputEvent up = event;
    up.kind = InputEvent::Kind::kKeyUp;
    loop_.frame(options_.width, options_.height, kStill_s, {event, up});
  }
  void press(Action action) { press(model_.keys().key_of(action)); }

  /// After some still frames.
  void take(const std::string& name) {
    loop_.frame(options_.width, options_.height, kStill_s, {});
    loop_.settle(kMade_s);
    for (int i = 0; i < kSettleFrames; ++i) loop_.frame(options_.width, options_.height, kStill_s, {});
    const std::filesystem::path file = options_.screens / (name + ".png");
    write_png(file, loop_.picture());
    out_ << file.string() << '\n';
  }

  void page(ScreenName name) {
    loop_.go(name);
    if (loop_.here() == name) take(screen_name(name));
  }

  void over_start() {
    loop_.go(ScreenName::kStart);
    press(Action::kHelp);
    take("help");
    press(kKeyF2);
    take("help-measures");
    press(kKeyF4);
    take("help-sounds");
    press(Action::kHelp);
    press(Action::kMenu);
    take("menu");
    press(Action::kMenu);
  }

  /// Frames by the clock until the run is over, or the time is up.
  void play(double most_s) {
    const Clock::time_point begin = Clock::now();
    Clock::time_point last = begin;
    while (picture_seconds_since(begin) < most_s && loop_.here() == ScreenName::kRun) {
      const double dt_s = picture_seconds_since(last);
      last = Clock::now();
      loop_.frame(options_.width, options_.height, dt_s, {});
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

  /// By the scripted hand, live: half way, what may lie over it, and on to its end.
  void attempt() {
    const std::string hindered = model_.begin_attempt();
    if (!hindered.empty()) throw EnvironmentError("no attempt for the pictures: " + hindered);
    loop_.go(ScreenName::kRun);
    play(kHalfWay_s);
    take(screen_name(ScreenName::kRun));
    press(Action::kDevicePanel);
    take("device");
    press(Action::kPause);
    take("pause");
    press(Action::kPause);
    press(Action::kDevicePanel);
    play(kLongest_s);
  }

  const PracticeOptions& options_;
  std::ostream& out_;
  PracticeModel model_;
  HeadlessContext context_;
  PracticeLoop loop_;
};

}  // namespace

int picture_screens(const PracticeOptions& given, std::ostream& out) {
  PracticeOptions options = given;
  if (options.model.hand.empty()) options.model.hand = "expert";
  make_folder(options.screens);
  Photographer(options, out).all();
  return 0;
}

}  // namespace trocar
