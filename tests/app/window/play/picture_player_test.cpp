// Who sees only the screen can pass: the window's own pictures in, mouse events out, live.
#include <chrono>
#include <iostream>
#include <thread>

#include "app/window/practice/practice_loop.h"
#include "scenarios/scoring/attempt_result.h"
#include "tests/app/window/pages/loop_bench.h"
#include "tests/app/window/play/picture_player.h"

namespace trocar::testing_support::picture_player_test {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

class PictureMouse : public LoopBench {
 protected:
  /// One attempt, from its briefing to its debrief. @return its grade.
  Grade attempt(const std::string& exercise, std::int64_t seed, PlayerHand& hand) {
    ModelOptions options = bench_.options();
    options.exercise = exercise;
    options.seed = seed;
    options.input = "mouse";
    width_ = 960;
    height_ = 540;
    open(options);
    frame();
    tap(kKeyEnter);
    PicturePlayer player(hand);
    const char* folder = std::getenv("PLAYER_PICTURES");
    const Clock::time_point begin = Clock::now();
    Clock::time_point last = begin;
    std::vector<InputEvent> events;
    int n = 0;
    while (loop_->here() != ScreenName::kDebrief && seconds_since(begin) < 240) {
      const double dt_s = seconds_since(last);
      last = Clock::now();
      loop_->frame(width_, height_, dt_s, events);
      const Image picture = loop_->picture();
      events = player.play(seconds_since(begin), picture);
      if (folder && n++ % 12 == 0) {
        char name[64];
        std::snprintf(name, sizeof name, "/%05d.png", n);
        write_png(std::string(folder) + name, picture);
        const Glance g = glance(picture);
        std::cerr << name << ' ' << seconds_since(begin) << ' ' << player.doing << " force "
                  << static_cast<int>(g.force);
        if (g.lit) std::cerr << " lit " << g.lit->x << ' ' << g.lit->y << " w " << g.lit_wide;
        if (g.foot) std::cerr << " foot " << g.foot->x << ' ' << g.foot->y << " tip " << g.tip->x << ' ' << g.tip->y;
        std::cerr << '\n';
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_EQ(loop_->here(), ScreenName::kDebrief);
    return model_->result() ? model_->result()->grade : Grade{};
  }
};

void tell(const Grade& grade) {
  std::printf("%s score %.1f passed %d\n", status_name(grade.status), grade.score.value_or(-1), grade.passed);
  for (const Subscore& s : grade.subscores)
    std::printf("  %-16s %3.0f %%  raw %.3f %s\n", s.name.c_str(), 100 * s.value, s.raw.value_or(-1), s.unit.c_str());
}

TEST_F(PictureMouse, PassesSurfaceTouch) {
  MouseHand hand;
  const Grade grade = attempt("E02", 7, hand);
  tell(grade);
  EXPECT_TRUE(grade.passed);
}

}  // namespace
}  // namespace trocar::testing_support::picture_player_test
