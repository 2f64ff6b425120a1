// Segmentation for those without labels: a window of values, cleaned, one connected piece kept. It knows no anatomy.
//
// Steps, each optional but the first: smoothing (curvature flow), voxels with values in [low, high] or only those
// connected to a seed (6 neighbours), opening and closing by balls measured in mm (also on unequal voxel edges), the
// piece at the seed or the largest piece, holes filled. Filters of ITK, one thread, on the region that matters. Frame
// RAS, mm. Thread: any, one at a time.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "tissue/imaging/labels/label_volume.h"
#include "tissue/imaging/volumes/image_volume.h"
#include "tissue/progress.h"

namespace trocar {

enum class Keep { kAll, kLargest, kSeeded };

struct SegmentationOptions {
  double low = 0, high = 0;                    ///< in the image's values (HU for CT), both inclusive
  std::optional<Eigen::Vector3d> seed_ras_mm;  ///< wanted for Keep::kSeeded; region growing starts here
  double reach_mm = 0;                    ///< with a seed: nothing further from it than this is looked at; 0 no bound
  double opening_mm = 0, closing_mm = 0;  ///< radii of balls; 0 leaves the step out
  Keep keep = Keep::kLargest;             ///< pieces hang together over voxel faces
  bool smooth = false;                    ///< curvature flow of the values first (5 steps)
  bool fill_holes = true;                 ///< background that the piece encloses
  double leak_share = 0.15;               ///< more than this share of the image's volume gives a leak warning
};

/// Label 1 inside, on the image's grid. Its `notes` say what was done, the share of the image and of the body (voxels
/// above -300 HU in CT), whether the piece touches the image's border, and warn of a leak.
/// @throws InputError naming the option: window upside down or empty, seed outside the image or the window, nothing
/// left after cleaning; without a seed more than half of the image in the window; a piece with more than 5000 tunnels
LabelVolume segment(const ImageVolume& image, const SegmentationOptions& options, const Progress& progress = {});

/// 2 |A and B| / (|A| + |B|) of the voxels with these labels; both on one grid.
double dice(const LabelVolume& a, int label_a, const LabelVolume& b, int label_b);

}  // namespace trocar
