// What heat has done to the look of a surface: shares of white and of char at its vertices.
//
// Vertices stand further apart than a track of char is wide. A vertex therefore shows the most of what happened to the
// surface's cubes round it, fading linearly over the mean length of its edges (at most 6 mm): a track between two
// vertices is seen, as wide as the triangles are. What is to be measured is asked of the cubes (TissueHeat::look_at).
// Renewed only near blocks that look different than before. Frame T at rest, m. Thread: tissue task.
#pragma once

#include <cstdint>
#include <vector>

#include "tissue/interaction/heat_grid.h"

namespace trocar {

/// Shares 0 .. 1 of what is seen.
struct HeatLook {
  float white = 0, charred = 0;
};

class HeatLooks {
 public:
  /// Nothing has happened.
  void reset(const TriangleSurface& surface);
  /// The surface has more vertices, after the old ones, which keep what they show.
  void grow(const TriangleSurface& surface);
  /// Writes down which vertices look at a block. @return whether any of those from first_vertex on does
  bool watch(HeatBlock& block, const HeatGrid& grid, std::size_t first_vertex) const;
  /// Vertices that look at blocks which look different.
  void renew(const HeatGrid& grid);

  const std::vector<float>& white() const { return white_; }  ///< by vertex
  const std::vector<float>& charred() const { return charred_; }
  std::uint64_t number() const { return number_; }  ///< changes whenever they may have

 private:
  void set_reach(const TriangleSurface& surface);
  HeatLook look_of(std::size_t vertex, const HeatGrid& grid) const;

  std::vector<float> white_, charred_, reach_;  ///< by vertex; reach in m
  std::vector<std::uint64_t> looked_;           ///< by vertex: number in which it was renewed
  std::uint64_t number_ = 0;
};

}  // namespace trocar
