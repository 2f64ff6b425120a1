#include "app/picture/scene/marks_montage.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "app/picture/gl/canvas.h"
#include "app/picture/models/show_scene.h"

namespace trocar {
namespace {

constexpr int kColumns = 4, kRows = 3, kGap = 4;
constexpr Colour kInk{86, 180, 233, 1}, kGround{13, 15, 18, 0.82}, kWords{240, 240, 240, 1};

/// Mean of k x k pixels: small tiles come from pictures of the least size that the renderer draws, or larger.
Image reduced(const Image& from, int k) {
  Image out(from.width / k, from.height / k);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int i = 0; i < k * k; ++i) sum += from.pixel(k * x + i % k, k * y + i / k)[c];
        out.pixel(x, y)[c] = static_cast<std::uint8_t>((sum + k * k / 2) / (k * k));
      }
  return out;
}

/// Part of a picture, cut at its borders.
struct Cut {
  int left, top;
};

Cut cut_of(const MarkPointer& mark, int whole_w, int whole_h, int w, int h) {
  return {std::clamp(static_cast<int>(std::lround(mark.x * whole_w)) - w / 2, 0, whole_w - w),
          std::clamp(static_cast<int>(std::lround(mark.y * whole_h)) - h / 2, 0, whole_h - h)};
}

void copy(const Image& from, const Cut& cut, Image& to, int left, int top, int w, int h) {
  for (int y = 0; y < h; ++y)
    std::memcpy(to.pixel(left, top + y),
                &from.rgb[3 * (static_cast<std::size_t>(cut.top + y) * static_cast<std::size_t>(from.width) +
                               static_cast<std::size_t>(cut.left))],
                3 * static_cast<std::size_t>(w));
}

void label(Canvas& canvas, FontSet& fonts, const MarkPointer& mark, int number, int left, int top, int w, int h) {
  const int size = std::clamp(h / 13, 11, 26);
  const double strip = 1.7 * size;
  canvas.box({static_cast<double>(left), top + h - strip, static_cast<double>(w), strip}, kGround);
  const std::string words = fonts.fitted(std::to_string(number) + "  " + mark.label, size, false, w - 0.8 * size);
  canvas.text(words, left + 0.5 * size, top + h - 0.55 * size, size, false, kWords, fonts);
}

}  // namespace

const std::array<MarkPointer, 12>& twelve_marks() {
  static const std::array<MarkPointer, 12> kMarks = {
      {{"Round field with its notch", "abdomen", 1.0, 0.5, 0.0, 0.07},
       {"Light falls off to the rim", "abdomen", 1.0, 0.11, 0.60, 0.14},
       {"Wet glints that move", "abdomen", 2.4, 0.700, 0.31, 0.22},
       {"Crevices tinted red, not grey", "abdomen", 2.6, 0.45, 0.80, 0.20},
       {"Vessels in two scales", "abdomen", 3.0, 0.68, 0.41, 0.26},
       {"Shadow of the instrument", "whitening", 2.2, 0.85, 0.56, 0.20},
       {"Barrel distortion", "board", 1.3, 0.50, 0.60, 0.0},
       {"Haze with depth", "abdomen", 2.2, 0.47, 0.30, 0.18},
       {"Whitening under pressure", "whitening", 2.8, 0.655, 0.435, 0.22},
       {"Blood: dark, smooth, glossy", "blood", 2.4, 0.56, 0.74, 0.34},
       {"Char with its singed rim", "char", 3.0, 0.63, 0.546, 0.20},
       {"Smoke, thicker with distance", "smoke", 1.3, 0.50, 0.45, 0.0}}};
  return kMarks;
}

Image marks_montage(Renderer& renderer, int width, int height, std::uint64_t seed) {
  if (width < 640 || height < 360) throw std::invalid_argument("the montage needs at least 640 x 360 pixels");
  const int w = (width - (kColumns - 1) * kGap) / kColumns, h = (height - (kRows - 1) * kGap) / kRows;
  Image out(width, height);
  Canvas canvas(out);
  FontSet fonts;
  const SceneView abdomen = show_scene("abdomen", seed);
  int i = 0;
  for (const MarkPointer& mark : twelve_marks()) {
    const bool board = std::string(mark.scene) == "board";
    const SceneView view = board ? show_scene("board", seed) : with_fields(abdomen, mark.scene, seed);
    const int whole_w = static_cast<int>(std::lround(mark.zoom * w)),
              whole_h = static_cast<int>(std::lround(mark.zoom * h));
    const int k = whole_w < 320 || whole_h < 240 ? 3 : 1;
    const Image whole = reduced(renderer.render(view, k * whole_w, k * whole_h), k);
    const Cut cut = cut_of(mark, whole_w, whole_h, w, h);
    const int left = (i % kColumns) * (w + kGap), top = (i / kColumns) * (h + kGap);
    copy(whole, cut, out, left, top, w, h);
    if (mark.radius > 0) {
      const double x = left + mark.x * whole_w - cut.left, y = top + mark.y * whole_h - cut.top;
      canvas.ring(x, std::max(y, top + 2.0), mark.radius * h, 2, kInk);
    }
    label(canvas, fonts, mark, ++i, left, top, w, h);
  }
  return out;
}

}  // namespace trocar
