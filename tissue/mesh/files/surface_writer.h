// Surfaces as files of other programs.
//
// PLY, STL, OBJ and VTK (legacy or XML, text) in millimetres and RAS, which the file says ("SPACE=RAS UNIT=mm": 3D
// Slicer places it by the first, our own readers take both), PLY also with name and material (take_own_words()); glTF
// in metres, Y up and the front along Z, as its standard has it, by assimp. Thread: any.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

struct SurfacePartOut {
  std::string name, material, comment;  ///< of one line each
  const TriangleSurface* surface;       ///< m, RAS
};

struct SurfaceFormat {
  /// The file's bytes. @throws EnvironmentError when the library cannot.
  std::string (*bytes)(const std::vector<SurfacePartOut>& parts);
  bool many;  ///< one file holds several parts; else the first is written
};

/// By suffix, without the dot.
const std::map<std::string, SurfaceFormat>& written_formats();

}  // namespace trocar
