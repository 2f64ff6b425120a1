// Tetrahedra as files of other programs.
//
// Gmsh 2.2 (.msh) and FEBio 4.0 (.feb) in metres, pascals and kilograms: neither says a unit, and so a force comes out
// in newtons. VTK XML (.vtu) in millimetres and RAS, which the file says (vtk_xml_text.h). RAS everywhere. Text; same
// input, same bytes. Thread: any.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tissue/solid/tetrahedra.h"
#include "tissue/solid/tissue_material.h"

namespace trocar {

struct TetrahedraPartOut {
  std::string name, comment;  ///< of one line each
  TissueSolid tissue;         ///< what it is made of
  bool tissue_known = true;   ///< false: that of soft tissue stands in
};

/// The file's bytes. @param parts of label 1, 2, ...
using TetrahedraFormat = std::string (*)(const TetrahedraMesh& mesh, const std::vector<TetrahedraPartOut>& parts);

/// By suffix, without the dot.
const std::map<std::string, TetrahedraFormat>& written_tetrahedra();

/// Gmsh MSH 2.2, ASCII; physical and elementary tag are the label. The names come last: readers that want the nodes
/// right behind the header, as SOFA's of 2022, pass over them.
std::string gmsh_text(const TetrahedraMesh& mesh, const std::vector<std::string>& names);

}  // namespace trocar
