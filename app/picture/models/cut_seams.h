// A surface with cuts as the picture shows it: the walls are a sheet of their own, so that the lip stays sharp, and
// every place near a cut knows how far it is from the lip.
//
// Distances at rest, in mm. Frame and unit of the surface otherwise (T, m). Thread: pure functions, any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "tissue/surface_snapshot.h"

namespace trocar {

/// What opens a surface along the lips of its cuts.
struct CutSeams {
  TriangleSurface surface;  ///< its vertices, behind them those that the walls have for themselves; same triangles
  std::vector<std::int32_t> twin_of;  ///< of each of the latter: the vertex of the surface in whose place it is
  std::vector<bool> straight;         ///< of each vertex: of a wall or a lip; an edge between two such is not curved

  /// What stands at every vertex of the surface, at those of the opened one.
  template <typename Value>
  std::vector<Value> at_twins_too(std::vector<Value> values) const {
    values.reserve(values.size() + twin_of.size());
    for (const std::int32_t vertex : twin_of) values.push_back(values.at(static_cast<std::size_t>(vertex)));
    return values;
  }
};

/// @param rest with `inside`; where that is empty nothing is opened.
CutSeams open_seams(const SurfaceSnapshot& rest);

inline constexpr float kLipOfWall = 2, kLipOutside = 1;  ///< values of cut_places() at the lip
inline constexpr float kFarFromCut = -50;

/// Of each vertex of an opened surface, or of what refines one: in a wall kLipOfWall + the distance from the lip;
/// outside kLipOutside - that distance, as long as it is a few mm, else kFarFromCut. @param inside of its triangles.
std::vector<float> cut_places(const TriangleSurface& opened, const std::vector<bool>& inside);

}  // namespace trocar
