// What is known about a compiled organ surface: the numbers of the import report and of the organ manifest.
//
// Units in the names. Plain values, any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tissue/mesh/surface/mesh_quality.h"
#include "tissue/mesh/surface/surface_check.h"
#include "tissue/mesh/surface/topology.h"

namespace trocar {

/// A piece of the source that is not in the surface.
struct LostPart {
  std::string kind;        ///< "part" (apart from the largest) or "detached" (fell off when the mask was smoothed)
  std::size_t voxels = 0;  ///< 0 when the source had none
  double volume_ml = 0;
};

/// What the surface encloses although the source does not mark it.
struct AddedPart {
  std::string kind;  ///< "cavity" (filled), "bridge" (joins two parts)
  std::size_t voxels = 0;
  double volume_ml = 0;
};

struct MeshFacts {
  SurfaceTopology topology;
  MeshQuality quality;  ///< angles and edge lengths of the triangles
  std::size_t self_intersections = 0;
  double volume_ml = 0;
  std::optional<double> label_volume_ml;  ///< every voxel that carries the label; absent for imported surfaces
  double kept_volume_ml = 0;      ///< what the surface should enclose: label - lost + filled, or the source surface
  double volume_error_pct = 0;    ///< of volume_ml against the label, or against the source surface
  double kept_error_pct = 0;      ///< of volume_ml against kept_volume_ml
  SurfaceDistance distance;       ///< from the mesh to the original: iso surface of the unsmoothed mask, or source
  SurfaceDistance distance_back;  ///< from the original to the mesh: shows slits that were closed, tips cut off
  std::size_t border_voxels = 0;  ///< kept voxels in the outermost slices: the cut face
  std::vector<LostPart> lost;
  std::vector<std::string> repairs;
  double centroid_offset_m =
      0;               ///< centre of the enclosed volume against that of the kept voxels (or of the source surface)
  double voxel_m = 0;  ///< cube root of the voxel volume; 0 for imported surfaces
  std::vector<AddedPart> added;  ///< included in kept_volume_ml

  bool cut_at_border() const { return border_voxels > 0; }
  /// Largest distance either way, m (of samples; the Hausdorff distance but for the sampling).
  double hausdorff_m() const { return distance.max_m > distance_back.max_m ? distance.max_m : distance_back.max_m; }
  /// The same in voxels; absent for imported surfaces.
  std::optional<double> hausdorff_voxels() const {
    return voxel_m > 0 ? std::optional<double>(hausdorff_m() / voxel_m) : std::nullopt;
  }
};

}  // namespace trocar
