// Shapes land where they are asked for, in the palette's colours; text in plots keeps to its room.
#include <algorithm>
#include <cmath>

#include "app/window/ui/theme.h"
#include "tests/app/window/pages/ui_bench.h"

namespace trocar::ui_paint_test {
namespace {

class UiPaintTest : public testing_support::UiBench {
 protected:
  void paint(const Draw& draw) {
    frame(draw);
    image_ = target_->read();
  }
  Rgb at(int x, int y) const {
    const std::uint8_t* p = image_.pixel(x, y);
    return {p[0], p[1], p[2]};
  }
  bool lit(int x, int y) const {
    const Rgb c = at(x, y);
    return c.r + c.g + c.b > 60;
  }
  /// Lit px of a rectangle, 0..1.
  double share(int x, int y, int width, int height) const {
    int count = 0;
    for (int i = x; i < x + width; ++i)
      for (int j = y; j < y + height; ++j) count += lit(i, j) ? 1 : 0;
    return static_cast<double>(count) / (width * height);
  }
  Image image_;
};

TEST_F(UiPaintTest, BoxesFillTheirAreaAndNoMore) {
  paint([](Ui& ui) { ui.paint_box({100, 50, 60, 20}, Ink::kGood); });
  EXPECT_EQ(at(130, 60), okabe_ito::kGreen);
  EXPECT_EQ(share(101, 51, 58, 18), 1);
  EXPECT_FALSE(lit(97, 60) || lit(163, 60) || lit(130, 47) || lit(130, 73));
}

TEST_F(UiPaintTest, FramesAreHollow) {
  paint([](Ui& ui) { ui.paint_frame({100, 50, 60, 40}, Ink::kAlarm, 2); });
  EXPECT_TRUE(lit(130, 50));
  EXPECT_FALSE(lit(130, 70));
}

TEST_F(UiPaintTest, HatchingStaysInsideAndLeavesGaps) {
  paint([](Ui& ui) { ui.paint_hatch({200, 100, 80, 40}, Ink::kAlarm); });
  const double inside = share(201, 101, 78, 38);
  EXPECT_GT(inside, 0.1);
  EXPECT_LT(inside, 0.7);
  EXPECT_EQ(share(150, 100, 48, 40), 0);
  EXPECT_EQ(share(200, 142, 80, 20), 0);
}

TEST_F(UiPaintTest, DashedLinesHaveGapsAndPlainOnesNone) {
  paint([](Ui& ui) {
    ui.paint_line(100, 200, 300, 200, Ink::kText, 3);
    ui.paint_line(100, 240, 300, 240, Ink::kText, 3, true);
  });
  EXPECT_EQ(share(102, 200, 190, 1), 1);
  EXPECT_LT(share(102, 240, 190, 1), 0.75);
  EXPECT_GT(share(102, 240, 190, 1), 0.25);
}

TEST_F(UiPaintTest, DiscsRingsAndTriangles) {
  paint([](Ui& ui) {
    ui.paint_disc(100, 300, 20, Ink::kCaution);
    ui.paint_ring(200, 300, 20, Ink::kCaution, 3);
    ui.paint_triangle(280, 320, 320, 320, 300, 280, Ink::kCaution);
  });
  EXPECT_EQ(at(100, 300), okabe_ito::kOrange);
  EXPECT_FALSE(lit(200, 300));
  EXPECT_TRUE(lit(220, 300) || lit(219, 300));
  EXPECT_TRUE(lit(300, 310));
  EXPECT_FALSE(lit(283, 290));
}

TEST_F(UiPaintTest, CurvesPassTheirPoints) {
  paint([](Ui& ui) { ui.paint_curve({{100, 400}, {150, 450}, {200, 400}}, Ink::kHeading, 3); });
  for (const auto& [x, y] : {std::pair{125, 425}, std::pair{150, 449}, std::pair{175, 425}})
    EXPECT_TRUE(lit(x, y)) << x;
  EXPECT_FALSE(lit(150, 420));
}

TEST_F(UiPaintTest, EmptyCurvesAndAreasDrawNothing) {
  paint([](Ui& ui) {
    ui.paint_curve({}, Ink::kText);
    ui.paint_hatch({100, 100, 0, 0}, Ink::kAlarm);
    ui.paint_line(50, 50, 50, 50, Ink::kText, 2, true);
  });
  EXPECT_EQ(share(60, 60, 200, 200), 0);
}

TEST_F(UiPaintTest, GroundUnderTextHidesWhatLiesBehind) {
  paint([](Ui& ui) {
    ui.paint_box({100, 100, 100, 40}, Ink::kText);
    ui.paint_ground({100, 100, 100, 40}, 1);
  });
  EXPECT_EQ(at(150, 120), ground_colour(Ground::kPanel));
}

TEST_F(UiPaintTest, TextAtIsAnchoredAndKeepsToItsRoom) {
  paint([](Ui& ui) {
    ui.text_at(400, 100, "peak", Ink::kText, 0, 0);
    ui.text_at(400, 140, "limit", Ink::kText, 0, 1);
    ui.text_at(400, 180, "middle", Ink::kText, 0, 0.5);
    ui.text_at(400, 220, "a very long label of an axis", Ink::kDim, 80);
  });
  EXPECT_EQ(text("peak")->x, 400);
  EXPECT_NEAR(text("limit")->x + text("limit")->width, 400, 0.01);
  EXPECT_NEAR(text("middle")->x + text("middle")->width / 2, 400, 0.01);
  EXPECT_TRUE(text("a very long label of an axis")->shortened);
  EXPECT_LE(text("a very long label of an axis")->width, 80);
  EXPECT_GT(share(400, 100, 30, 18), 0.05) << "and it is drawn";
}

TEST_F(UiPaintTest, TextAtInAPanelIsDrawnInIt) {
  paint([](Ui& ui) {
    ui.begin_panel("p", {300, 300, 200, 100}, 1);
    ui.text_at(320, 330, "12.0 N", Ink::kText, 0, 0, true);
    ui.end_panel();
  });
  ASSERT_TRUE(text("12.0 N"));
  EXPECT_NEAR(text("12.0 N")->height, 20, 0.5) << "headings are larger";
  EXPECT_GT(share(320, 330, 50, 20), 0.1);
}

TEST_F(UiPaintTest, WidthsAreThoseThatAreDrawn) {
  double told = 0, line = 0;
  paint([&](Ui& ui) {
    told = ui.text_width("Force");
    line = ui.line_height();
    ui.text_at(10, 10, "Force");
  });
  EXPECT_EQ(told, text("Force")->width);
  EXPECT_EQ(line, text("Force")->height);
}

TEST_F(UiPaintTest, DrawingsTellThePointer) {
  Ui::Pointer seen;
  Area area;
  const Draw draw = [&](Ui& ui) {
    ui.begin_panel("p", {300, 300, 400, 300});
    area = ui.drawing("plot", 100);
    seen = ui.pointer();
    ui.end_panel();
  };
  frame(draw);
  EXPECT_GT(area.width, 300);
  EXPECT_NEAR(area.height, 100, 0.1);
  EXPECT_FALSE(seen.over);
  using testing_support::pointer;
  frame(draw, {pointer(InputEvent::Kind::kMouseMove, area.x + 50, area.y + 50)});
  frame(draw, {pointer(InputEvent::Kind::kButtonDown, area.x + 50, area.y + 50)});
  EXPECT_TRUE(seen.over);
  EXPECT_TRUE(seen.clicked);
  EXPECT_EQ(seen.x, area.x + 50);
  frame(draw, {pointer(InputEvent::Kind::kMouseMove, area.x - 200, area.y + 50)});
  EXPECT_TRUE(seen.held) << "dragged out of it";
  frame(draw, {pointer(InputEvent::Kind::kButtonUp, area.x - 200, area.y + 50)});
  frame(draw);
  EXPECT_FALSE(seen.held);
}

TEST_F(UiPaintTest, DrawingsTakeStepsByKeysWhileTheyHaveTheFocus) {
  int steps = 0;
  const Draw draw = [&](Ui& ui) {
    ui.begin_panel("p", {300, 300, 400, 300});
    ui.drawing("plot", 100);
    steps = ui.key_steps();
    ui.end_panel();
  };
  frame(draw);
  frame(draw, testing_support::press('.'));
  EXPECT_EQ(steps, 0) << "it has no focus yet";
  frame(draw, testing_support::press(kKeyTab));
  frame(draw);
  frame(draw, testing_support::press('.'));
  EXPECT_EQ(steps, 1);
  frame(draw, testing_support::press(','));
  EXPECT_EQ(steps, -1);
}

}  // namespace
}  // namespace trocar::ui_paint_test
