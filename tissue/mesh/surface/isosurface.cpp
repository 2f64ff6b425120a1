#include "tissue/mesh/surface/isosurface.h"

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace trocar {
namespace {

// A vertex keeps this share of the edge away from its ends: no triangle degenerates when a sample equals the level.
constexpr double kEdgeMargin = 0.02;

/// Even permutations that bring the inside corners to the front, by the bit pattern of inside corners.
constexpr std::array<std::array<int, 4>, 16> kFront{{{0, 1, 2, 3},
                                                     {0, 1, 2, 3},
                                                     {1, 0, 3, 2},
                                                     {0, 1, 2, 3},
                                                     {2, 3, 0, 1},
                                                     {0, 2, 3, 1},
                                                     {1, 2, 0, 3},
                                                     {3, 2, 1, 0},
                                                     {3, 2, 1, 0},
                                                     {0, 3, 1, 2},
                                                     {1, 3, 2, 0},
                                                     {2, 3, 0, 1},
                                                     {2, 3, 0, 1},
                                                     {1, 0, 3, 2},
                                                     {0, 1, 2, 3},
                                                     {0, 1, 2, 3}}};

class Marcher {
 public:
  Marcher(const ScalarField& field, const Vec3& spacing, double level)
      : field_(field), spacing_(spacing), level_(level) {
    const auto slice = static_cast<std::size_t>(field.size[0]) * static_cast<std::size_t>(field.size[1]);
    for (auto& edges : edges_) edges.assign(slice * 7, -1);
    const std::ptrdiff_t row = field.size[0], layer = row * field.size[1];
    for (int corner = 0; corner < 8; ++corner)
      step_[static_cast<std::size_t>(corner)] = (corner & 1) + (corner >> 1 & 1) * row + (corner >> 2) * layer;
  }

  TriangleSurface march() {
    for (int k = 0; k + 1 < field_.size[2]; ++k) {
      for (int j = 0; j + 1 < field_.size[1]; ++j) row(j, k);
      std::swap(edges_[0], edges_[1]);
      std::fill(edges_[1].begin(), edges_[1].end(), -1);
    }
    return std::move(surface_);
  }

 private:
  /// Bits of the inside corners among those with this i: corners 0, 2, 4, 6 of a cube.
  int column(std::size_t base) const {
    int inside = 0;
    for (std::size_t corner = 0; corner < 8; corner += 2)
      inside |= field_.values[base + static_cast<std::size_t>(step_[corner])] > level_ ? 1 << corner : 0;
    return inside;
  }

  void row(int j, int k) {
    const std::size_t base = field_.offset(0, j, k);
    int next = column(base);
    for (int i = 0; i + 1 < field_.size[0]; ++i) {
      const int here = next;
      next = column(base + static_cast<std::size_t>(i) + 1);
      const int inside = here | next << 1;
      if (inside == 0 || inside == 255) continue;
      place_ = {i, j, k};
      cube(base + static_cast<std::size_t>(i), inside);
    }
  }

  void cube(std::size_t base, int inside) {
    for (std::size_t corner = 0; corner < 8; ++corner)
      value_[corner] = field_.values[base + static_cast<std::size_t>(step_[corner])];
    for (const auto& corners : kKuhnTetrahedra) tetrahedron(corners, inside);
  }

  void tetrahedron(const std::array<int, 4>& corners, int inside) {
    int pattern = 0;
    for (std::size_t n = 0; n < 4; ++n) pattern |= (inside >> corners[n] & 1) << n;
    if (pattern == 0 || pattern == 15) return;
    const auto& order = kFront[static_cast<std::size_t>(pattern)];
    std::array<int, 4> c{};
    for (std::size_t n = 0; n < 4; ++n) c[n] = corners[static_cast<std::size_t>(order[n])];
    const int count = (pattern & 1) + (pattern >> 1 & 1) + (pattern >> 2 & 1) + (pattern >> 3);
    if (count == 1) {
      add(edge(c[0], c[1]), edge(c[0], c[2]), edge(c[0], c[3]));
    } else if (count == 3) {  // the first corner is the one outside
      add(edge(c[0], c[1]), edge(c[0], c[3]), edge(c[0], c[2]));
    } else {
      const auto ac = edge(c[0], c[2]), ad = edge(c[0], c[3]), bd = edge(c[1], c[3]), bc = edge(c[1], c[2]);
      add(ac, ad, bd);
      add(ac, bd, bc);
    }
  }

  void add(std::int32_t a, std::int32_t b, std::int32_t c) { surface_.triangles.push_back({a, b, c}); }

  /// Vertex on the edge between two corners of the current cube; one is a subset of the other's bits.
  std::int32_t edge(int a, int b) {
    const int low = a & b, direction = (a | b) ^ low;
    auto& slab = edges_[static_cast<std::size_t>(low >> 2)];
    const auto column = static_cast<std::size_t>(place_[0] + (low & 1)) +
                        static_cast<std::size_t>(field_.size[0]) * static_cast<std::size_t>(place_[1] + (low >> 1 & 1));
    std::int32_t& vertex = slab[column * 7 + static_cast<std::size_t>(direction - 1)];
    if (vertex < 0) {
      vertex = static_cast<std::int32_t>(surface_.vertices.size());
      surface_.vertices.push_back(crossing(low, low | direction));
    }
    return vertex;
  }

  Vec3 crossing(int low, int high) const {
    const double from = value_[static_cast<std::size_t>(low)], to = value_[static_cast<std::size_t>(high)];
    const double share = std::clamp((level_ - from) / (to - from), kEdgeMargin, 1 - kEdgeMargin);
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
      const int start = low >> axis & 1, end = high >> axis & 1;
      point[axis] = spacing_[axis] * (place_[static_cast<std::size_t>(axis)] + start + share * (end - start));
    }
    return point;
  }

  const ScalarField& field_;
  Vec3 spacing_;
  double level_;
  std::array<std::vector<std::int32_t>, 2> edges_;  ///< vertex of each edge that starts in this slice and in the next
  std::array<std::ptrdiff_t, 8> step_{};
  std::array<double, 8> value_{};
  std::array<int, 3> place_{};
  TriangleSurface surface_;
};

/// Share of a tetrahedron in which a linear function with these corner values is positive.
double positive_share(std::array<double, 4> v) {
  std::sort(v.begin(), v.end(), std::greater<>());
  const auto cut = [](double in, double out) { return in / (in - out); };
  if (v[0] <= 0) return 0;
  if (v[3] > 0) return 1;
  if (v[1] <= 0) return cut(v[0], v[1]) * cut(v[0], v[2]) * cut(v[0], v[3]);
  if (v[2] > 0) return 1 - cut(v[3], v[0]) * cut(v[3], v[1]) * cut(v[3], v[2]);
  const double s = cut(v[0], v[2]), t = cut(v[0], v[3]), u = cut(v[1], v[2]), w = cut(v[1], v[3]);
  return s * t + w * s * (1 - t) + (1 - s) * u * w;
}

double cube_share(const std::array<double, 8>& corners) {
  double sum = 0;
  for (const auto& t : kKuhnTetrahedra)
    sum += positive_share({corners[static_cast<std::size_t>(t[0])], corners[static_cast<std::size_t>(t[1])],
                           corners[static_cast<std::size_t>(t[2])], corners[static_cast<std::size_t>(t[3])]});
  return sum / 6;
}

void check_border(const ScalarField& field, double level) {
  for (int k = 0; k < field.size[2]; ++k)
    for (int j = 0; j < field.size[1]; ++j) {
      const bool inner = j > 0 && k > 0 && j + 1 < field.size[1] && k + 1 < field.size[2];
      for (int i = 0; i < field.size[0]; i += inner && i == 0 ? std::max(1, field.size[0] - 1) : 1)
        if (field.values[field.offset(i, j, k)] > level)
          throw std::invalid_argument("isosurface: the field is above the level on the border of its grid");
    }
}

}  // namespace

