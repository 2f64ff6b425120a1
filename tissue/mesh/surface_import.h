// Closed organ surfaces from other programs: PLY through assimp, with a unit that the user must state.
//
// PLY carries no unit and no frame: coordinates are taken as RAS patient axes and multiplied into metres. Open surfaces
// are refused, never filled in silence. Thread: any, not the tick.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tissue/mesh/triangle_surface.h"

namespace trocar {

struct ImportedSurface {
  TriangleSurface surface;              ///< welded, one component, closed, outward, m
  std::vector<double> lost_volumes_m3;  ///< smaller components left out, largest first
  std::size_t source_self_intersections = 0;
  std::vector<std::string> repairs;
};

/// Organs from a small duct to a whole liver with room to spare: diagonal of the bounding box, m.
inline constexpr double kSmallestOrganM = 0.005;
inline constexpr double kLargestOrganM = 0.6;

/// Factor from "mm", "cm" or "m" to metres. @throws InputError for anything else
double metres_per(const std::string& unit);

/// @param unit "mm", "cm" or "m"; empty is refused with the bounding box and the units that would be plausible
/// @throws InputError naming the file: not a PLY, damaged, no unit, implausible size, open, not manifold
ImportedSurface import_surface(const std::filesystem::path& path, const std::string& unit);

}  // namespace trocar
