// Lists, sliders, fields, rows: what they take, where their texts stand, also where there is little room.
#include "tests/app/window/pages/ui_bench.h"

namespace trocar::ui_items_test {
namespace {

using testing_support::key;
using testing_support::pointer;
using testing_support::press;
using testing_support::typed;
using Kind = InputEvent::Kind;

class UiItemsTest : public testing_support::UiBench {
 protected:
  Draw panel(const std::function<void(Ui&)>& inside, double width = 600) const {
    return [inside, width](Ui& ui) {
      ui.begin_panel("p", {40, 40, width, 500});
      inside(ui);
      ui.end_panel();
    };
  }
  void click(const Draw& draw, double x, double y) {
    frame(draw, {pointer(Kind::kMouseMove, x, y)});
    frame(draw, {pointer(Kind::kButtonDown, x, y)});
    frame(draw, {pointer(Kind::kButtonUp, x, y)});
    frame(draw);
  }
};

TEST_F(UiItemsTest, NamesStandBesideTheirControlsOrAboveThemWhereItIsNarrow) {
  std::string value;
  const auto inside = [&](Ui& ui) {
    ui.field("f", "A setting with a name", value);
    ui.line("below");
  };
  frame(panel(inside));
  const double beside = text("below")->y - text("A setting with a name")->y;
  frame(panel(inside, 220));
  EXPECT_GT(text("below")->y - text("A setting with a name")->y, beside + 10);
  EXPECT_FALSE(text("A setting with a name")->shortened);
}

TEST_F(UiItemsTest, ItemsOnOneLineStandSideBySide) {
  frame(panel([](Ui& ui) {
    ui.button("a", "One");
    ui.same_line();
    ui.button("b", "Two");
    ui.button("c", "Three");
  }));
  EXPECT_EQ(text("One")->y, text("Two")->y);
  EXPECT_GT(text("Two")->x, text("One")->x + text("One")->width);
  EXPECT_GT(text("Three")->y, text("One")->y);
}

TEST_F(UiItemsTest, AListOpensByPointerAndIsClosedByEscape) {
  int chosen = 0;
  const Draw draw = panel([&](Ui& ui) { ui.choice("c", "Picture", {"Plain", "Soft", "Full"}, chosen); });
  frame(draw);
  const DrawnText now = *text("Plain");
  EXPECT_FALSE(layer_->popup_open());
  click(draw, now.x + 5, now.y + 5);
  EXPECT_TRUE(layer_->popup_open());
  EXPECT_TRUE(layer_->wants_keys());
  frame(draw, press(kKeyEscape));
  frame(draw);
  EXPECT_FALSE(layer_->popup_open());
  EXPECT_EQ(chosen, 0);
}

TEST_F(UiItemsTest, AListTakesWhatIsClickedInIt) {
  int chosen = 0;
  const Draw draw = panel([&](Ui& ui) { ui.choice("c", "Picture", {"Plain", "Soft", "Full"}, chosen); });
  frame(draw);
  const DrawnText now = *text("Plain");
  click(draw, now.x + 5, now.y + 5);
  frame(draw);
  for (double y = now.y + 30; y < now.y + 140 && chosen != 2; y += 12) {
    if (!layer_->popup_open()) click(draw, now.x + 5, now.y + 5);
    click(draw, now.x + 5, y);
  }
  EXPECT_EQ(chosen, 2);
}

TEST_F(UiItemsTest, AListWithoutAChoiceShowsNothing) {
  int chosen = -1;
  const Draw draw = panel([&](Ui& ui) { EXPECT_FALSE(ui.choice("c", "Picture", {}, chosen)); });
  frame(draw);
  frame(draw, press(kKeyTab));
  frame(draw);
  frame(draw, press(kKeyEnter));
  EXPECT_EQ(chosen, -1);
}

TEST_F(UiItemsTest, ASliderGoesWhereItIsClickedAndNoFurther) {
  double value = 1;
  const Draw draw = panel([&](Ui& ui) { ui.slider("s", "Sensitivity", value, 0.25, 4, 2); });
  frame(draw);
  ASSERT_TRUE(text("1.00"));
  const double y = text("1.00")->y + 5;
  click(draw, 600, y);
  EXPECT_GT(value, 3);
  EXPECT_LE(value, 4);
  frame(draw, {pointer(Kind::kButtonDown, 600, y)});
  frame(draw, {pointer(Kind::kMouseMove, 5000, y)});
  frame(draw, {pointer(Kind::kButtonUp, 5000, y)});
  EXPECT_EQ(value, 4);
}

TEST_F(UiItemsTest, ASwitchIsTurnedByThePointer) {
  bool on = false;
  int changes = 0;
  const Draw draw = panel([&](Ui& ui) { changes += ui.toggle("t", "Sound", on) ? 1 : 0; });
  frame(draw);
  const DrawnText label = *text("Sound");
  click(draw, label.x - 20, label.y + 8);
  EXPECT_TRUE(on);
  click(draw, label.x - 20, label.y + 8);
  EXPECT_FALSE(on);
  EXPECT_EQ(changes, 2);
}

TEST_F(UiItemsTest, ASecretIsNotInTheNotes) {
  std::string value;
  const Draw draw = panel([&](Ui& ui) { ui.field("pin", "PIN", value, true); });
  frame(draw);
  frame(draw, press(kKeyTab));
  for (int i = 0; i < 3; ++i) frame(draw);
  frame(draw, typed("1234"));
  frame(draw);
  EXPECT_EQ(value, "1234");
  EXPECT_FALSE(text("1234"));
}

TEST_F(UiItemsTest, LettersOfAnotherLayoutAreTaken) {
  std::string value;
  const Draw draw = panel([&](Ui& ui) { ui.field("name", "Name", value); });
  frame(draw);
  frame(draw, press(kKeyTab));
  for (int i = 0; i < 3; ++i) frame(draw);
  InputEvent e;
  e.kind = Kind::kText;
  e.character = 0xE9;  // e acute
  frame(draw, {e});
  frame(draw);
  EXPECT_EQ(value, "\u00e9");
}

TEST_F(UiItemsTest, RowsShowTheirRightEndWithinTheRoom) {
  bool chosen = false;
  const Draw draw =
      panel([&](Ui& ui) { chosen |= ui.selectable("r", Mark::kLock, "L2", false, "after three passes"); });
  frame(draw);
  const DrawnText left = *text("L2"), right = *text("after three passes");
  EXPECT_LT(left.x + left.width, right.x);
  EXPECT_LE(right.x + right.width, 40 + 600);
  click(draw, left.x + 5, left.y + 5);
  EXPECT_TRUE(chosen);
}

TEST_F(UiItemsTest, RowsShortenBothEndsWhereThereIsNoRoom) {
  const std::string lengthy(120, 'n');
  frame(panel([&](Ui& ui) { ui.selectable("r", Mark::kTick, lengthy, false, lengthy + "r"); }, 300));
  for (const DrawnText& t : texts_) {
    EXPECT_TRUE(t.shortened);
    EXPECT_LE(t.x + t.width, 340.5);
  }
}

TEST_F(UiItemsTest, NumbersStandAtTheRightOfTheirColumn) {
  frame(panel([](Ui& ui) {
    const Ui::Cell one{"9.0", Ink::kText, Mark::kNone, true}, two{"120.0", Ink::kText, Mark::kNone, true};
    ui.table("t", {"Metric", "Value"}, {0.5, 0.5}, {{{"a"}, one}, {{"b"}, two}});
  }));
  EXPECT_NEAR(text("9.0")->x + text("9.0")->width, text("120.0")->x + text("120.0")->width, 0.6);
  EXPECT_NEAR(text("Value")->x + text("Value")->width, text("9.0")->x + text("9.0")->width, 0.6) << "so does the head";
}

TEST_F(UiItemsTest, ALongTableScrollsInItsHeight) {
  std::vector<std::vector<Ui::Cell>> rows;
  for (int i = 0; i < 60; ++i) rows.push_back({{"row " + std::to_string(i)}});
  frame(panel([&](Ui& ui) {
    ui.table("t", {}, {1}, rows, 200);
    ui.line("below");
  }));
  EXPECT_TRUE(text("row 0"));
  EXPECT_FALSE(text("row 59"));
  ASSERT_TRUE(text("below"));
  EXPECT_LT(text("below")->y, 300);
  EXPECT_TRUE(scrolling_.empty()) << "the panel itself does not";
}

TEST_F(UiItemsTest, RaggedRowsAndMissingColumnsAreNoHarm) {
  frame(panel([](Ui& ui) {
    ui.table("t", {"a"}, {0.5, 0.5}, {{{"1"}, {"2"}, {"3"}}, {}});
    ui.table("u", {}, {}, {{{"x"}}});
  }));
  EXPECT_TRUE(text("2"));
  EXPECT_FALSE(text("3")) << "there are two columns";
}

TEST_F(UiItemsTest, TheFootStandsAtTheFoot) {
  frame(panel([](Ui& ui) {
    ui.line("top");
    ui.to_bottom(20);
    ui.line("foot");
  }));
  EXPECT_GT(text("foot")->y, 480);
  EXPECT_LT(text("foot")->y + text("foot")->height, 541);
}

TEST_F(UiItemsTest, MarkedTextIsIndentedByItsMark) {
  frame(panel([](Ui& ui) {
    ui.line("plain");
    ui.marked(Mark::kTick, "done");
    ui.gap(40);
    ui.heading("later");
  }));
  EXPECT_GT(text("done")->x, text("plain")->x + 18);
  EXPECT_GT(text("later")->y, text("done")->y + 50);
}

TEST_F(UiItemsTest, WhatLiesInFrontHidesWhatIsBehind) {
  const auto draw = [&](bool front) {
    return [front](Ui& ui) {
      for (const char* id : {"over", "under"}) {
        ui.begin_panel(id, {100, 100, 200, 100}, 1);
        if (std::string(id) == "over") {
          if (front) ui.in_front();
          ui.paint_box({100, 100, 200, 100}, Ink::kAlarm);
        }
        ui.end_panel();
      }
    };
  };
  frame(draw(true));
  frame(draw(true));
  const Image image = target_->read();
  EXPECT_GT(image.pixel(200, 150)[0], 150);
}

TEST_F(UiItemsTest, AKeyIsOnlyPressedWhileNobodyTypes) {
  std::string value;
  bool pressed = false;
  const Draw draw = panel([&](Ui& ui) {
    pressed = ui.pressed("P");
    ui.field("f", "Code", value);
  });
  frame(draw);
  frame(draw, press('P'));
  EXPECT_TRUE(pressed);
  frame(draw, press(kKeyTab));
  for (int i = 0; i < 3; ++i) frame(draw);
  frame(draw, press('P'));
  EXPECT_FALSE(pressed);
}

TEST_F(UiItemsTest, LosingTheFocusLetsEverythingGo) {
  int chosen = 0;
  const Draw draw = panel([&](Ui& ui) { chosen += ui.button("b", "Start") ? 1 : 0; });
  frame(draw);
  const DrawnText label = *text("Start");
  frame(draw, {pointer(Kind::kMouseMove, label.x + 5, label.y + 5)});
  frame(draw, {pointer(Kind::kButtonDown, label.x + 5, label.y + 5), key('S')});
  InputEvent lost;
  lost.kind = Kind::kFocusLost;
  frame(draw, {pointer(Kind::kMouseMove, 1200, 700), lost});
  frame(draw);
  frame(draw);
  EXPECT_EQ(chosen, 0) << "let go elsewhere";
}

}  // namespace
}  // namespace trocar::ui_items_test
