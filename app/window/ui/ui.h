// The few pieces that screens are made of, drawn by ImGui in the theme's colours; every text is measured and noted, so
// that clipping and overlap can be tested (text_audit()).
//
// Sizes in px at 720 lines and scale 1; the Ui multiplies. Colours: Okabe and Ito, and never colour alone. Thread: the
// window's, between begin and end of a frame of the UiLayer.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/window/words/translator.h"

namespace trocar {

enum class Ink : std::uint8_t { kText, kDim, kHeading, kGood, kCaution, kAlarm, kAccent, kTip };
enum class Mark : std::uint8_t { kNone, kTick, kHalf, kOpen, kLock, kWarning, kInfo, kUp, kDown, kPlay };

/// A text as it was drawn: for tests of layout.
struct DrawnText {
  std::string text;
  double x = 0, y = 0, width = 0, height = 0;  ///< px needed
  double room = 0;                             ///< px that there were; narrower than width: clipped
  bool shortened = false;                      ///< ends with an ellipsis, the whole is shown on hover
  bool in_front = false;                       ///< of a panel that lies over all others
  bool ground = false;                         ///< painted behind all panels
};

struct Area {
  double x = 0, y = 0, width = 0, height = 0;  ///< px of the window
};

class Ui {
 public:
  Ui(const Translator& words, double scale, int width_px, int height_px);

  const Translator& words() const { return words_; }
  double px(double at_720) const;  ///< length at this scale
  double width() const { return width_; }
  double height() const { return height_; }

  /// A panel; what follows stands in it, from the top, until end_panel(). Scrolls when it must (never in a briefing).
  void begin_panel(const char* id, const Area& area, double opacity = 0.92);
  /// The open panel lies over all that others have drawn: menus, notices.
  void in_front();
  void end_panel();
  /// A panel for buttons along an edge: less air above and below; strip_height() px hold `rows` of them.
  void begin_strip(const char* id, const Area& area, double opacity = 0.92);
  double strip_height(int rows) const;
  double strip_room(double width) const;  ///< px between the edges of a panel so wide
  double room() const;                    ///< px to the panel's right edge
  /// The last item is scrolled to where it is seen.
  void reveal();
  /// Page keys move what does not fit into the open panel up and down, also while the keys are the screen's.
  /// @param arrows these too, by some lines; they are then not the focus'.
  void scroll_by_keys(bool arrows = false);

  /// @param right stands at the panel's right edge, on the title's line where both fit, else below it: who is here.
  void title(const std::string& text, const std::string& right = "");
  void heading(const std::string& text);
  void text(const std::string& text, Ink ink = Ink::kText);  ///< wraps
  void line(const std::string& text, Ink ink = Ink::kText);  ///< one line, shortened with an ellipsis when it must
  void marked(Mark mark, const std::string& text, Ink ink = Ink::kText);
  /// Name left, value right, both wrapped to their halves' room.
  void pair(const std::string& name, const std::string& value, Ink ink = Ink::kText);
  /// Room for something painted, as wide as there is; no item, so Tab passes it by.
  Area placed(double height_at_720);
  /// Wrapped text in the middle of a place of its own, from its left edge.
  void text_in(const Area& area, const std::string& text, Ink ink = Ink::kText);
  void gap(double at_720 = 8);
  void same_line(double at_720 = 12);
  /// @param key shown in brackets, "Enter"; pressing it counts as a click. @param strong the one button that Enter
  /// means while nothing has the focus and nobody types. @return true when chosen.
  bool button(const char* id, const std::string& text, const std::string& key = "", bool strong = false,
              double width_at_720 = 0);
  bool toggle(const char* id, const std::string& text, bool& value);
  bool choice(const char* id, const std::string& text, const std::vector<std::string>& options, int& chosen);
  bool slider(const char* id, const std::string& text, double& value, double low, double high, int decimals);
  bool field(const char* id, const std::string& text, std::string& value, bool secret = false);
  /// The next item takes the focus.
  void focus_next();
  bool selectable(const char* id, Mark mark, const std::string& text, bool selected, const std::string& right = "");
  /// Table: `shares` of the width, 0..1. @return index of a clicked row, -1 none.
  struct Cell {
    std::string text;
    Ink ink = Ink::kText;
    Mark mark = Mark::kNone;
    bool right = false;
  };
  int table(const char* id, const std::vector<std::string>& heads, const std::vector<double>& shares,
            const std::vector<std::vector<Cell>>& rows, double height_at_720 = 0);
  /// Square of the given height to draw into by plot.h; returns its place and takes the room.
  Area drawing(const char* id, double height_at_720);
  /// Help on the last item, when hovered or focused.
  void explain(const std::string& text);

