#include "app/picture/display/hud_painter.h"

#include "app/picture/display/hud_drawing.h"

namespace trocar {
namespace {

struct CanvasPen : Canvas {
  FontSet& fonts;
  CanvasPen(Image& image, FontSet& given) : Canvas(image), fonts(given) {}
  void text(const HudText& t, const Colour& colour) {
    Canvas::text(t.text, t.box.x, t.baseline, t.size, t.bold, colour, fonts);
  }
};

}  // namespace

void paint_hud(Image& image, const HudLayout& layout, FontSet& fonts) {
  CanvasPen pen(image, fonts);
  draw_hud_with(pen, layout);
}

}  // namespace trocar
