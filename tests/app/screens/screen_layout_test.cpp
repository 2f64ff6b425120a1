// No text is cut, none lies over another, at every scale and window that people have. A screen that is new is in make_screen().
#include <cmath>

#include "app/screens/screen_table.h"
#include "tests/app/screens/loop_bench.h"

namespace trocar {
namespace {

struct Case {
  int width, height;
  double scale;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.width << "x" << c.height << " at " << 100 * c.scale << " %"; }

class ScreenLayout : public testing_support::LoopBench, public ::testing::WithParamInterface<Case> {
 protected:
  void look_at(const std::string& where) {
    const auto& texts = loop_->texts();
    ASSERT_FALSE(texts.empty()) << where;
    for (const DrawnText& t : texts) {
      EXPECT_FALSE(t.shortened && !may_be_short(t)) << where << ": cut: " << t.text;
      EXPECT_LE(t.width, t.room + 1) << where << ": wider than its room: " << t.text;
      EXPECT_GE(t.x, -0.5) << where << ": " << t.text;
      EXPECT_LE(t.x + std::min(t.width, t.room), width_ + 0.5) << where << ": out of the window: " << t.text;
    }
    for (std::size_t i = 0; i < texts.size(); ++i)
      for (std::size_t j = i + 1; j < texts.size(); ++j)
        EXPECT_LE(overlap(texts[i], texts[j]), 2.0) << where << ": '" << texts[i].text << "' lies over '" << texts[j].text << "'";
  }
  /// Credits and paths are as long as they are; the whole is shown elsewhere.
  static bool may_be_short(const DrawnText& t) { return t.text.find("phantom") != std::string::npos; }
  /// Lesser side of the common rectangle, px.
  static double overlap(const DrawnText& a, const DrawnText& b) {
    const double w = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
    const double h = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
    return w <= 0 || h <= 0 ? 0 : std::min(w, h);
  }
};

TEST_P(ScreenLayout, NothingIsCutAndNothingCollides) {
  width_ = GetParam().width;
  height_ = GetParam().height;
  DeskOptions options = bench_.options();
  options.scale = GetParam().scale;
  open(options);
  desk_->show_scene(60);
  for (const ScreenName name : {ScreenName::kStart, ScreenName::kSettings}) {
    loop_->go(name);
    for (int i = 0; i < 3; ++i) frame();
    look_at(screen_name(name));
  }
  ASSERT_EQ(desk_->sign_in("T-1"), "");
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
                         ::testing::Values(Case{1280, 720, 1}, Case{1280, 720, 1.5}, Case{1280, 720, 2}, Case{1920, 1080, 1},
                                           Case{1920, 1080, 2}, Case{800, 600, 1}));

}  // namespace
}  // namespace trocar
