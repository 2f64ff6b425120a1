// Keeps a complex of triangles free of crossings while it is edited: asked before every edit, told after it.
//
// What cuts nothing at first, and of which no edit is made that would cut, cuts nothing at the end. Triangles lie in a
// grid of cells, and only those of the same cells are compared (exact predicates). Any length unit. Thread: any.
#pragma once

#include <cstdint>
#include <vector>

#include "tissue/mesh/complex/label_complex.h"
#include "tissue/mesh/surface/triangle_crossing.h"

namespace trocar {

class CrossingGuard {
 public:
  using Index = std::int32_t;

  /// @param complex at least one triangle
  explicit CrossingGuard(const LabelComplex& complex);

  /// Whether triangles as they would become have area and cross neither each other nor any that is not `replaced`.
  bool clear(const std::vector<NumberedTriangle>& fresh, const std::vector<Index>& replaced);
  /// Triangle `t` as it is now; a new one, or instead of what it was.
  void set(Index t, const NumberedTriangle& triangle);
  void erase(Index t);

  /// Triangles that cross another one, ascending.
  std::vector<Index> crossing();

 private:
  using Range = std::array<std::array<int, 2>, 3>;  ///< first and last cell by axis
  Range cells_of(const NumberedTriangle& triangle) const;
  template <typename Visit>
  void for_cells(const Range& range, Visit visit) const;
  bool clear_of_others(const NumberedTriangle& triangle);

  Vec3 low_;
  double cell_ = 1;
  std::array<int, 3> size_{};
  std::vector<std::vector<Index>> cells_;
  std::vector<NumberedTriangle> triangles_;
  std::vector<Range> ranges_;  ///< of each triangle; of one that is not there empty
  std::vector<std::uint32_t> seen_;
  std::uint32_t visit_ = 0;
};

/// Cosine of the smallest angle of a triangle.
double sharpest_cosine(const std::array<Vec3, 3>& points);
inline constexpr double kThinCosine = 0.985;  ///< of 10 degrees

/// Moves the vertices to where they are wanted, or half-way, one by one and twice over, as far as nothing comes to
/// cross and no triangle becomes thin, or thinner. Places are rounded to float.
/// @return vertices that could not go the whole way
std::size_t move_without_crossing(LabelComplex& complex, const std::vector<Vec3>& wanted);

}  // namespace trocar
