// The nearest point of a fixed set of triangles, through CGAL's AABB tree.
//
// Metres. Built once; queries do not change it. Thread: any.
#pragma once

#include <memory>

#include "tissue/mesh/triangle_surface.h"

namespace trocar {

class NearestSurface {
 public:
  /// @param surface any triangles, at least one; copied
  explicit NearestSurface(const TriangleSurface& surface);
  ~NearestSurface();
  NearestSurface(NearestSurface&&) noexcept;
  NearestSurface& operator=(NearestSurface&&) noexcept;

  struct Hit {
    Vec3 place;
    Vec3 normal;           ///< of the triangle, twice its area long
    std::size_t triangle;
  };
  Hit nearest(const Vec3& point) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace trocar
