// A surface as it is at one moment, in T: what renderer, window, playback, desk and films read of an organ.
//
// Never changed once it is shared: tissue that moves shares a new one, an organ that stands still the same one for
// good, so that it costs nobody a copy and a reader that sees the same pointer has nothing to do. m. Thread: any.
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
};
using SurfacePtr = std::shared_ptr<const SurfaceSnapshot>;

/// A surface that stays as it is.
inline SurfacePtr still_surface(TriangleSurface surface) {
  auto snapshot = std::make_shared<SurfaceSnapshot>();
  static_cast<TriangleSurface&>(*snapshot) = std::move(surface);
  return snapshot;
}

}  // namespace trocar
