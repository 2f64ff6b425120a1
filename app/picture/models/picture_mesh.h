// The surface as the picture shows it: smoothed by curved subdivision, with occlusion baked per vertex.
//
// Subdivision: Phong tessellation (Boubekeur and Alexa 2008), new points pulled half way onto the planes of the
// vertex normals; the collision surface is untouched. Occlusion: share of solid met in spheres that touch the surface
// from outside, on a voxel grid filled by parity. Frame and unit of the input surface (T, m). Thread: any.
#pragma once

#include <cstdint>
#include <vector>

#include "app/picture/models/solid_grid.h"
#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

struct PictureVertex {
  float position[3];
  float normal[3];
  float light[2];  ///< [0] openness to light, 0..1; [1] free per mesh (instrument: 1 steel, 0 insulation)
};

struct PictureMesh {
  std::vector<PictureVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< three a triangle, counter-clockwise seen from outside
};

/// One curved subdivision (each triangle becomes four). Closed stays closed; area-weighted normals decide the bulge.
TriangleSurface subdivide_curved(const TriangleSurface& surface);

/// Openness per vertex in [0, 1]: 1 in the open, towards 0 in crevices.
std::vector<float> bake_openness(const TriangleSurface& surface);

/// Light that fine folds let through per vertex, 1 on flat and bulging places: from the curvature along the edges,
/// smoothed once.
std::vector<float> bake_creases(const TriangleSurface& surface);

/// Subdivides while the result stays within `max_triangles`, then bakes normals and openness.
PictureMesh build_picture_mesh(const TriangleSurface& surface, std::size_t max_triangles = 36000);

/// Takes light from where another solid stands close before the surface.
void darken_beside(PictureMesh& mesh, const SolidGrid& other);

/// Indices (three a triangle) of the triangles that come within `radius` of `centre`, both m.
std::vector<std::uint32_t> triangles_near(const PictureMesh& mesh, const Vec3& centre, double radius);

}  // namespace trocar