  /// The pointer in the last drawing(): px of the window. `clicked` in this frame, `held` while dragged out of it too.
  struct Pointer {
    bool over = false, clicked = false, held = false;
    double x = 0, y = 0;
  };
  Pointer pointer() const;
  /// Steps asked of the last drawing() while it has the focus: left and right, comma and full stop one, page keys ten.
  /// 0: none.
  int key_steps() const;
  /// A text at a place of its own, no wider than `room` (0: as wide as it is): in plots, on bars.
  /// @param anchor 0 from, 0.5 round, 1 up to x.
  void text_at(double x, double y, const std::string& text, Ink ink = Ink::kText, double room = 0, double anchor = 0,
               bool heading = false);
  double text_width(const std::string& text, bool heading = false) const;
  double text_height(const std::string& text, double room, bool heading = false) const;  ///< px, wrapped
  /// Lines of body text no wider than `room` px: for text_at().
  std::vector<std::string> lines(const std::string& text, double room) const;
  double line_height() const;
  /// Shapes, px of the window; colours of the theme's shapes; within the panel that is open, or on the ground.
  void paint_box(const Area& area, Ink shape, double opacity = 1, double corner = 0);
  void paint_frame(const Area& area, Ink shape, double thickness = 1, double corner = 0);
  void paint_ground(const Area& area, double opacity = 1, double corner = 0);  ///< the panel's own colour
  void paint_hatch(const Area& area, Ink shape, double pitch = 7, double thickness = 1.5);
  void paint_line(double x0, double y0, double x1, double y1, Ink shape, double thickness = 1.5, bool dashed = false);
  void paint_disc(double x, double y, double radius, Ink shape, double opacity = 1);
  void paint_ring(double x, double y, double radius, Ink shape, double thickness = 2);
  void paint_triangle(double x0, double y0, double x1, double y1, double x2, double y2, Ink shape);
  struct Point {
    double x = 0, y = 0;
  };
  void paint_curve(const std::vector<Point>& points, Ink shape, double thickness = 2);
  /// The same with a dark edge: seen on any picture.
  void paint_outlined(const std::vector<Point>& points, Ink shape, double thickness = 2);
  /// A mark in a square of the given side.
  void paint_mark(Mark mark, double x, double y, double side);

  /// Was the key pressed, and is nobody typing? @param key as key_name() says it.
  bool pressed(const std::string& key) const;
  /// Arrows and Tab are the screen's in the next frame (steering), not the focus'.
  void keys_to_screen();
  double room_below() const;             ///< px to the panel's lower edge
  void to_bottom(double height_at_720);  ///< what follows stands at the panel's foot, when there is room

  const std::vector<DrawnText>& text_audit() const { return drawn_; }
  /// Panels whose content is taller than they are.
  const std::vector<std::string>& scrolling() const { return scrolling_; }

 private:
  friend class UiParts;
  void begin(const char* id, const Area& area, double opacity, int flags);
  const Translator& words_;
  double scale_, width_, height_;
  std::vector<DrawnText> drawn_;
  std::vector<std::string> scrolling_;
  std::string panel_;
  bool in_front_ = false;
};

}  // namespace trocar
