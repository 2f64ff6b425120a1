// A surface as it is at one moment, in T: what renderer, window, playback, desk and films read of an organ.
//
// Never changed once it is shared: tissue that moves shares a new one, an organ that stands still the same one for
// good, so that it costs nobody a copy and a reader that sees the same pointer has nothing to do. What moves tells its
// surface at rest, which stays the same pointer until the triangles change: readers keep by it what they made of the
// triangles, and what sticks to the tissue (texture, marks, targets) has its place there. m. Thread: any.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

/// A number at every vertex: a temperature, a strain.
struct SurfaceField {
  std::string name;
  std::vector<float> value;
};

struct SurfaceSnapshot : TriangleSurface {
  std::uint64_t topology = 0;  ///< as long as it is the same, so are the triangles, and vertex i is the same place
  std::vector<SurfaceField> fields = {};
  std::vector<bool> inside = {};                          ///< of each triangle: the wall of a cut; empty: none is
  std::vector<std::uint8_t> part = {};                    ///< of each triangle, of two organs: whose; empty: of one
  std::shared_ptr<const SurfaceSnapshot> rest = nullptr;  ///< undeformed, same triangles; none: this one is
};
using SurfacePtr = std::shared_ptr<const SurfaceSnapshot>;

/// The undeformed surface of one that may have moved.
inline const SurfacePtr& surface_at_rest(const SurfacePtr& surface) { return surface->rest ? surface->rest : surface; }

/// A surface that stays as it is.
inline SurfacePtr still_surface(TriangleSurface surface) {
  auto snapshot = std::make_shared<SurfaceSnapshot>();
  static_cast<TriangleSurface&>(*snapshot) = std::move(surface);
  return snapshot;
}

/// What tissue shares after a step. @param rest undeformed. @param vertices as many as there, where they are now, m.
inline SurfacePtr moved_surface(const SurfacePtr& rest, std::vector<Vec3> vertices,
                                std::vector<SurfaceField> fields = {}) {
  auto snapshot = std::make_shared<SurfaceSnapshot>();
  snapshot->vertices = std::move(vertices);
  snapshot->triangles = rest->triangles;
  snapshot->topology = rest->topology;
  snapshot->inside = rest->inside;
  snapshot->part = rest->part;
  snapshot->fields = std::move(fields);
  snapshot->rest = rest;
  return snapshot;
}

/// Two closed surfaces as parts of one, the second one's vertices and triangles behind the first's.
inline SurfacePtr both_surfaces(const TriangleSurface& first, const TriangleSurface& second) {
  auto snapshot = std::make_shared<SurfaceSnapshot>();
  static_cast<TriangleSurface&>(*snapshot) = first;
  const auto shift = static_cast<std::int32_t>(first.vertices.size());
  snapshot->vertices.insert(snapshot->vertices.end(), second.vertices.begin(), second.vertices.end());
  for (const auto& [a, b, c] : second.triangles) snapshot->triangles.push_back({a + shift, b + shift, c + shift});
  snapshot->part.resize(first.triangles.size(), 0);
  snapshot->part.resize(snapshot->triangles.size(), 1);
  return snapshot;
}

}  // namespace trocar
