// From triangles in metres to one closed, manifold, outward surface, or a refusal that says what would help.
//
// Thread: any, not the tick.
#pragma once

#include "tissue/organ/surface_import.h"

namespace trocar {

/// @param soup m, RAS
/// @param result takes the surface, the repairs, the warnings, the lost parts, the cavities
/// @param organ name that the warnings go by, "" for none
/// @throws InputError naming the file: open, not manifold, one-sided, encloses nothing, hole too wide, wrap too fine
void close_surface(const TriangleSurface& soup, const SurfaceImportOptions& options, const std::string& organ,
                   const std::string& file, ImportedSurface& result, const Progress& progress);

}  // namespace trocar
