// PLY, glTF and FBX through assimp, in a child process: assimp crashes and hangs on hostile files.
//
// Node transforms are baked into the vertices (a mirroring one turns the triangles over). glTF comes in metres, LSA
// axes; FBX in the unit and axes of its own settings; PLY without either. assimp keeps coordinates as 32-bit floats.
// Thread: as in_child.
#pragma once

#include <filesystem>

#include "tissue/mesh/files/file_kind.h"
#include "tissue/mesh/files/surface_file.h"
#include "tissue/progress.h"

namespace trocar {

/// @param kind kPly, kGlb, kGltf or kFbx; the extension of the path agrees with it
/// @param bytes the whole file, checked before assimp opens it
/// @throws InputError naming the file
SurfaceFile read_scene(const std::filesystem::path& path, SurfaceKind kind, std::string_view bytes,
                       const Progress& progress);

}  // namespace trocar
