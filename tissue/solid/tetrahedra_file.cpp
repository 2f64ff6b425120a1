#include "tissue/solid/tetrahedra_file.h"

#include <algorithm>
#include <sstream>

#include "tissue/mesh/files/vtk_xml_text.h"

namespace trocar {
namespace {

std::ostringstream plain_text() {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(9);
  return out;
}

std::vector<std::string> names_of(const std::vector<TetrahedraPartOut>& parts) {
  std::vector<std::string> names;
  for (const TetrahedraPartOut& part : parts) names.push_back(part.name);
  return names;
}

std::string msh_bytes(const TetrahedraMesh& mesh, const std::vector<TetrahedraPartOut>& parts) {
  return gmsh_text(mesh, names_of(parts));
}

std::string vtu_bytes(const TetrahedraMesh& mesh, const std::vector<TetrahedraPartOut>& parts) {
  constexpr const char* kTetrahedron = "10\n";
  const auto [corners, ends] = vtk_xml_cells(mesh.tetrahedra);
  std::string types, regions, credit;
  for (const std::int32_t label : mesh.labels) types += kTetrahedron, regions += std::to_string(label) + '\n';
  for (const TetrahedraPartOut& part : parts) credit += (credit.empty() ? "" : "; ") + part.comment;
  return vtk_xml_text({.type = "UnstructuredGrid",
                       .counts = "NumberOfCells=\"" + std::to_string(mesh.tetrahedra.size()) + "\"",
                       .credit = credit,
                       .regions = names_of(parts),
                       .points_m = &mesh.nodes,
                       .arrays = "<Cells>\n" + vtk_xml_array("Int32", "connectivity", corners) +
                                 vtk_xml_array("Int32", "offsets", ends) + vtk_xml_array("UInt8", "types", types) +
                                 "</Cells>\n<CellData>\n" + vtk_xml_array("Int32", "region", regions) +
                                 "</CellData>\n"});
}

/// A comment holds no "--".
std::string xml_comment(std::string text) {
  for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at)) text.insert(at + 1, " ");
  return "<!-- " + text + " -->\n";
}

/// FEBio input specification 4.0: a material, a list of elements and a domain of each organ, all of the organ's name.
std::string feb_bytes(const TetrahedraMesh& mesh, const std::vector<TetrahedraPartOut>& parts) {
  auto out = plain_text();
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<febio_spec version=\"4.0\">\n"
      << xml_comment("m, Pa, kg; RAS. Young's modulus long-term, of small strain; no loads, no supports")
      << "<Module type=\"solid\"/>\n<Material>\n";
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const TissueSolid& tissue = parts[n].tissue;
    out << xml_comment(parts[n].comment + "; E of " + tissue.name + ", " + tissue.sources.at("young_pa").source +
                       (parts[n].tissue_known ? "" : "; no tissue is known of that name"))
        << "<material id=\"" << n + 1 << "\" name=\"" << xml_escaped(parts[n].name)
        << "\" type=\"neo-Hookean\">\n<density>" << tissue.density_kg_m3 << "</density>\n<E>" << tissue.young_pa
        << "</E>\n<v>" << tissue.poisson << "</v>\n</material>\n";
  }
  out << "</Material>\n<Mesh>\n<Nodes name=\"nodes\">\n";
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    out << "<node id=\"" << n + 1 << "\">" << mesh.nodes[n].x() << ',' << mesh.nodes[n].y() << ',' << mesh.nodes[n].z()
        << "</node>\n";
  out << "</Nodes>\n";
  for (std::size_t n = 0; n < parts.size(); ++n) {
    out << "<Elements type=\"tet4\" name=\"" << xml_escaped(parts[n].name) << "\">\n";
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
      if (static_cast<std::size_t>(mesh.labels[t]) != n + 1) continue;
      const auto& [a, b, c, d] = mesh.tetrahedra[t];
      out << "<elem id=\"" << t + 1 << "\">" << a + 1 << ',' << b + 1 << ',' << c + 1 << ',' << d + 1 << "</elem>\n";
    }
    out << "</Elements>\n";
  }
  out << "</Mesh>\n<MeshDomains>\n";
  for (const TetrahedraPartOut& part : parts)
    out << "<SolidDomain name=\"" << xml_escaped(part.name) << "\" mat=\"" << xml_escaped(part.name) << "\"/>\n";
  out << "</MeshDomains>\n</febio_spec>\n";
  return out.str();
}

}  // namespace

std::string gmsh_text(const TetrahedraMesh& mesh, const std::vector<std::string>& names) {
  constexpr int kTetrahedron = 4;
  auto out = plain_text();
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << mesh.nodes.size() << '\n';
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    out << n + 1 << ' ' << mesh.nodes[n].x() << ' ' << mesh.nodes[n].y() << ' ' << mesh.nodes[n].z() << '\n';
  out << "$EndNodes\n$Elements\n" << mesh.tetrahedra.size() << '\n';
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    out << t + 1 << ' ' << kTetrahedron << " 2 " << mesh.labels[t] << ' ' << mesh.labels[t];
    for (const auto node : mesh.tetrahedra[t]) out << ' ' << node + 1;
    out << '\n';
  }
  out << "$EndElements\n$PhysicalNames\n" << names.size() << '\n';
  for (std::size_t n = 0; n < names.size(); ++n) {
    std::string name = names[n];
    std::replace(name.begin(), name.end(), '"', '\'');
    out << "3 " << n + 1 << " \"" << name << "\"\n";
  }
  out << "$EndPhysicalNames\n";
  return out.str();
}

const std::map<std::string, TetrahedraFormat>& written_tetrahedra() {
  static const std::map<std::string, TetrahedraFormat> kFormats{
      {"msh", msh_bytes}, {"vtu", vtu_bytes}, {"feb", feb_bytes}};
  return kFormats;
}

}  // namespace trocar
