#include "tests/app/window/pages/ui_bench.h"

namespace trocar::ui_test {
namespace {

using testing_support::key;
using testing_support::pointer;
using testing_support::press;
using testing_support::typed;
using Kind = InputEvent::Kind;

class UiTest : public testing_support::UiBench {
 protected:
  const Area all_{40, 40, 600, 400};

  /// Clicks at a place, as a person: there, down, up.
  void click(const Draw& draw, double x, double y) {
    frame(draw, {pointer(Kind::kMouseMove, x, y)});
    frame(draw, {pointer(Kind::kButtonDown, x, y)});
    frame(draw, {pointer(Kind::kButtonUp, x, y)});
    frame(draw);
  }
  void in_panel(Ui& ui, const std::function<void()>& inside) {
    ui.begin_panel("p", all_);
    inside();
    ui.end_panel();
  }
};

TEST_F(UiTest, TextsAreNotedWithTheirPlaceAndRoom) {
  frame([&](Ui& ui) { in_panel(ui, [&] { ui.line("Force"); }); });
  const DrawnText* t = text("Force");
  ASSERT_TRUE(t);
  EXPECT_GE(t->x, all_.x);
  EXPECT_GE(t->y, all_.y);
  EXPECT_GT(t->width, 20);
  EXPECT_NEAR(t->height, 18, 0.5);
  EXPECT_LE(t->width, t->room);
  EXPECT_FALSE(t->shortened);
}

TEST_F(UiTest, LongLinesAreShortenedAndSaySo) {
  const std::string lengthy(200, 'w');
  frame([&](Ui& ui) { in_panel(ui, [&] { ui.line(lengthy); }); });
  ASSERT_TRUE(text(lengthy));
  EXPECT_TRUE(text(lengthy)->shortened);
  EXPECT_LE(text(lengthy)->width, text(lengthy)->room + 0.5);
}

TEST_F(UiTest, WrappedTextGrowsInHeightNotInWidth) {
  std::string many;
  for (int i = 0; i < 60; ++i) many += "word ";
  frame([&](Ui& ui) { in_panel(ui, [&] { ui.text(many); }); });
  ASSERT_TRUE(text(many));
  EXPECT_GT(text(many)->height, 3 * 18);
  EXPECT_LE(text(many)->width, text(many)->room + 0.5);
}

TEST_F(UiTest, ScaleDoublesWhatIsDrawn) {
  const Draw draw = [&](Ui& ui) { in_panel(ui, [&] { ui.line("Force"); }); };
  frame(draw);
  const double once = text("Force")->width;
  scale_ = 2;
  frame(draw);
  EXPECT_NEAR(text("Force")->width, 2 * once, 3);
  EXPECT_NEAR(text("Force")->height, 36, 0.5);
}

TEST_F(UiTest, LettersOfCentralEuropeHaveGlyphs) {
  frame([&](Ui& ui) {
    in_panel(ui, [&] {
      ui.line("\u0151");  // o with double acute, Latin Extended-A
      ui.line("\uE000");  // private use: the font's box
      ui.line("w");
    });
  });
  EXPECT_NE(text("\u0151")->width, text("\uE000")->width);
}

TEST_F(UiTest, ButtonIsChosenByThePointer) {
  int chosen = 0;
  const Draw draw = [&](Ui& ui) { in_panel(ui, [&] { chosen += ui.button("b", "Start") ? 1 : 0; }); };
  frame(draw);
  const DrawnText label = *text("Start");
  click(draw, label.x + 5, label.y + 5);
  EXPECT_EQ(chosen, 1);
  click(draw, all_.x + 500, all_.y + 300);
  EXPECT_EQ(chosen, 1) << "beside it nothing happens";
}

TEST_F(UiTest, ButtonIsChosenByItsKeyAndShowsIt) {
  int chosen = 0;
  const Draw draw = [&](Ui& ui) { in_panel(ui, [&] { chosen += ui.button("b", "Retry", "R") ? 1 : 0; }); };
  frame(draw);
  EXPECT_TRUE(text("[R]"));
  frame(draw, press('R'));
  EXPECT_EQ(chosen, 1);
  frame(draw, press('Q'));
  EXPECT_EQ(chosen, 1);
}

TEST_F(UiTest, TabGoesRoundAllItemsAndEnterChooses) {
  std::string chosen;
  const Draw draw = [&](Ui& ui) {
    in_panel(ui, [&] {
      for (const char* id : {"a", "b", "c"})
        if (ui.button(id, id)) chosen += id;
    });
  };
  frame(draw);
  for (const char* expected : {"a", "b", "c", "a"}) {
    chosen.clear();
    frame(draw, press(kKeyTab));
    frame(draw);
    EXPECT_TRUE(layer_->wants_keys());
    frame(draw, press(kKeyEnter));
    frame(draw);
    EXPECT_EQ(chosen, expected);
  }
}

TEST_F(UiTest, ShiftTabGoesBack) {
  std::string chosen;
  const Draw draw = [&](Ui& ui) {
    in_panel(ui, [&] {
      for (const char* id : {"a", "b", "c"})
        if (ui.button(id, id)) chosen += id;
    });
  };
  frame(draw);
  frame(draw, press(kKeyTab, true));
  frame(draw);
  frame(draw, press(kKeyEnter));
  EXPECT_EQ(chosen, "c");
}

TEST_F(UiTest, ArrowsMoveTheFocusAndSpaceChooses) {
  std::string chosen;
  const Draw draw = [&](Ui& ui) {
    in_panel(ui, [&] {
      for (const char* id : {"a", "b", "c"})
        if (ui.button(id, id)) chosen += id;
    });
  };
  frame(draw);
  frame(draw, press(kKeyTab));
  frame(draw);
  frame(draw, press(kKeyDown));
  frame(draw);
  frame(draw);
  frame(draw, {key(kKeySpace)});
  frame(draw, {key(kKeySpace, Kind::kKeyUp)});
  frame(draw);
  EXPECT_EQ(chosen, "b");
}

TEST_F(UiTest, StrongButtonsEnterYieldsToTheFocus) {
  std::string chosen;
  const Draw draw = [&](Ui& ui) {
    in_panel(ui, [&] {
      if (ui.button("strong", "Go", "Enter", true)) chosen += "strong ";
      if (ui.button("other", "Other")) chosen += "other ";
    });
  };
  frame(draw);
  frame(draw, press(kKeyEnter));
  EXPECT_EQ(chosen, "strong ");
  chosen.clear();
  for (int i = 0; i < 2; ++i) {
    frame(draw, press(kKeyTab));
    frame(draw);
  }
  frame(draw, press(kKeyEnter));
  EXPECT_EQ(chosen, "other ");
}

TEST_F(UiTest, FieldTakesTypingAndKeysOfButtonsAreSilent) {
  std::string value;
  int retried = 0, entered = 0;
  const Draw draw = [&](Ui& ui) {
    in_panel(ui, [&] {
      entered += ui.field("code", "Your code", value) ? 1 : 0;
      retried += ui.button("r", "Retry", "R") ? 1 : 0;
    });
  };
  frame(draw);
  frame(draw, press(kKeyTab));
  for (int i = 0; i < 3; ++i) frame(draw);
  frame(draw, typed("R-7"));
  std::vector<InputEvent> r = press('R');
  frame(draw, r);
  frame(draw);
  EXPECT_EQ(value, "R-7");
  EXPECT_EQ(retried, 0);
  frame(draw, press(kKeyEnter));
  frame(draw);
  EXPECT_EQ(entered, 1);
}

TEST_F(UiTest, TogglesAndChoicesByKeyboard) {
  bool on = false;
  int chosen = 0;
  const Draw draw = [&](Ui& ui) {
    in_panel(ui, [&] {
      ui.toggle("t", "Sound", on);
      ui.choice("c", "Picture", {"Plain", "Soft", "Full"}, chosen);
    });
  };
  frame(draw);
  frame(draw, press(kKeyTab));
  frame(draw);
  frame(draw, press(kKeyEnter));
  frame(draw);
  EXPECT_TRUE(on);
  frame(draw, press(kKeyTab));
  frame(draw);
  frame(draw, press(kKeyEnter));
  frame(draw);
  EXPECT_EQ(chosen, 1) << "Enter takes the next one";
}

TEST_F(UiTest, TableShowsCellsWithinTheirColumnsAndTellsTheRow) {
  int row = -1;
  const Draw draw = [&](Ui& ui) {
    in_panel(ui, [&] {
      const int now = ui.table("t", {"Metric", "Value"}, {0.6, 0.4}, {{{"time"}, {"12.0"}}, {{"path"}, {"340"}}});
      if (now >= 0) row = now;
    });
  };
  frame(draw);
  ASSERT_TRUE(text("path") && text("340") && text("Metric"));
  EXPECT_LT(text("path")->x + text("path")->width, text("340")->x);
  EXPECT_EQ(text("path")->y, text("340")->y);
  click(draw, text("path")->x + 3, text("path")->y + 3);
  EXPECT_EQ(row, 1);
}

TEST_F(UiTest, PanelThatIsTooFullSaysThatItScrolls) {
  const auto lines = [this](int n) {
    return [this, n](Ui& ui) {
      in_panel(ui, [&] {
        for (int i = 0; i < n; ++i) ui.line("line " + std::to_string(i));
      });
    };
  };
  frame(lines(5));
  EXPECT_TRUE(scrolling_.empty());
  frame(lines(80));
  EXPECT_EQ(scrolling_, std::vector<std::string>{"p"});
  EXPECT_FALSE(text("line 79")) << "what is not seen is not noted";
}

TEST_F(UiTest, KeysBelongToTheScreenWhenItAsks) {
  const Draw draw = [&](Ui& ui) {
    in_panel(ui, [&] { ui.button("a", "a"); });
    ui.keys_to_screen();
  };
  frame(draw);
  frame(draw, press(kKeyTab));
  frame(draw, press(kKeyDown));
  frame(draw);
  EXPECT_FALSE(layer_->wants_keys());
}

TEST_F(UiTest, LayerKnowsWhoseThePointerIs) {
  const Draw draw = [&](Ui& ui) { in_panel(ui, [&] { ui.line("x"); }); };
  frame(draw, {pointer(Kind::kMouseMove, 100, 100)});
  frame(draw);
  EXPECT_TRUE(layer_->wants_pointer());
  frame(draw, {pointer(Kind::kMouseMove, 1200, 700)});
  frame(draw);
  EXPECT_FALSE(layer_->wants_pointer());
}

/// Coloured px of a mark's square.
TEST_F(UiTest, MarksDifferInShapeNotOnlyInColour) {
  const auto grey_of = [&](Mark mark) {
    frame([&](Ui& ui) { in_panel(ui, [&] { ui.paint_mark(mark, 100, 100, 40); }); });
    const Image image = target_->read();
    std::vector<bool> lit;
    for (int y = 100; y < 140; ++y)
      for (int x = 100; x < 140; ++x) {
        const std::uint8_t* p = image.pixel(x, y);
        lit.push_back(p[0] + p[1] + p[2] > 150);
      }
    return lit;
  };
  std::vector<std::vector<bool>> all;
  for (const Mark mark :
       {Mark::kTick, Mark::kHalf, Mark::kOpen, Mark::kLock, Mark::kWarning, Mark::kUp, Mark::kDown, Mark::kPlay}) {
    all.push_back(grey_of(mark));
    EXPECT_GT(std::count(all.back().begin(), all.back().end(), true), 100) << static_cast<int>(mark);
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      int different = 0;
      for (std::size_t p = 0; p < all[i].size(); ++p) different += all[i][p] != all.back()[p] ? 1 : 0;
      EXPECT_GT(different, 100) << i << " and " << static_cast<int>(mark) << " look alike in grey";
    }
  }
}

}  // namespace
}  // namespace trocar::ui_test
