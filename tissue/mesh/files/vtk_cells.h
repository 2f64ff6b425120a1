// Cells of VTK data sets, legacy or XML, turned into triangles and tetrahedra.
//
// Thread: any.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tissue/mesh/files/surface_file.h"

namespace trocar {

/// Lists of corners one behind the other.
struct VtkCells {
  std::vector<std::int64_t> corners;
  std::vector<std::int64_t> ends;  ///< of each cell, in corners
};

/// "count, corners, count, corners" as legacy files before version 5 have it.
/// @throws InputError naming the cell when the counts do not fill the list
VtkCells cells_of_counted_list(const std::vector<std::int64_t>& list, std::int64_t cells, const std::string& file);

/// Rising ends that reach the last corner, corners that are points. @throws InputError naming the cell
void check_cells(const VtkCells& cells, std::size_t points, const std::string& file);

/// Checked cells as polygons, as strips, or each as its type says. @throws InputError: too many, no polygon, a kind
/// that is not read
void add_polygons(const VtkCells& cells, TriangleSurface& surface, const std::string& file);
void add_strips(const VtkCells& cells, TriangleSurface& surface, const std::string& file);
void add_cells(const VtkCells& cells, const std::vector<std::int64_t>& types, SurfaceFile& result,
               TriangleSurface& surface, const std::string& file);

}  // namespace trocar
