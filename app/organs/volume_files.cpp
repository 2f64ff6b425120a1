#include "app/organs/volume_files.h"

#include <algorithm>

#include "haptics/digest/digest.h"
#include "haptics/utf8.h"
#include "tissue/mesh/surface/vessel_graph.h"
#include "tissue/organ/toml_table.h"
#include "tissue/solid/lattice.h"
#include "tissue/solid/tetrahedra_file.h"

namespace trocar {
namespace {

SideFile lattice_file(const OrganImportOptions& options, const std::filesystem::path& stem,
                      const TriangleSurface& surface, const LabelledOrgan& made_from, OrganManifest& manifest) {
  const BuiltLattice built =
      build_lattice(surface, {.cell_m = options.lattice_mm * 1e-3, .progress = options.progress}, made_from.labels);
  SideFile file{stem.filename().string() + ".lattice", lattice_bytes(built.lattice)};
  const LatticeFacts& facts = built.facts;
  manifest.lattice =
      VolumeMeshFile{file.name,
                     digest::of_bytes(file.bytes),
                     facts.nodes,
                     facts.cells,
                     options.lattice_mm,
                     facts.volume_error_pct,
                     facts.cells > 0 ? static_cast<double>(facts.floored_cells) / static_cast<double>(facts.cells) : 0};
  return file;
}

SideFile tetrahedra_file(const OrganImportOptions& options, const std::filesystem::path& stem,
                         const TriangleSurface& surface, OrganManifest& manifest) {
  const BuiltTetrahedra built =
      make_tetrahedra({&surface}, {.cell_m = options.tetrahedra_mm * 1e-3, .progress = options.progress});
  SideFile file{stem.filename().string() + ".msh", gmsh_text(built.mesh, {harmless(manifest.name)})};
  const TetrahedraFacts& facts = built.facts;
  manifest.tetrahedra = VolumeMeshFile{file.name,
                                       digest::of_bytes(file.bytes),
                                       facts.nodes,
                                       facts.tetrahedra,
                                       options.tetrahedra_mm,
                                       facts.volume_error_pct,
                                       facts.min_dihedral_deg};
  return file;
}

}  // namespace

std::vector<SideFile> volume_meshes(const OrganImportOptions& options, const std::filesystem::path& stem,
                                    const TriangleSurface& surface, const LabelledOrgan& made_from,
                                    OrganManifest& manifest) {
  std::vector<SideFile> files;
  if (options.lattice_mm > 0) files.push_back(lattice_file(options, stem, surface, made_from, manifest));
  if (options.tetrahedra_mm != 0) files.push_back(tetrahedra_file(options, stem, surface, manifest));
  return files;
}

bool is_tubular(const std::string& name) {
  static constexpr const char* kWords[] = {"aorta", "artery", "vein", "vena_cava", "duct", "ureter", "vessel"};
  return std::any_of(std::begin(kWords), std::end(kWords),
                     [&](const char* word) { return name.find(word) != std::string::npos; });
}

std::vector<SideFile> vessel_files(const OrganImportOptions& options, const std::filesystem::path& stem,
                                   const LabelledOrgan& made_from, const std::string& name) {
  if (!is_tubular(name) || made_from.labels == nullptr) return {};
  const VesselGraph graph = vessel_graph(*made_from.labels, made_from.number, options.progress);
  TomlWriter out;
  out.add("format", 1);
  out.add("name", name);
  out.add("frame", "RAS");
  out.add("unit", "m");
  out.add("parts", graph.parts);
  out.add("length_mm", graph.length_m * 1e3, 3);
  std::string nodes, edges;
  for (const VesselNode& node : graph.nodes) {
    nodes += "\n  [";
    for (const double value : {node.place_m.x(), node.place_m.y(), node.place_m.z(), node.radius_m})
      nodes += TomlWriter::decimal(value, 6) + ", ";
    nodes += "],";
  }
  for (const auto& [from, to] : graph.edges) edges += "\n  [" + std::to_string(from) + ", " + std::to_string(to) + "],";
  out.raw("nodes", "[" + nodes + "\n]  # x, y, z, radius");
  out.raw("edges", "[" + edges + "\n]  # node, node further from the root");
  return {{stem.filename().string() + ".vessels.toml", std::move(out).text()}};
}

}  // namespace trocar
