#include "tissue/mesh/files/vtk_cells.h"

#include <array>

#include "haptics/input_error.h"

namespace trocar {
namespace {

using Corners = std::vector<std::int32_t>;

Corners corners_of(const VtkCells& cells, std::size_t cell) {
  Corners corners;
  for (auto n = cell == 0 ? 0 : cells.ends[cell - 1]; n < cells.ends[cell]; ++n)
    corners.push_back(static_cast<std::int32_t>(cells.corners[static_cast<std::size_t>(n)]));
  return corners;
}

std::string cell_name(std::size_t cell, const std::string& file) { return file + ": cell " + std::to_string(cell); }

void add_strip(const Corners& corners, TriangleSurface& surface, const std::string& file) {
  if (corners.size() < 3) throw InputError(file + ": a strip of fewer than three corners");
  check_count(surface.triangles.size() + corners.size() - 2, kMaxTriangles, "triangles", file);
  for (std::size_t n = 2; n < corners.size(); ++n)
    surface.triangles.push_back(n % 2 == 0 ? std::array{corners[n - 2], corners[n - 1], corners[n]}
                                           : std::array{corners[n - 1], corners[n - 2], corners[n]});
}

void add_one_polygon(const Corners& corners, TriangleSurface& surface, const std::string& where) {
  if (corners.size() < 3 || corners.size() > kMaxCorners)
    throw InputError(where + ": a polygon of " + std::to_string(corners.size()) + " corners");
  check_count(surface.triangles.size() + corners.size() - 2, kMaxTriangles, "triangles", where);
  add_polygon(surface, corners);
}

void add_tetrahedron(const Corners& corners, FileTetrahedra& mesh, const std::string& file) {
  check_count(mesh.tetrahedra.size() + 1, kMaxTriangles, "tetrahedra", file);
  mesh.tetrahedra.push_back({corners[0], corners[1], corners[2], corners[3]});
}

/// Kinds of volume cell that people have and this does not read.
const char* solid_name(std::int64_t type) {
  switch (type) {
    case 11:
      return "voxels";
    case 12:
    case 25:
      return "hexahedra";
    case 13:
    case 26:
      return "wedges";
    case 14:
    case 27:
      return "pyramids";
    case 41:
    case 42:
      return "polyhedra";
    default:
      return nullptr;
  }
}

std::size_t corners_wanted(std::int64_t type) {
  switch (type) {
    case 5:
      return 3;
    case 8:
    case 9:
    case 10:
      return 4;
    case 22:
      return 6;
    case 24:
      return 10;
    default:
      return 0;
  }
}

void add_cell(std::int64_t type, const Corners& c, SurfaceFile& result, TriangleSurface& surface,
              const std::string& where) {
  const std::size_t wanted = corners_wanted(type);
  if (wanted != 0 && c.size() != wanted)
    throw InputError(where + ": has " + std::to_string(c.size()) + " corners instead of " + std::to_string(wanted));
  switch (type) {
    case 1:
    case 2:
    case 3:
    case 4:
    case 21:
      return;  // points and lines
    case 6:
      return add_strip(c, surface, where);
    case 8:
      return add_one_polygon({c[0], c[1], c[3], c[2]}, surface, where);
    case 5:
    case 7:
    case 9:
      return add_one_polygon(c, surface, where);
    case 22:
      return add_one_polygon({c[0], c[1], c[2]}, surface, where);
    case 10:
    case 24:
      return add_tetrahedron(c, result.tetrahedra, where);
    default:
      break;
  }
  if (const char* name = solid_name(type))
    throw InputError(where + ": " + name + " are not read, only tetrahedra and polygons: extract the surface first");
  throw InputError(where + ": cells of VTK's type " + std::to_string(type) + " are not read");
}

}  // namespace

VtkCells cells_of_counted_list(const std::vector<std::int64_t>& list, std::int64_t cells, const std::string& file) {
  VtkCells result;
  std::size_t at = 0;
  for (std::int64_t cell = 0; cell < cells; ++cell) {
    const std::string where = cell_name(static_cast<std::size_t>(cell), file);
    if (at >= list.size())
      throw InputError(where + " of " + std::to_string(cells) + ": the list of cells ends before it");
    const std::int64_t corners = list[at++];
    if (corners < 0 || static_cast<std::uint64_t>(corners) > list.size() - at)
      throw InputError(where + ": counts " + std::to_string(corners) + " corners, more than the list holds");
    for (std::int64_t n = 0; n < corners; ++n) result.corners.push_back(list[at++]);
    result.ends.push_back(static_cast<std::int64_t>(result.corners.size()));
  }
  if (at != list.size()) throw InputError(file + ": the list of cells is longer than its cells");
  return result;
}

void check_cells(const VtkCells& cells, std::size_t points, const std::string& file) {
  std::int64_t before = 0;
  for (std::size_t cell = 0; cell < cells.ends.size(); ++cell) {
    if (cells.ends[cell] < before || static_cast<std::uint64_t>(cells.ends[cell]) > cells.corners.size())
      throw InputError(cell_name(cell, file) + ": its offset " + std::to_string(cells.ends[cell]) + " is out of order");
    for (auto n = before; n < cells.ends[cell]; ++n) {
      const std::int64_t corner = cells.corners[static_cast<std::size_t>(n)];
      if (corner < 0 || static_cast<std::uint64_t>(corner) >= points)
        throw InputError(cell_name(cell, file) + ": names vertex " + std::to_string(corner) + " of " +
                         std::to_string(points));
    }
    before = cells.ends[cell];
  }
  if (static_cast<std::uint64_t>(before) != cells.corners.size())
    throw InputError(file + ": its offsets end at " + std::to_string(before) + " of " +
                     std::to_string(cells.corners.size()) + " corners");
}

void add_polygons(const VtkCells& cells, TriangleSurface& surface, const std::string& file) {
  for (std::size_t cell = 0; cell < cells.ends.size(); ++cell)
    add_one_polygon(corners_of(cells, cell), surface, cell_name(cell, file));
}

void add_strips(const VtkCells& cells, TriangleSurface& surface, const std::string& file) {
  for (std::size_t cell = 0; cell < cells.ends.size(); ++cell) add_strip(corners_of(cells, cell), surface, file);
}

void add_cells(const VtkCells& cells, const std::vector<std::int64_t>& types, SurfaceFile& result,
               TriangleSurface& surface, const std::string& file) {
  if (types.size() != cells.ends.size())
    throw InputError(file + ": " + std::to_string(cells.ends.size()) + " cells have " + std::to_string(types.size()) +
                     " types");
  for (std::size_t cell = 0; cell < cells.ends.size(); ++cell)
    add_cell(types[cell], corners_of(cells, cell), result, surface, cell_name(cell, file));
}

}  // namespace trocar
