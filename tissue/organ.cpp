#include "tissue/organ.h"

#include <algorithm>
#include <vector>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tissue/mesh/organ_manifest.h"
#include "tissue/mesh/ply_file.h"
#include "tissue/mesh/topology.h"

namespace trocar {
namespace {

TriangleSurface load_surface(const OrganManifest& manifest, const std::filesystem::path& beside) {
  const std::filesystem::path path = beside.parent_path() / manifest.surface;
  const std::string bytes = read_bytes(path), file = path.string();
  TriangleSurface surface = parse_ply(bytes, file);
  const std::string hash = digest::of_bytes(bytes);
  if (hash != manifest.surface_sha256)
    throw InputError(file + ": sha256 " + hash + " is not the manifest's: the file was changed");
  const SurfaceTopology facts = analyse_topology(surface);
  if (facts.triangles == 0) throw InputError(file + ": the surface is empty");
  if (!facts.closed())
    throw InputError(file + ": the surface is open (" + std::to_string(facts.boundary_edges) + " boundary edges)");
  if (!facts.manifold()) throw InputError(file + ": the surface is not an oriented manifold");
  if (surface.volume_m3() <= 0) throw InputError(file + ": the surface is inside out");
  return surface;
}

}  // namespace

Organ load_organ(const std::filesystem::path& manifest) {
  const OrganManifest read = parse_manifest(read_bytes(manifest), manifest.string());
  Organ organ;
  organ.name = read.name;
  organ.material = read.material;
  organ.surface = load_surface(read, manifest);
  organ.synthetic = read.synthetic;
  organ.cut_at_border = read.mesh.cut_at_border();
  organ.modality = read.source.modality;
  organ.source_file = read.source.file;
  organ.source_sha256 = read.source.sha256;
  organ.licence = read.licence;
  organ.credit = read.credit;
  organ.sha256 = read.surface_sha256;
  organ.manifest = manifest;
  return organ;
}

std::filesystem::path find_organ(const std::string& name_or_path, const std::filesystem::path& assets) {
  if (std::filesystem::is_regular_file(name_or_path)) return name_or_path;
  const std::filesystem::path folder = assets / "organs";
  std::filesystem::path shipped = folder / (name_or_path + std::string(kOrganSuffix));
  if (std::filesystem::path(name_or_path).filename() == name_or_path && std::filesystem::is_regular_file(shipped))
    return shipped;
  std::vector<std::string> names;
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(folder, missing)) {
    const std::string file = entry.path().filename().string();
    if (file.ends_with(kOrganSuffix)) names.push_back(file.substr(0, file.size() - kOrganSuffix.size()));
  }
  std::sort(names.begin(), names.end());
  std::string known;
  for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
  throw InputError(name_or_path + ": neither a file nor an organ that ships (" + (known.empty() ? "none" : known) +
                   ")");
}

}  // namespace trocar
