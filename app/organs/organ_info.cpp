#include "app/organs/organ_info.h"

#include <algorithm>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/organs/organ_report.h"
#include "app/session/setup/scene.h"
#include "haptics/input_error.h"
#include "tissue/organ/organ.h"
#include "tissue/organ/organ_set.h"
#include "tissue/organ/surface_import.h"
#include "tissue/solid/lattice.h"
#include "tissue/solid/tetrahedra.h"

namespace trocar {
namespace {

/// The tetrahedra read back from their file, counted and measured anew.
void prove_tetrahedra(const std::filesystem::path& file, VolumeMeshFile& facts) {
  SurfaceImportOptions how;
  how.unit = "m", how.frame = "RAS";
  ImportedTetrahedra read = read_tetrahedra(file, how);
  if (read.vertices.size() != facts.nodes || read.tetrahedra.size() != facts.cells)
    throw InputError(file.string() + ": holds " + std::to_string(read.vertices.size()) + " nodes and " +
                     std::to_string(read.tetrahedra.size()) + " tetrahedra, the manifest says " +
                     std::to_string(facts.nodes) + " and " + std::to_string(facts.cells));
  const TetrahedraMesh mesh{std::move(read.vertices), std::move(read.tetrahedra), {}};
  facts.worst = 180;
  for (std::size_t n = 0; n < mesh.tetrahedra.size(); ++n)
    facts.worst = std::min(facts.worst, smallest_dihedral_deg(mesh, n));
}

/// Lattice and tetrahedra beside the manifest: there, unchanged, and what the manifest says.
void prove_volume_meshes(const std::filesystem::path& path, OrganManifest& manifest) {
  if (manifest.lattice) {
    const std::filesystem::path file = path.parent_path() / manifest.lattice->file;
    const Lattice lattice = parse_lattice(read_unchanged(file, manifest.lattice->sha256, path.string()), file.string());
    if (lattice.nodes.size() != manifest.lattice->nodes || lattice.cells.size() != manifest.lattice->cells)
      throw InputError(file.string() + ": holds another number of nodes or cells than the manifest says");
  }
  if (manifest.tetrahedra) {
    const std::filesystem::path file = path.parent_path() / manifest.tetrahedra->file;
    read_unchanged(file, manifest.tetrahedra->sha256, path.string());
    prove_tetrahedra(file, *manifest.tetrahedra);
  }
}

/// The manifest with what can be proved on the surface proved anew.
CompiledMember proved(const std::filesystem::path& path, std::ostream& err) {
  const Organ organ = load_organ(path);
  CompiledMember member{parse_manifest(read_bytes(path), path.string()), organ.surface};
  const std::size_t said = member.manifest.mesh.self_intersections;
  prove_surface(organ.surface, member.manifest.mesh);
  if (said != member.manifest.mesh.self_intersections)
    err << "warning: " << path.string() << ": says " << said << " self-intersections, but the surface has "
        << member.manifest.mesh.self_intersections << ": import it again\n";
  prove_volume_meshes(path, member.manifest);
  return member;
}

/// Says what is wrong. @return the exit code: 0 sound, 2 a check that found something
int verdict_of(const std::vector<CompiledMember>& organs, const std::vector<OrganCrossing>& crossings,
               std::ostream& err) {
  const std::vector<std::string> faults = faults_of(organs, crossings);
  for (const std::string& fault : faults) err << "warning: " << fault << "\n";
  return faults.empty() ? 0 : 2;
}

}  // namespace

int organ_info(const OrganInfoOptions& options, std::ostream& out, std::ostream& err) {
  const std::filesystem::path path = without_subject(options.manifest);
  const std::string file = path.string();
  if (!file.ends_with(kOrganSetSuffix)) {
    const CompiledMember organ = proved(path, err);
    out << (options.json ? organ_json(organ.manifest, organ.surface.bounds())
                         : organ_text(organ.manifest, organ.surface.bounds()));
    return verdict_of({organ}, {}, err);
  }
  OrganSet set = parse_organ_set(read_bytes(path), file);
  load_organ(path);  // every member is there and unchanged
  std::vector<CompiledMember> organs;
  for (const std::string& member : set.files) organs.push_back(proved(path.parent_path() / member, err));
  set.crossings = organ_crossings(organs);
  out << (options.json ? scene_report_json(set, organs) : scene_report_text(set, organs));
  return verdict_of(organs, set.crossings, err);
}

namespace {
struct OrganInfoArguments {
  OrganInfoOptions options;
  std::string organ;
};
}  // namespace

void add_organ_info(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<OrganInfoArguments>();
  OrganInfoOptions& o = given->options;
  CLI::App* info = add_command(parent, "info", "What an organ is and how good its surface", chosen, [given] {
    const std::filesystem::path assets = find_assets().assets;
    given->options.manifest = find_organ(given->organ, assets);
    return organ_info(given->options, std::cout, std::cerr);
  });
  info->add_flag("--json", o.json, "As JSON");
  info->add_option("organ", given->organ, kOrganForms)->required();
}

}  // namespace trocar
