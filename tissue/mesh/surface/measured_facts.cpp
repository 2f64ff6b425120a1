#include "tissue/mesh/surface/measured_facts.h"

namespace trocar {

void note_mask(const LabelMask& mask, double voxel_ml, MeshFacts& facts) {
  const auto ml = [&](std::size_t voxels) { return static_cast<double>(voxels) * voxel_ml; };
  facts.label_volume_ml = ml(mask.label_voxels);
  facts.border_voxels = mask.border_voxels;
  for (const std::size_t voxels : mask.lost_parts) facts.lost.push_back({"part", voxels, ml(voxels)});
  if (!mask.lost_parts.empty())
    facts.repairs.push_back("left out " + std::to_string(mask.lost_parts.size()) + " small parts");
  if (mask.bridge_voxels > 0) {
    facts.added.push_back({"bridge", mask.bridge_voxels, ml(mask.bridge_voxels)});
    facts.repairs.push_back("joined parts by " + std::to_string(mask.bridge_voxels) + " voxels");
  }
  if (mask.parts > 1) facts.repairs.push_back("kept " + std::to_string(mask.parts) + " parts that lie apart");
  for (const std::size_t voxels : mask.cavities) {
    facts.added.push_back({"cavity", voxels, ml(voxels)});
    facts.repairs.push_back("filled a cavity of " + std::to_string(voxels) + " voxels");
  }
  if (mask.border_voxels > 0)
    facts.repairs.push_back("closed the cut at the image border with a flat cap (" +
                            std::to_string(mask.border_voxels) + " voxels)");
}

void measure(const TriangleSurface& surface, double kept_m3, const TriangleSurface& reference, const Vec3& centroid_m,
             MeshFacts& facts) {
  constexpr double kMlPerM3 = 1e6;
  facts.topology = analyse_topology(surface);
  facts.volume_ml = surface.volume_m3() * kMlPerM3;
  facts.kept_volume_ml = kept_m3 * kMlPerM3;
  facts.kept_error_pct = (facts.volume_ml / facts.kept_volume_ml - 1) * 100;
  facts.volume_error_pct = (facts.volume_ml / facts.label_volume_ml.value_or(facts.kept_volume_ml) - 1) * 100;
  facts.distance = distance_from_to(surface, reference);
  facts.distance_back = distance_from_to(reference, surface);
  facts.quality = mesh_quality(surface);
  facts.centroid_offset_m = (volume_centroid_m(surface) - centroid_m).norm();
}

}  // namespace trocar
