#include "app/picture/maps/heat_painter.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "app/picture/gl/canvas.h"
#include "app/picture/maps/colour_scale.h"

namespace trocar {
namespace {

constexpr double kCover = 0.86, kGrey = 0.8;
constexpr double kFieldDeg = 72;

std::string number_words(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, value < 10 ? "%.1f" : "%.0f", value);
  return buffer;
}

/// Colours are left to the map.
void make_grey(Image& picture) {
  for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
    const double light = 0.2126 * picture.rgb[i] + 0.7152 * picture.rgb[i + 1] + 0.0722 * picture.rgb[i + 2];
    std::fill_n(picture.rgb.begin() + static_cast<std::ptrdiff_t>(i), 3,
                static_cast<std::uint8_t>(std::lround(kGrey * light)));
  }
}

/// In the lower left corner: bar, both ends, what it is.
void draw_scale(Image& picture, HeatOf of, double top) {
  Canvas canvas(picture);
  FontSet fonts;
  const double unit = picture.height / 450.0, wide = 190 * unit, high = 12 * unit, x = 14 * unit,
               y = picture.height - 34 * unit;
  const int size = std::max(11, static_cast<int>(std::lround(14 * unit)));
  const Colour white{255, 255, 255, 1};
  canvas.box({x - 8 * unit, y - 24 * unit, wide + 16 * unit, 52 * unit}, {0, 0, 0, 0.72}, 5 * unit);
  const int steps = static_cast<int>(wide);
  for (int i = 0; i < steps; ++i) {
    const auto c = viridis(static_cast<double>(i) / (steps - 1));
    canvas.box({x + i, y, 1, high}, {c[0], c[1], c[2], 1});
  }
  canvas.text(of == HeatOf::kTime ? "Time within 3 mm, s" : "Largest force, N", x, y - 7 * unit, size, true, white,
              fonts);
  const std::string end = number_words(top);
  canvas.text("0", x, y + high + 13 * unit, size, false, white, fonts);
  canvas.text(end, x + wide - fonts.width(end, size), y + high + 13 * unit, size, false, white, fonts);
}

}  // namespace

double HeatFields::at(const SeenPlaces& seen, int x, int y) const {
  switch (seen.what(x, y)) {
    case SeenPlaces::What::kOrgan:
      return space.at(seen.place_T(x, y));
    case SeenPlaces::What::kBoard:
      return flat.at(seen.place_T(x, y));
    case SeenPlaces::What::kOther:
    case SeenPlaces::What::kNothing:
      break;
  }
  return 0;
}

Camera overview_camera(const SceneView& view) {
  Eigen::AlignedBox3d box;
  if (view.organ) box = view.organ->bounds();
  for (const SceneObject& object : view.objects)
    if (object.shape == SceneObject::Shape::kBoard)
      for (const Vec3& corner : board_face(object).vertices) box.extend(corner);
  Camera camera;
  camera.diagonal_fov_deg = kFieldDeg;
  if (box.isEmpty()) return view.camera;
  // The frame cuts the round field above and below: 0.5 of the height against a radius of 0.64 of it.
  const double half_field = std::atan(0.5 / 0.64 * std::tan(0.5 * kFieldDeg * std::numbers::pi / 180));
  camera.look_at_T = box.center();
  camera.eye_T =
      camera.look_at_T + Vec3(-0.05, -0.55, 0.83).normalized() * (0.5 * box.sizes().norm() / std::sin(half_field));
  return camera;
}

SceneView bare_scene(SceneView view) {
  constexpr double kAway = 5;  // m above: out of every field
  view.hud = {};
  view.X_TI.p.z() += kAway;
  view.dimple_depth_m = 0;
  std::erase_if(view.objects, [](const SceneObject& object) {
    return is_ghost(object) || object.shape == SceneObject::Shape::kSleeve || object.look == SceneObject::Look::kFoam;
  });
  for (TargetMark& target : view.targets) target.state = TargetMark::State::kWaiting;
  return view;
}

double heat_top(const HeatFields& fields, const SceneView& view, const std::vector<Camera>& cameras) {
  constexpr int kWidth = 320, kHeight = 180;
  double top = 0;
  for (const Camera& camera : cameras) {
    SeenPlaces seen(camera, kWidth, kHeight);
    seen.add(view);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) top = std::max(top, fields.at(seen, x, y));
  }
  return top;
}

void paint_heat(Image& picture, const SceneView& view, const HeatFields& fields, double top) {
  make_grey(picture);
  SeenPlaces seen(view.camera, picture.width, picture.height);
  seen.add(view);
  for (int y = 0; top > 0 && y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const double share = fields.at(seen, x, y) / top;
      if (share < kLeastShown) continue;
      const auto colour = viridis(share);
      std::uint8_t* pixel = picture.pixel(x, y);
      for (std::size_t i = 0; i < 3; ++i)
        pixel[i] = static_cast<std::uint8_t>(std::lround((1 - kCover) * pixel[i] + kCover * colour[i]));
    }
  draw_scale(picture, fields.of, top);
}

}  // namespace trocar
