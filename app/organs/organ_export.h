// `trocar organ export ORGAN -o FILE`: an organ or a scene for other programs.
//
// PLY, STL, OBJ and VTK in millimetres and RAS, which the file says ("SPACE=RAS UNIT=mm": 3D Slicer places it by that,
// and `organ import` takes both); glTF in metres, Y up, as its standard has it. Thread: any.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

namespace trocar {

struct OrganExportOptions {
  std::string organ;             ///< manifest, scene (behind # one of its organs) or shipped name
  std::filesystem::path output;  ///< NAME.ply, .stl, .obj, .vtk, .glb; or a folder, for one file an organ
  std::string format = "ply";    ///< of the files in a folder
  std::filesystem::path assets;
};

/// @return 0; the written paths go to `out`. @throws InputError: a format that there is not, several organs for a
/// format that holds one, a file that is there already. EnvironmentError: it cannot be written.
int organ_export(const OrganExportOptions& options, std::ostream& out, std::ostream& err);

}  // namespace trocar
