// Closed organ surfaces from other programs: STL, PLY, OBJ, OFF, glTF, FBX, VTK (legacy and XML) and Gmsh tetrahedra.
//
// The result is in metres in RAS patient axes (x right, y anterior, z superior). Unit and frame come from the file
// where its standard fixes them, else from the options; without either the unit is refused and the frame is taken to be
// RAS, and `decisions` says so. An open or non-manifold surface is refused unless the options ask for a rescue: nothing
// is filled in silence. The libraries that crash on hostile files run in a child process
// (tissue/imaging/child_process.h). Thread: any without locks held elsewhere, not the tick. docs/organ_surfaces.md has
// the formats, the conventions and the refusals.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"
#include "tissue/progress.h"

namespace trocar {

/// Shrink wrap of a broken scan (CGAL alpha wrap): closed and manifold whatever the input is.
struct WrapSettings {
  double alpha_mm = 2;     ///< holes and gaps narrower than about this are closed
  double offset_mm = 0.2;  ///< distance at which the wrap is laid round the input; taken back afterwards
};

struct SurfaceImportOptions {
  std::string unit;   ///< "mm", "cm", "m" or "um"; "" takes the file's own, and is refused where it has none
  std::string frame;  ///< what the file's x, y, z point at: "RAS", "LPS", "LSA" ...; "" takes the file's own, else RAS
  std::string up_axis;  ///< short for a frame: "z" is RAS, "y" is LSA (as glTF), "x" is SRA; "" for none
  std::string part;     ///< node or region to take by its name; "" takes all of them and welds across them
  std::string
      organ;  ///< what it is meant to be ("liver"): sharpens the hints of size; "" guesses from part and file name
  std::optional<double> fill_holes_mm;  ///< holes up to this span are filled; empty fills none
  std::optional<WrapSettings> wrap;     ///< wrap everything that is taken; empty wraps nothing
  bool only_largest = false;            ///< nothing but the largest part; else all from 1 % of its volume on
};

/// A node, mesh, group or region of the file.
struct SurfacePart {
  std::string name;
  std::size_t triangles = 0;
};

struct ImportedSurface {
  TriangleSurface surface;                ///< welded, closed, manifold, outward, m, RAS; of several parts
  std::vector<double> lost_volumes_m3;    ///< smaller parts left out, largest first
  std::vector<TriangleSurface> cavities;  ///< still filled: what each encloses, outward, largest first
  std::vector<double> filled_volumes_m3;  ///< of cavities that settle_cavities filled
  std::size_t source_self_intersections = 0;
  std::string unit;                    ///< of the file: "mm", "cm", "m", "um", or "2.54 cm"
  std::string frame;                   ///< of the file: "RAS", "LPS" ...
  std::string name, material;          ///< of the organ, where the file is our own export's and says so
  std::vector<SurfacePart> parts;      ///< every named part of the file, whether taken or not, in the order of the file
  std::vector<std::string> decisions;  ///< where unit and frame were taken from, what was ignored
  std::vector<std::string> repairs;    ///< what was changed
  std::vector<std::string> warnings;   ///< what looks wrong and was left alone: a thin shell, an unlikely size
};

/// A volume mesh as its file has it. Metres, RAS; every tetrahedron (a, b, c, d) with (b-a) x (c-a) . (d-a) > 0.
struct ImportedTetrahedra {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::int32_t, 4>> tetrahedra;
  std::vector<std::int32_t> regions;  ///< of each tetrahedron: index into `parts`
  std::vector<SurfacePart> parts;     ///< `triangles` holds the number of tetrahedra
  std::string unit, frame;
  std::vector<std::string> decisions, repairs;
};

/// Organs from a small duct to a whole liver with room to spare: diagonal of the bounding box, m.
inline constexpr double kSmallestOrganM = 0.005;
inline constexpr double kLargestOrganM = 0.6;

/// Factor from "mm", "cm", "m" or "um" to metres. @throws InputError for anything else
double metres_per(const std::string& unit);

/// Whether the extension of the name is one that import_surface reads (".stl", ".ply", ".glb" ...), in any case.
bool is_surface_file(const std::filesystem::path& path);

/// @throws InputError naming the file: unknown or false extension, damaged, no unit, implausible size, no such part,
/// open, not manifold
ImportedSurface import_surface(const std::filesystem::path& path, const SurfaceImportOptions& options,
                               const Progress& progress = {});
/// With the unit alone. @param unit "mm", "cm", "m", "um" or ""
ImportedSurface import_surface(const std::filesystem::path& path, const std::string& unit);

/// Keeps the cavities for which `keep` says yes, and says of the others that they were filled. @param keep of what a
/// cavity encloses, outward
void settle_cavities(ImportedSurface& result, const std::function<bool(const TriangleSurface&)>& keep);

/// The parts of a file, without a word about its unit or whether it is closed. @throws InputError as import_surface
std::vector<SurfacePart> list_surface_parts(const std::filesystem::path& path, const Progress& progress = {});

/// Tetrahedra of .msh, .vtk (UNSTRUCTURED_GRID) and .vtu. @throws InputError as import_surface, or saying that it has
/// none
ImportedTetrahedra read_tetrahedra(const std::filesystem::path& path, const SurfaceImportOptions& options,
                                   const Progress& progress = {});

}  // namespace trocar
