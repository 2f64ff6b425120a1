// A surface as the picture shows it: triangles for the GPU with normals and occlusion baked per vertex.
//
// Occlusion: share of solid met in spheres that touch the surface from outside, on a voxel grid filled by parity, times
// what folds hold back. Frame and unit of the input surface (T, m). Thread: any.
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

/// Openness per vertex in [0, 1]: 1 in the open, towards 0 in crevices. @param normals of the vertices. @param grid of
/// the surface.
std::vector<float> bake_openness(const TriangleSurface& surface, const std::vector<Vec3>& normals,
                                 const SolidGrid& grid);

/// Light that fine folds let through per vertex, 1 on flat and bulging places: from the curvature along the edges,
/// smoothed once. @param normals of the vertices.
std::vector<float> bake_creases(const TriangleSurface& surface, const std::vector<Vec3>& normals);

/// The surface with normals, openness and creases: its vertices, or all. @param grid of the surface.
std::vector<PictureVertex> bake_vertices(const TriangleSurface& surface, const SolidGrid& grid);
PictureMesh bake_picture_mesh(const TriangleSurface& surface, const SolidGrid& grid);

/// Takes light from where another solid stands close before the surface.
void darken_beside(std::vector<PictureVertex>& vertices, const SolidGrid& other);

/// Indices (three a triangle) of the triangles that come within `radius` of `centre`, both m.
std::vector<std::uint32_t> triangles_near(const PictureMesh& mesh, const Vec3& centre, double radius);

}  // namespace trocar
