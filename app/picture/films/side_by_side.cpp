#include "app/picture/films/side_by_side.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "app/picture/attempt/attempt_hud.h"
#include "app/picture/attempt/attempt_picture.h"
#include "app/picture/attempt/attempt_scene.h"
#include "app/picture/display/hud_painter.h"
#include "app/picture/gl/headless_context.h"
#include "app/picture/scene/renderer.h"

namespace trocar {
namespace {

constexpr int kBody = 18;             // px at 720 lines
constexpr std::size_t kMostBars = 2;  // bars that have room

std::string seconds_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s", value);
  return text;
}

std::string force_text(const ForceBar& bar) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f N", bar.value_n);
  return text;
}

void copy_into(Image& to, const Image& from, int x, int y) {
  for (int row = 0; row < from.height; ++row)
    std::copy_n(from.pixel(0, row), 3 * static_cast<std::size_t>(from.width), to.pixel(x, y + row));
}

/// Where the pieces of one half stand, px.
struct Half {
  int body, x, width, top, picture_height;
  double line() const { return 1.5 * body; }
};

/// @param bars that either side shows: an exercise without any leaves their room to the picture.
Half half_of(int index, int width, int height, int bars) {
  Half h;
  h.body = std::max(13, static_cast<int>(std::lround(kBody * std::min(height / 720.0, width / 1280.0))));
  const int gap = std::max(2, h.body / 4);
  h.width = (width - gap) / 2;
  h.x = index * (width - h.width);
  h.top = static_cast<int>(std::ceil(1.9 * h.body));
  h.picture_height =
      height - h.top - static_cast<int>(std::ceil(bars * 2.4 * h.body + (bars > 0 ? 2.6 : 2.2) * h.body));
  return h;
}

class HalfLayout {
 public:
  HalfLayout(const Half& half, FontSet& fonts) : half_(half), fonts_(fonts) {}

  /// One line: left text shortened to what the right one leaves.
  void line(double y, const std::string& left, HudInk left_ink, const std::string& right, HudInk right_ink, bool bold) {
    const double margin = 0.6 * half_.body, taken = right.empty() ? 0 : fonts_.width(right, half_.body, bold) + margin;
    const double room = half_.width - 2 * margin - taken;
    put(half_.x + margin, y, fonts_.fitted(left, half_.body, bold, room), left_ink, bold);
    if (!right.empty()) put(half_.x + half_.width - taken, y, right, right_ink, bold);
  }

  void bar(double y, const ForceBar& bar) {
    const double margin = 0.6 * half_.body;
    HudBar out;
    out.track = {half_.x + margin, y, half_.width - 2 * margin, 0.7 * half_.body};
    const auto share = [&bar](double n) {
      return bar.full_scale_n > 0 ? std::clamp(n / bar.full_scale_n, 0.0, 1.0) : 0;
    };
    out.value = share(bar.value_n);
    out.peak = share(bar.peak_n);
    out.band_low = share(bar.band_low_n);
    out.band_high = share(bar.band_high_n);
    out.limit = bar.limit_n > 0 ? share(bar.limit_n) : 1;
    out.level = force_level(bar);
    layout.bars.push_back(out);
  }

  HudLayout layout;

 private:
  void put(double x, double y, const std::string& text, HudInk ink, bool bold) {
    HudText out;
    out.text = text;
    out.box = {x, y, fonts_.width(text, half_.body, bold), fonts_.line_height(half_.body)};
    out.baseline = y + fonts_.ascent(half_.body);
    out.size = half_.body;
    out.bold = bold;
    out.ink = ink;
    layout.texts.push_back(out);
  }

  const Half& half_;
  FontSet& fonts_;
};

HudInk ink_of(const ForceBar& bar) {
  switch (force_level(bar)) {
    case HudBar::Level::kBelow:
      return HudInk::kText;
    case HudBar::Level::kInBand:
      return HudInk::kGood;
    case HudBar::Level::kAbove:
      return HudInk::kCaution;
    case HudBar::Level::kOverLimit:
      return HudInk::kAlarm;
  }
  return HudInk::kText;
}

}  // namespace

struct SideBySidePainter::Impl {
  Impl(const AssetRoots& assets, int w, int h, const RenderOptions& options)
      : renderer{Renderer(context, assets.assets, options), Renderer(context, assets.assets, options)},
        width(w),
        height(h) {}

  SceneView view_of_side(const FilmSide& side) const {
    return attempt_view(view_of(side.scene, side.moment), side.name);
  }
  void paint(Image& image, int index, const FilmSide& side, SceneView view, int bars, double seconds);

  HeadlessContext context;
  Renderer renderer[2];  // each keeps its own organ on the GPU
  FontSet fonts;
  int width, height;
};

void SideBySidePainter::Impl::paint(Image& image, int index, const FilmSide& side, SceneView view, int bars,
                                    double seconds) {
  const Half half = half_of(index, width, height, bars);
  Hud hud;
  std::swap(hud, view.hud);
  copy_into(image, renderer[index].render(view, half.width, half.picture_height), half.x, half.top);
  HalfLayout out(half, fonts);
  out.line(0.4 * half.body, side.name, HudInk::kHeading, side.over ? "ended" : seconds_text(seconds), HudInk::kText,
           true);
  double y = half.top + half.picture_height + 0.4 * half.body;
  if (!hud.rows.empty()) out.line(y, hud.rows.front().name, HudInk::kDim, hud.rows.front().value, HudInk::kText, false);
  for (std::size_t i = 0; i < hud.bars.size() && i < kMostBars; ++i) {
    y += (i == 0 ? 1.5 : 2.4) * half.body;
    out.line(y, hud.bars[i].label, HudInk::kText, force_text(hud.bars[i]), ink_of(hud.bars[i]), false);
    out.bar(y + 1.4 * half.body, hud.bars[i]);
  }
  paint_hud(image, out.layout, fonts);
}

SideBySidePainter::SideBySidePainter(const AssetRoots& assets, int width, int height, Preset preset) {
  if (width < kLeastWidth || height < kLeastHeight)
    throw std::invalid_argument("two runs side by side need a larger picture");
  RenderOptions options;
  options.preset = preset;
  impl_ = std::make_unique<Impl>(assets, width, height, options);
}
SideBySidePainter::~SideBySidePainter() = default;

Image SideBySidePainter::paint(const FilmSide& left, const FilmSide& right, double seconds) {
  Image image(impl_->width, impl_->height);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = static_cast<std::uint8_t>(12 + 2 * (i % 3));
  SceneView views[2] = {impl_->view_of_side(left), impl_->view_of_side(right)};
  const int bars = static_cast<int>(std::min(kMostBars, std::max(views[0].hud.bars.size(), views[1].hud.bars.size())));
  impl_->paint(image, 0, left, std::move(views[0]), bars, seconds);
  impl_->paint(image, 1, right, std::move(views[1]), bars, seconds);
  return image;
}

}  // namespace trocar
