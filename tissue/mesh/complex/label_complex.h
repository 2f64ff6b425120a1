// The faces between several labels as one complex of triangles: every face knows the two labels that it parts.
//
// Multi-label marching tetrahedra. Each sample belongs to the label whose field is largest. In a tetrahedron of Kuhn's
// subdivision the regions of its corners meet in edge points (two labels), face points (three) and an inner point
// (four): the dual cells of the corners, so the border of each label is a closed manifold, and where three labels meet,
// a curve is common to all. RAS, metres once mapped. Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tissue/imaging/labels/smooth_field.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// Regions are numbered 0 (everything else), 1, 2, ...
struct LabelComplex {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::int32_t, 3>>
      triangles;  ///< the normal points from the first region of the pair to the second
  std::vector<std::array<std::int16_t, 2>> regions;  ///< of each triangle, first < second

  /// The border of one region, outward; `source` gives the triangle of the complex that each one is.
  TriangleSurface border(int region, std::vector<std::int32_t>* source = nullptr) const;
};

/// A place as a file of float32 keeps it: what is proved of it is proved of the file.
inline Vec3 as_float(const Vec3& place) { return place.cast<float>().cast<double>(); }

/// One region's field on its own box of a common grid.
struct RegionField {
  std::array<int, 3> first{};  ///< index in the common grid of the field's first sample
  ScalarField field;           ///< 0 beyond its box
  float offset = 0;            ///< added when the regions are compared: larger makes the region larger
};

/// Compares the fields; the rest has 1 minus their sum. Pieces of fewer than `least_samples` go to the region round
/// them; of several contacts of two regions those of a few samples are parted, except the largest.
/// @param size of the common grid; its outermost samples become the rest
/// @param spacing_m of its samples
LabelComplex label_complex(const std::vector<RegionField>& fields, const std::array<int, 3>& size,
                           const Vec3& spacing_m, std::size_t least_samples);

}  // namespace trocar
