#include "app/organs/slice_picture.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

/// Axis of the slice's normal, and what the picture's x and y (down) run along in RAS.
struct PlaneAxes {
  int normal;
  Vec3 right, down;
  const char *left_word, *right_word, *top_word, *bottom_word, *name;
};

PlaneAxes axes_of(SlicePlane plane) {
  switch (plane) {
    case SlicePlane::kAxial:
      return {2, -Vec3::UnitX(), -Vec3::UnitY(), "R", "L", "A", "P", "axial"};
    case SlicePlane::kCoronal:
      return {1, -Vec3::UnitX(), -Vec3::UnitZ(), "R", "L", "S", "I", "coronal"};
    case SlicePlane::kSagittal:
      break;
  }
  return {0, -Vec3::UnitY(), -Vec3::UnitZ(), "A", "P", "S", "I", "sagittal"};
}

/// Value of the nearest voxel; empty outside.
template <typename Volume, typename Values>
bool nearest(const Volume& volume, const Values& values, const Eigen::Affine3d& to_index, const Vec3& place_mm,
             double& value) {
  const Vec3 index = to_index * place_mm;
  std::array<int, 3> at{};
  for (int axis = 0; axis < 3; ++axis) {
    const double rounded = std::round(index[axis]);
    if (!(rounded >= 0 && rounded < volume.size[static_cast<std::size_t>(axis)])) return false;
    at[static_cast<std::size_t>(axis)] = static_cast<int>(rounded);
  }
  value = static_cast<double>(values[volume.offset(at[0], at[1], at[2])]);
  return true;
}

class Ground {
 public:
  explicit Ground(const SliceGround& ground) : ground_(ground) {
    if (ground.image) {
      to_index_.push_back(ground.image->index_to_ras_mm.inverse());
      window_ = display_window(*ground.image);
    } else if (ground.labels) {
      for (const LabelVolume& layer : ground.labels->layers) to_index_.push_back(layer.index_to_ras_mm.inverse());
    }
  }

  std::uint8_t grey(const Vec3& place_mm) const {
    double value = 0;
    if (ground_.image) {
      if (!nearest(*ground_.image, ground_.image->values, to_index_[0], place_mm, value)) return 0;
      return static_cast<std::uint8_t>(
          std::lround(255 * std::clamp((value - window_[0]) / (window_[1] - window_[0]), 0.0, 1.0)));
    }
    if (!ground_.labels) return 24;
    for (std::size_t n = 0; n < to_index_.size(); ++n) {
      const LabelVolume& layer = ground_.labels->layers[n];
      if (nearest(layer, layer.labels, to_index_[n], place_mm, value) && value > 0) return 110;
    }
    return 24;
  }

 private:
  SliceGround ground_;
  std::vector<Eigen::Affine3d> to_index_;
  std::array<double, 2> window_{0, 1};
};

/// Letters at the four sides, a bar of 50 mm and the plane's name.
void annotate(Image& image, const PlaneAxes& axes, const Vec3& centre_mm, double mm_per_px, FontSet& fonts) {
  constexpr int kSize = 15;
  constexpr double kInset = 6;
  Canvas canvas(image);
  const double w = image.width, h = image.height;
  const Colour ink{235, 235, 235, 1};
  const auto text = [&](const std::string& words, double x, double baseline) {
    canvas.text(words, x, baseline, kSize, true, ink, fonts);
  };
  text(axes.left_word, kInset, h / 2 + 5);
  text(axes.right_word, w - kInset - fonts.width(axes.right_word, kSize, true), h / 2 + 5);
  text(axes.top_word, w / 2 - 5, kInset + 12);
  text(axes.bottom_word, w / 2 - 5, h - kInset);
  const char* letter = axes.normal == 0 ? "x " : axes.normal == 1 ? "y " : "z ";
  text(std::string(axes.name) + ", " + letter + std::to_string(static_cast<int>(std::lround(centre_mm[axes.normal]))) +
           " mm",
       kInset, kInset + 12);
  const double bar = 50 / mm_per_px;
  canvas.line(w - kInset - bar, h - 12, w - kInset, h - 12, 3, ink);
  text("5 cm", w - kInset - fonts.width("5 cm", kSize, true), h - 18);
}

}  // namespace

std::array<double, 2> display_window(const ImageVolume& image) {
  if (image.modality == "CT") return {-160, 240};
  std::vector<float> sample;
  const std::size_t step = std::max<std::size_t>(1, image.values.size() / 200000);
  for (std::size_t n = 0; n < image.values.size(); n += step) sample.push_back(image.values[n]);
  if (sample.empty()) return {0, 1};
  const auto at = [&](double share) {
    const auto place = sample.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sample.size() - 1));
    std::nth_element(sample.begin(), place, sample.end());
    return static_cast<double>(*place);
  };
  const double low = at(0.01), high = at(0.99);
  return {low, std::max(high, low + 1e-6)};
}

std::vector<std::array<Vec3, 2>> cut_by_plane(const TriangleSurface& surface, int axis, double value_mm) {
  std::vector<std::array<Vec3, 2>> segments;
  for (const auto& triangle : surface.triangles) {
    std::array<Vec3, 2> ends;
    int count = 0;
    for (std::size_t n = 0; n < 3; ++n) {
      const Vec3 a = 1e3 * surface.vertices[static_cast<std::size_t>(triangle[n])];
      const Vec3 b = 1e3 * surface.vertices[static_cast<std::size_t>(triangle[(n + 1) % 3])];
      if ((a[axis] > value_mm) == (b[axis] > value_mm)) continue;
      ends[static_cast<std::size_t>(count++)] = a + (value_mm - a[axis]) / (b[axis] - a[axis]) * (b - a);
    }
    if (count == 2) segments.push_back(ends);
  }
  return segments;
}

Image slice_picture(const SliceGround& ground, const std::vector<SliceOutline>& outlines, SlicePlane plane,
                    const Vec3& centre_mm, double extent_mm, int size_px) {
  const PlaneAxes axes = axes_of(plane);
  const double mm_per_px = extent_mm / size_px;
  Image image(size_px, size_px);
  const Ground picture(ground);
  for (int y = 0; y < size_px; ++y)
    for (int x = 0; x < size_px; ++x) {
      const Vec3 place =
          centre_mm + mm_per_px * ((x + 0.5 - size_px / 2.0) * axes.right + (y + 0.5 - size_px / 2.0) * axes.down);
      std::fill_n(image.pixel(x, y), 3, picture.grey(place));
    }
  Canvas canvas(image);
  for (const SliceOutline& outline : outlines)
    for (const auto& [a, b] : cut_by_plane(*outline.surface, axes.normal, centre_mm[axes.normal])) {
      const auto x = [&](const Vec3& p) { return (p - centre_mm).dot(axes.right) / mm_per_px + size_px / 2.0; };
      const auto y = [&](const Vec3& p) { return (p - centre_mm).dot(axes.down) / mm_per_px + size_px / 2.0; };
      canvas.line(x(a), y(a), x(b), y(b), 1.6, outline.colour);
    }
  FontSet fonts;
  annotate(image, axes, centre_mm, mm_per_px, fonts);
  return image;
}

}  // namespace trocar