TriangleSurface isosurface(const ScalarField& field, const Vec3& spacing_m, double level) {
  check_border(field, level);
  return Marcher(field, spacing_m, level).march();
}

double enclosed_volume_m3(const ScalarField& field, const Vec3& spacing_m, double level) {
  const std::size_t row = static_cast<std::size_t>(field.size[0]),
                    slice = row * static_cast<std::size_t>(field.size[1]);
  const std::array<std::size_t, 8> step{0, 1, row, row + 1, slice, slice + 1, slice + row, slice + row + 1};
  const auto limit = static_cast<float>(level);
  const auto column = [&](const float* values) {
    return (values[0] > limit ? 1 : 0) + (values[row] > limit ? 1 : 0) + (values[slice] > limit ? 1 : 0) +
           (values[slice + row] > limit ? 1 : 0);
  };
  double cubes = 0;
  for (int k = 0; k + 1 < field.size[2]; ++k)
    for (int j = 0; j + 1 < field.size[1]; ++j) {
      const float* values = field.values.data() + field.offset(0, j, k);
      int next = column(values);
      for (int i = 0; i + 1 < field.size[0]; ++i, ++values) {
        const int inside = next + column(values + 1);
        next = inside - next;
        if (inside == 8) cubes += 1;
        if (inside == 0 || inside == 8) continue;
        std::array<double, 8> corners{};
        for (std::size_t n = 0; n < 8; ++n) corners[n] = values[step[n]] - level;
        cubes += cube_share(corners);
      }
    }
  return cubes * spacing_m.prod();
}

}  // namespace trocar
