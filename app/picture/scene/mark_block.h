// Marks of the tissue as the uniform block `Marks` of assets/shaders/tissue.frag, and the triangles that bear them.
//
// Layout std140, frame T at rest, m. Thread: any.
#pragma once

#include <cstdint>
#include <vector>

#include "app/picture/models/picture_mesh.h"
#include "tissue/tissue_frame.h"

namespace trocar {

struct MarkBlock {
  float place[kMaxTissueMarks][4];  ///< xyz centre, w radius
  float kind[kMaxTissueMarks][4];   ///< strength in the component of its kind: blood, char, whitening, wet
  float count[4];                   ///< x: how many
};

/// @param marks the first kMaxTissueMarks count; strength is cut to 0..1.
MarkBlock make_mark_block(const std::vector<TissueMark>& marks);

/// How far a mark shows, in its radii: its edge is uneven.
inline constexpr double kMarkReach = 1.7;

/// Indices (three a triangle) of the triangles that a mark may reach, each once.
std::vector<std::uint32_t> triangles_marked(const PictureMesh& mesh, const std::vector<TissueMark>& marks);

}  // namespace trocar
