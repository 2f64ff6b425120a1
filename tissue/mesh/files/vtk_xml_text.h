// VTK XML as 3D Slicer, ParaView and SOFA read it: one piece, text, millimetres, RAS.
//
// SPACE as field data is where Slicer looks for the axes (vtkMRMLModelStorageNode); UNIT, CREDIT and REGIONS beside it
// are ours. VTK file formats, "XML file formats". Thread: any.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "haptics/quantities.h"

namespace trocar {

struct VtkXmlPiece {
  std::string type;                     ///< "PolyData", "UnstructuredGrid"
  std::string counts;                   ///< further attributes of the piece: NumberOfPolys="8"
  std::string credit;                   ///< one line
  std::vector<std::string> regions{};   ///< names of region 1, 2, ...; none: no field
  const std::vector<Vec3>* points_m{};  ///< m
  std::string arrays;                   ///< sections behind the points
};

/// An element DataArray. @param values with blanks between
std::string vtk_xml_array(const char* type, const char* name, const std::string& values);

std::string vtk_xml_text(const VtkXmlPiece& piece);

/// Rows of numbers, one a line, and the running ends of the rows: connectivity and offsets.
template <std::size_t Width>
std::pair<std::string, std::string> vtk_xml_cells(const std::vector<std::array<std::int32_t, Width>>& cells) {
  std::string corners, ends;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    for (const std::int32_t corner : cells[n]) corners += std::to_string(corner) + ' ';
    corners.back() = '\n';
    ends += std::to_string((n + 1) * Width) + '\n';
  }
  return {corners, ends};
}

/// Text between XML tags or in an attribute.
std::string xml_escaped(const std::string& text);

}  // namespace trocar
