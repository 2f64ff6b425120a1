// Remeshing of several organs at once: the faces that two organs share stay one set of triangles.
//
// As remesh.h (split, collapse, flip, relax and project), on a complex in which curves join three and more patches. A
// vertex is of a patch, of a curve, or a corner; collapses never take a vertex off its curve or move a corner, and only
// where the link of the edge allows it (Dey et al. 1999), so every organ stays the closed manifold that it was. Metres.
// Deterministic. Thread: any.
#pragma once

#include "tissue/mesh/complex/label_complex.h"
#include "tissue/progress.h"

namespace trocar {

struct ComplexRemeshOptions {
  std::vector<int> triangles;  ///< wanted for the border of region 1, 2, ...
  double smoothing_m = 0;      ///< distance over which normals are averaged for the curvature
  int rounds = 8;
  int fit_sweeps = 3;  ///< 0 leaves the vertices on the dense complex
  Progress progress = {};
};

LabelComplex remeshed(const LabelComplex& dense, const ComplexRemeshOptions& options);

}  // namespace trocar
