// A complex of triangles that can be edited: who touches what, of what kind each vertex is, and the three edits.
//
// Indices stay valid while editing; dead vertices and triangles are dropped by `compact`. Thread: any.
#pragma once

#include <vector>

#include "tissue/mesh/complex/label_complex.h"

namespace trocar {

class ComplexMesh {
 public:
  using Index = std::int32_t;
  enum class Kind { patch, curve, corner };

  explicit ComplexMesh(LabelComplex complex);

  struct Edge {
    Index a, b;
  };
  /// Every edge once, by its ends.
  std::vector<Edge> edges() const;

  const std::vector<Index>& fan(Index vertex) const { return fans_[at(vertex)]; }  ///< triangles round it
  std::vector<Index> around(Index a, Index b) const;                               ///< triangles of an edge
  std::vector<Index> neighbours(Index vertex) const;                               ///< sorted
  bool alive(Index vertex) const { return !fans_[at(vertex)].empty(); }
  const std::array<Index, 3>& triangle(Index t) const { return complex_.triangles[at(t)]; }
  const std::array<std::int16_t, 2>& regions(Index t) const { return complex_.regions[at(t)]; }
  Vec3& place(Index vertex) { return complex_.vertices[at(vertex)]; }
  const Vec3& place(Index vertex) const { return complex_.vertices[at(vertex)]; }
  std::size_t vertices() const { return complex_.vertices.size(); }

  /// Whether the edge is a curve: not exactly two triangles of one pair of regions.
  bool on_curve(Index a, Index b) const;
  Kind kind(Index vertex) const;
  std::vector<Index> curve_neighbours(Index vertex) const;
  Index third(Index t, Index a, Index b) const;

  /// A vertex in the middle of the edge. @return it
  Index split(Index a, Index b);
  /// Whether taking b into a keeps every organ's border a manifold.
  bool may_collapse(Index a, Index b) const;
  /// b's triangles go over to a; those of the edge vanish.
  void collapse(Index a, Index b);
  /// The edge of two triangles of one pair becomes the other diagonal. @return whether it could
  bool flip(Index a, Index b);

  LabelComplex compact() const;

 private:
  static std::size_t at(Index index) { return static_cast<std::size_t>(index); }
  void detach(Index t, Index vertex);

  LabelComplex complex_;
  std::vector<bool> dead_;
  std::vector<std::vector<Index>> fans_;
};

}  // namespace trocar
