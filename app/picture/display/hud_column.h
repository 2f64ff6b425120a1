// Inner parts of hud_layout.h: the frame's measures, the pen that places text, and the right column.
//
// Thread: any; the font cache is not shared.
#pragma once

#include "app/picture/display/hud_layout.h"

namespace trocar {

/// Measures of one frame, px.
struct HudFrame {
  HudFrame(const Hud& hud, int w, int h, double text_scale);
  /// Length given for 720 lines, at this size of window and text.
  int px(double at_720) const;
  int title_size() const;
  int clock_size() const;

  int width, height, body = 18, plain = 18;  ///< size of ordinary text, and what it is at 100 %
  double scale = 1, top = 0, bottom = 0, column_width = 0;
  bool empty = false;
  PixelRect scene;
};

/// Places texts and shapes into a layout, measuring with the font that draws them.
class HudPen {
 public:
  HudPen(HudLayout& layout, FontSet& fonts) : layout_(layout), fonts_(fonts) {}
  /// Left-aligned, drawn smaller and then shortened to fit into `room`. Returns the right end.
  double text(const std::string& words, double x, double baseline, int size, bool bold, HudInk ink, double room);
  /// Right-aligned, drawn smaller to fit into `room`, never shortened. Returns the left end.
  double text_right(const std::string& words, double right, double baseline, int size, bool bold, HudInk ink,
                    double room);
  /// At most `limit` lines no wider than `room`, whole where that is so at three quarters of `size`.
  struct Lines {
    std::vector<std::string> lines;
    int size = 0;
  };
  Lines wrapped(const std::string& words, int size, bool bold, double room, int limit);
  void shape(HudShape::Kind kind, const HudBox& box) { layout_.shapes.push_back({kind, box}); }
  void bar(const HudBar& bar) { layout_.bars.push_back(bar); }
  void dial(const HudDial& dial) { layout_.dials.push_back(dial); }
  void column(const HudBox& box) { layout_.column = box; }
  double width(const std::string& words, int size, bool bold) { return fonts_.width(words, size, bold); }

 private:
  int fitting_size(const std::string& words, int size, bool bold, double room);

  HudLayout& layout_;
  FontSet& fonts_;
};

void lay_column(HudPen& pen, const Hud& hud, const HudFrame& frame);

}  // namespace trocar
