// One surface file of any kind, read as it is: the place where extension and first bytes choose the reader.
//
// Thread: as in_child.
#pragma once

#include <filesystem>

#include "tissue/mesh/files/surface_file.h"
#include "tissue/progress.h"

namespace trocar {

/// Parts without triangles are left out; tetrahedra are turned positive.
/// @throws InputError naming the file: missing, too large, false extension, damaged, holds neither triangles nor
/// tetrahedra
SurfaceFile read_surface_file(const std::filesystem::path& path, const Progress& progress);

}  // namespace trocar
