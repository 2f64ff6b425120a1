// The dense surface of a label: smoothed, of the right volume, flat where the image ends; the source of every
// remeshing.
//
// The field is sampled no finer than the wanted triangles need (two voxels into one sample along fine axes), and twice
// as finely where much of the organ is under three voxels thick. The level is found by regula falsi (Illinois) on the
// enclosed volume, which is counted without making a surface. RAS, metres. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "tissue/imaging/labels/label_mask.h"
#include "tissue/imaging/labels/label_volume.h"
#include "tissue/imaging/labels/smooth_field.h"
#include "tissue/mesh/surface/cap_planes.h"
#include "tissue/mesh/surface/triangle_surface.h"
#include "tissue/progress.h"

namespace trocar {

struct LabelSurface {
  TriangleSurface dense;           ///< closed, outward; of one or several components
  TriangleSurface sharp;           ///< of the mask before smoothing: what distances are measured against
  double level = 0;                ///< of the field
  double kept_m3 = 0;              ///< volume of the kept voxels, less what fell off
  Vec3 centroid_m = Vec3::Zero();  ///< of the kept voxels
  Vec3 spacing_m = Vec3::Zero();   ///< voxel edges
  Sampling sampling{1, 1, 1};
  std::vector<CapPlane> caps;  ///< where the organ is cut
  std::vector<double>
      fallen_off_m3;  ///< pieces that the smoothing parted from the organ and that are too small to keep
};

/// @param triangles wanted in the end: decides how finely the field is sampled
/// @throws InputError when the label is too thin to give a surface
LabelSurface label_surface(const LabelVolume& volume, int label, const LabelMask& mask, int triangles,
                           const Progress& progress = {});

/// From the box of the mask, in voxels, to RAS metres.
Eigen::Affine3d box_to_ras_m(const LabelVolume& volume, const LabelMask& mask);

/// Maps every vertex; turns the triangles over where the map mirrors.
void map_vertices(TriangleSurface& surface, const Eigen::Affine3d& transform);

}  // namespace trocar
