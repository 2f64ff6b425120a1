// What the readers of surface files hand over, as the file has it: its own unit, its own axes, its own winding.
//
// Each reader takes the bytes of a whole file whose kind was checked (file_kind.h), checks every count against the
// length of the file before it makes room, and every index before it is used. Thread: any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

inline constexpr std::uintmax_t kMaxSurfaceBytes = std::uintmax_t{512} << 20;
inline constexpr std::size_t kMaxTriangles = 5'000'000;  ///< of one file; also the most tetrahedra
inline constexpr std::size_t kMaxVertices = 3 * kMaxTriangles;
inline constexpr std::size_t kMaxParts = 4096;
inline constexpr std::size_t kMaxCorners = 64;  ///< of one polygon
inline constexpr std::size_t kMaxNameBytes = 80;

/// A node, mesh, group or region with vertices of its own.
struct FilePart {
  std::string name;
  std::vector<std::string> groups;  ///< nodes above it, the nearest first
  TriangleSurface surface;          ///< units and axes of the file
};

struct FileTetrahedra {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::int32_t, 4>> tetrahedra;
  std::vector<std::int32_t> regions;      ///< of each tetrahedron: index into region_names; empty for one region
  std::vector<std::string> region_names;  ///< never empty when there are tetrahedra
};

struct SurfaceFile {
  std::vector<FilePart> parts;
  FileTetrahedra tetrahedra;     ///< empty in surface files; `parts` then holds what surfaces were stored beside them
  std::optional<double> unit_m;  ///< metres of one unit, where the file says so
  std::string unit_source;       ///< "glTF is in metres by its standard"
  std::string frame;             ///< "RAS", "LPS" ...; "" when the file does not say
  std::string frame_source;      ///< "the header says SPACE=LPS"
  std::string name, material;    ///< of the organ, where our own export says so
  std::vector<std::string> remarks;  ///< what was left out or repaired while reading
};

/// Adds a polygon as triangles (ear clipping: concave ones keep their outline). @param corners at least three, all in
/// range
void add_polygon(TriangleSurface& surface, const std::vector<std::int32_t>& corners);

/// Gives a surface whose triangles are in numbers of `all` those vertices that it uses, in the order of first use.
/// @param scratch -1 for each of `all`, and so again afterwards
void take_vertices(TriangleSurface& surface, const std::vector<Vec3>& all, std::vector<std::int32_t>& scratch);

/// A name out of a file, safe to print: printable ASCII and at most kMaxNameBytes bytes.
std::string printable(std::string_view name);

/// "RAS" or "LPS" for each time that a comment of 3D Slicer says "SPACE=RAS", in any spelling of case; other words as
/// they are.
std::vector<std::string> slicer_spaces(std::string_view comment);
/// Takes frame and unit from a comment or header: "SPACE=RAS" or "SPACE=LPS", as 3D Slicer writes them, and "UNIT=mm",
/// as `organ export` adds it, "UNIT=cm", "UNIT=m" or "UNIT=um". @param where "a comment", "the header", for messages
/// @throws InputError for two spaces, or one that nobody knows
void take_comment(std::string_view comment, const char* where, SurfaceFile& result, const std::string& file);
/// Lines of the header of a PLY that `organ export` wrote; behind them the word.
inline constexpr const char *kOwnName = "comment TROCAR NAME=", *kOwnMaterial = "comment TROCAR MATERIAL=";
/// Takes name and material from them. Words of other programs, or that are no line of text, are left.
void take_own_words(std::string_view header, SurfaceFile& result);
/// Takes the frame from the field "SPACE" that 3D Slicer writes into VTK files.
/// @throws InputError for anything but RAS and LPS: axes that it names and nobody knows are no reason to take others
void take_space(const std::string& letters, SurfaceFile& result, const std::string& file);

/// @throws InputError naming the file when the count is above the cap: "7000000 triangles are more than the 5000000
/// ..."
void check_count(std::uint64_t count, std::uint64_t most, const char* what, const std::string& file);

// One reader a format. @param bytes the whole file @param file its name for messages @throws InputError naming file and
// place
SurfaceFile read_stl(std::string_view bytes, const std::string& file);
SurfaceFile read_obj(std::string_view bytes, const std::string& file);
SurfaceFile read_off(std::string_view bytes, const std::string& file);
SurfaceFile read_vtk_legacy(std::string_view bytes, const std::string& file);
SurfaceFile read_vtk_xml(std::string_view bytes, const std::string& file);
SurfaceFile read_gmsh(std::string_view bytes, const std::string& file);

}  // namespace trocar
