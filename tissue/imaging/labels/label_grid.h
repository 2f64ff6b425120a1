// Where the voxels of a volume lie, whether two volumes share it, and a label map carried from one grid to another.
//
// A map and its image need not have one grid: patient space (RAS, mm) is what they share. Thread: any.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>

#include "tissue/imaging/labels/label_volume.h"
#include "tissue/imaging/volumes/image_volume.h"
#include "tissue/progress.h"

namespace trocar {

struct VoxelGrid {
  std::array<int, 3> size{};
  Eigen::Affine3d index_to_ras_mm = Eigen::Affine3d::Identity();
};

VoxelGrid grid_of(const LabelVolume& volume);
VoxelGrid grid_of(const ImageVolume& volume);

/// Same size, and no voxel centre further than `tolerance_mm` from its namesake.
bool same_grid(const VoxelGrid& a, const VoxelGrid& b, double tolerance_mm = 1e-2);

/// The least grid that holds every voxel of both, where their centres fall on one lattice (cut-outs of one image).
/// @return nothing when they do not, by more than `tolerance_mm`, or when it would hold more voxels than a map may
std::optional<VoxelGrid> common_grid(const VoxelGrid& a, const VoxelGrid& b, double tolerance_mm = 1e-2);

/// Whether the labels reach the border of their grid on all six sides: a cut-out, as masks cropped to their organ are.
bool fills_grid(const LabelVolume& volume);

/// With one more layer of empty voxels on every side: of a cut-out, whose border is not the image's and cuts no organ.
LabelVolume widened(const LabelVolume& volume);

/// The label of the voxel of `volume` that is nearest to each voxel centre of `grid`; 0 outside the volume.
/// @throws InputError when the grid is not a grid (size below 1, singular affine)
LabelVolume resampled_to(const LabelVolume& volume, const VoxelGrid& grid, const Progress& progress = {});

/// Least distance between the boxes that two grids fill, mm; 0 when they touch or overlap. Boxes along the patient's
/// axes.
double gap_mm(const VoxelGrid& a, const VoxelGrid& b);

/// The map on the image's grid, for image values under labels: as it is when the grids agree, otherwise resampled,
/// which a note on the result tells with the share of the volume that is kept (small parts may fall between the image's
/// voxels).
/// @throws InputError "NAME: the label map lies ... mm outside the image" when no labelled voxel lies in the image
LabelVolume on_grid_of(const ImageVolume& image, const LabelVolume& labels, const std::string& name,
                       const Progress& progress = {});

/// Grid with axes at right angles that holds every voxel of a sheared one (gantry tilt): i as it is, k along the slice
/// normal.
VoxelGrid squared_grid(const VoxelGrid& grid);
/// Largest cosine between two axes: 0 at right angles.
double skew_of(const Eigen::Affine3d& index_to_ras_mm);

}  // namespace trocar
