// No text is cut, none lies over another, at every scale and window that people have. A screen that is new is in
// make_screen().
#include "app/window/practice/screen_table.h"
#include "tests/app/window/pages/layout_check.h"
#include "tests/app/window/pages/loop_bench.h"

namespace trocar::screen_layout_test {
namespace {

struct Case {
  int width, height;
  double scale;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.width << "x" << c.height << " at " << 100 * c.scale << " %";
}

class ScreenLayout : public testing_support::LoopBench, public ::testing::WithParamInterface<Case> {
 protected:
  void look_at(const std::string& where) { testing_support::expect_laid_out(loop_->texts(), width_, height_, where); }
};

TEST_P(ScreenLayout, NothingIsCutAndNothingCollides) {
  width_ = GetParam().width;
  height_ = GetParam().height;
  ModelOptions options = bench_.options();
  options.scale = GetParam().scale;
  open(options);
  model_->show_scene(60);
  for (const ScreenName name : {ScreenName::kStart, ScreenName::kSettings}) {
    loop_->go(name);
    for (int i = 0; i < 3; ++i) frame();
    look_at(screen_name(name));
  }
  ASSERT_EQ(model_->sign_in("T-1"), "");
  loop_->go(ScreenName::kStart);
  for (int i = 0; i < 3; ++i) frame();
  look_at("start, signed in");
  for (const auto& [key, name] : {std::pair{kKeyEscape, "menu"}, std::pair{kKeyF1, "help"}}) {
    tap(key);
    frame();
    look_at(name);
    if (key == kKeyF1) {
      tap(kKeyF4);
      frame();
      look_at("help, sounds");
    }
    tap(key);
  }
}

INSTANTIATE_TEST_SUITE_P(Windows, ScreenLayout,
                         ::testing::Values(Case{1280, 720, 1}, Case{1280, 720, 1.5}, Case{1280, 720, 2},
                                           Case{1920, 1080, 1}, Case{1920, 1080, 2}, Case{800, 600, 1}));

}  // namespace
}  // namespace trocar::screen_layout_test
