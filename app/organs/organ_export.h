// `trocar organ export ORGAN -o FILE`: an organ or a scene for other programs.
//
// PLY, STL, OBJ and VTK in millimetres and RAS, which the file says ("SPACE=RAS UNIT=mm": 3D Slicer places it by that,
// and `organ import` takes both); glTF in metres, Y up, as its standard has it. With a size of tetrahedra instead a
// mesh of those, one region an organ (tetrahedra_file.h). Thread: any.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "tissue/progress.h"

namespace trocar {

struct OrganExportOptions {
  std::string organ;             ///< manifest, scene (behind # one of its organs) or shipped name
  std::filesystem::path output;  ///< NAME.ply, .stl, .obj, .vtk, .vtp, .glb; or a folder, for one file an organ
  std::string format = "ply";    ///< of the files in a folder
  std::filesystem::path assets;
  std::optional<double> tetrahedra_mm = {};  ///< size; NAME.msh, .vtu or .feb
  Progress progress = {};
};

/// @return 0; the written paths go to `out`. @throws InputError: a format that there is not, several organs for a
/// format that holds one, a file that is there already, tetrahedra of a size that cannot be. EnvironmentError: it
/// cannot be written, or there is too little memory; nothing is left behind.
int organ_export(const OrganExportOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
