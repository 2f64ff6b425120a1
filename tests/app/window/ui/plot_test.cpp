// Axes, places of labels, and what a plot maps where.
#include "app/window/ui/plot.h"

#include <cmath>
#include <random>

#include "tests/app/window/pages/ui_bench.h"

namespace trocar::plot_test {
namespace {

TEST(NiceAxis, StepsAreOneTwoOrFiveTimesAPowerOfTen) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> exponent(-3, 5);
  for (int i = 0; i < 2000; ++i) {
    const double high = std::pow(10, exponent(random));
    const Axis axis = nice_axis(0, high, 6);
    ASSERT_GE(axis.ticks.size(), 2u) << high;
    EXPECT_LE(axis.ticks.size(), 6u) << high;
    EXPECT_GE(axis.high, high * (1 - 1e-6));
    const double step = axis.ticks[1] - axis.ticks[0],
                 mantissa = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
    EXPECT_LT(std::min({std::abs(mantissa - 1), std::abs(mantissa - 2), std::abs(mantissa - 5)}), 1e-6) << high;
    EXPECT_NEAR(axis.ticks.front(), axis.low, 1e-9 * high);
    EXPECT_NEAR(axis.ticks.back(), axis.high, 1e-6 * high);
  }
}

TEST(NiceAxis, TicksAreWrittenWithTheDecimalsThatTheyNeed) {
  EXPECT_EQ(nice_axis(0, 1, 6).decimals, 1);
  EXPECT_EQ(nice_axis(0, 0.06, 4).decimals, 2);
  EXPECT_EQ(nice_axis(0, 120, 5).decimals, 0);
  EXPECT_EQ(nice_axis(0, 1, 3).ticks, (std::vector<double>{0, 0.5, 1}));
}

TEST(NiceAxis, NotWidenedItKeepsItsEnds) {
  const Axis axis = nice_axis(0, 57.3, 7, false);
  EXPECT_EQ(axis.high, 57.3);
  EXPECT_EQ(axis.ticks, (std::vector<double>{0, 10, 20, 30, 40, 50}));
}

TEST(NiceAxis, NothingToShowIsStillAnAxis) {
  for (const auto& [low, high] : {std::pair{0.0, 0.0}, {1.0, NAN}, {5.0, 5.0}, {3.0, 1.0}}) {
    const Axis axis = nice_axis(low, high, 4);
    EXPECT_LT(axis.low, axis.high);
    EXPECT_GE(axis.ticks.size(), 2u);
  }
}

TEST(CountAxis, HasWholeNumbersOnly) {
  for (int high = 1; high < 300; ++high)
    for (const double tick : count_axis(1, high, 7).ticks) EXPECT_EQ(tick, std::floor(tick)) << high;
  EXPECT_EQ(count_axis(1, 1, 5).high, 2);
}

TEST(PlaceLabels, NeverOverlapEachOtherOrLeaveTheirArea) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(0, 300), y(0, 120), wide(20, 140);
  const Area within{0, 0, 300, 120};
  for (int round = 0; round < 200; ++round) {
    std::vector<LabelWish> wishes;
    for (int i = 0; i < 8; ++i) wishes.push_back({x(random), y(random), wide(random), 16});
    const std::vector<Area> taken{{100, 40, 80, 20}};
    const auto places = place_labels(wishes, within, taken, 2);
    ASSERT_EQ(places.size(), wishes.size());
    EXPECT_TRUE(places[0]) << "the first always finds room here";
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!places[i]) continue;
      const Area& a = *places[i];
      EXPECT_FALSE(overlap(a, taken[0]));
      EXPECT_GE(std::min(a.x, a.y), -0.02);
      EXPECT_LE(a.x + a.width, 300.02);
      EXPECT_LE(a.y + a.height, 120.02);
      for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(places[j] && overlap(a, *places[j])) << round;
    }
  }
}

TEST(PlaceLabels, TwoAtOnePointStandAboveEachOtherAndWhatHasNoRoomIsLeftOut) {
  const Area within{0, 0, 200, 60};
  const auto places = place_labels({{100, 30, 80, 16}, {100, 30, 80, 16}, {100, 30, 300, 16}}, within, {}, 1);
  ASSERT_TRUE(places[0] && places[1]);
  EXPECT_FALSE(overlap(*places[0], *places[1]));
  EXPECT_FALSE(places[2]) << "wider than the plot";
}

class PlotTest : public testing_support::UiBench {
 protected:
  void draw(const std::function<void(Plot&)>& use, double height = 200) {
    frame([&](Ui& ui) {
      ui.begin_panel("all", {0, 0, 700, 500});
      const Area area = ui.drawing("plot", height);
      Plot plot(ui, area, {nice_axis(0, 60, 7, false), nice_axis(0, 2, 5), "s", "Force, N", true, false, 0});
      use(plot);
      plot.labels();
      ui.end_panel();
    });
  }
};

TEST_F(PlotTest, MapsValuesToPixelsAndBack) {
  draw([](Plot& plot) {
    EXPECT_DOUBLE_EQ(plot.x_px(0), plot.inner().x);
    EXPECT_DOUBLE_EQ(plot.x_px(60), plot.inner().x + plot.inner().width);
    EXPECT_DOUBLE_EQ(plot.y_px(0), plot.inner().y + plot.inner().height);
    EXPECT_NEAR(plot.x_at(plot.x_px(17)), 17, 1e-9);
    EXPECT_EQ(plot.x_at(-1e4), 0);
    EXPECT_EQ(plot.x_at(1e4), 60);
  });
}

TEST_F(PlotTest, TicksCarryTheUnitOnceAndTextsStandClear) {
  draw([](Plot& plot) {
    plot.band(0.4, 0.8, "wanted 0.4 to 0.8 N");
    plot.limit(1.5, "limit 1.5 N");
    plot.cursor(58, "58.0 s");
    plot.rule(58, "end", Ink::kText);
  });
  EXPECT_TRUE(text("60 s"));
  EXPECT_TRUE(text("50"));
  EXPECT_TRUE(text("limit 1.5 N"));
  for (std::size_t i = 0; i < texts_.size(); ++i)
    for (std::size_t j = i + 1; j < texts_.size(); ++j)
      EXPECT_FALSE(overlap({texts_[i].x, texts_[i].y, texts_[i].width, texts_[i].height},
                           {texts_[j].x, texts_[j].y, texts_[j].width, texts_[j].height}, -1.5))
          << texts_[i].text << " | " << texts_[j].text;
}

TEST_F(PlotTest, ALimitAboveTheAxisIsNotDrawn) {
  draw([](Plot& plot) { plot.limit(2.5, "limit"); });
  EXPECT_FALSE(text("limit"));
}

TEST_F(PlotTest, APeakOfOneTickIsSeen) {
  std::vector<ForceTrace::Column> columns(500);
  for (auto& c : columns) c = {0, 0, true};
  columns[250] = {0, 1.9, true};
  double x = 0, y = 0;
  draw([&](Plot& plot) {
    plot.columns(columns, Ink::kHeading);
    x = plot.inner().x + plot.inner().width * 250.5 / 500;
    y = plot.y_px(1.0);
  });
  const Image image = target_->read();
  const std::size_t at =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  EXPECT_GT(int(image.rgb[at + 2]), 150) << "sky blue at half its height";
}

}  // namespace
}  // namespace trocar::plot_test
