// The organ compiler: from a label in patient space, or a closed surface, to a clean closed mesh of the wanted size.
//
// Steps: mask with a margin -> Gaussian field -> iso level that encloses the kept voxels' volume
// -> marching tetrahedra -> isotropic remeshing, projected -> fit -> volume correction along the normals -> checks.
// Vertices are rounded to float32, as the organ file stores them, before they are measured. RAS, metres. Same input,
// same bytes. Thread: any, not the tick.
#pragma once

#include "tissue/imaging/labels/label_mask.h"
#include "tissue/imaging/labels/label_volume.h"
#include "tissue/mesh/surface/mesh_facts.h"
#include "tissue/mesh/surface/triangle_surface.h"
#include "tissue/organ/lost_form.h"
#include "tissue/progress.h"

namespace trocar {

/// How the mesh is drawn to the dense surface (surface_fit.h).
enum class MeshFit {
  kOntoBends,     ///< vertices slide onto bends, edges flip along them: nearer
  kAlongNormals,  ///< of what was shipped so: recordings and scores stand on its bytes
};

struct CompileOptions {
  int triangles = 6000;  ///< wanted number, met within a few per cent; 200..200000
  PartsRule parts = {};  ///< which parts of the label become the organ
  Progress progress = {};
  MeshFit fit = MeshFit::kOntoBends;
};

struct CompiledOrgan {
  TriangleSurface surface;
  MeshFacts facts;
  std::optional<LostForm> lost = {};  ///< where the triangles asked for are too few for it
};

/// @throws InputError when the label is absent or too small to mesh
CompiledOrgan compile_label(const LabelVolume& volume, int label, const CompileOptions& options);

/// @param surface closed, manifold, outward; components apart from each other, cavities within them; m
CompiledOrgan compile_surface(const TriangleSurface& surface, const CompileOptions& options);

}  // namespace trocar
