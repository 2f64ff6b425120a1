#include "tissue/organ/organ.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tissue/imaging/labels/segment.h"
#include "tissue/imaging/volumes/volume_reader.h"
#include "tissue/mesh/surface/topology.h"
#include "tissue/organ/organ_manifest.h"
#include "tissue/organ/organ_set.h"
#include "tissue/organ/ply_file.h"
#include "tissue/organ/surface_import.h"

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

/// "a.scene.toml#liver" -> the file and the organ; a file that has such a name as a whole is that file.
std::pair<std::string, std::string> split_subject(const std::string& given) {
  const std::size_t mark = given.rfind('#');
  if (mark == std::string::npos || std::filesystem::is_regular_file(given)) return {given, ""};
  return {given.substr(0, mark), given.substr(mark + 1)};
}

/// "phantom-liver" of a file that ships, "" of any other file.
std::string shipped_name(const std::string& file) {
  for (const std::string_view suffix : {kOrganSuffix, kOrganSetSuffix})
    if (file.ends_with(suffix)) return file.substr(0, file.size() - suffix.size());
  return "";
}

/// What an organ is made from, or a part of it, is none.
void refuse_other_kinds(const std::string& file) {
  if (is_volume_file(file))
    throw InputError(file + ": is an image or a label map: `trocar organ import` makes an organ of it");
  if (!is_surface_file(file)) return;
  const std::filesystem::path organ = std::filesystem::path(file).replace_extension(kOrganSuffix);
  throw InputError(file + ": is a surface: " +
                   (std::filesystem::is_regular_file(organ) ? "give its organ, " + organ.string()
                                                            : "`trocar organ import` makes an organ of it"));
}

/// ": give one of a.scene.toml, b.organ.toml and 3 more"
std::string organs_in(const std::filesystem::path& folder) {
  constexpr std::size_t kListed = 6;
  std::vector<std::string> scenes, organs;
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable)) {
    const std::string file = entry.path().filename().string();
    if (file.ends_with(kOrganSetSuffix)) scenes.push_back(file);
    if (file.ends_with(kOrganSuffix)) organs.push_back(file);
  }
  std::sort(scenes.begin(), scenes.end());
  std::sort(organs.begin(), organs.end());
  scenes.insert(scenes.end(), organs.begin(), organs.end());
  if (scenes.empty()) return " without an organ in it; `trocar organ import` makes organs of scans and surfaces";
  return ": give one of the files in it: " + listed_words(scenes, kListed);
}

}  // namespace

Organ load_organ(const std::filesystem::path& given) {
  const auto [manifest, subject] = split_subject(given.string());
  if (manifest.ends_with(kOrganSetSuffix)) return load_organ_set(manifest, subject);
  if (!subject.empty()) throw InputError(given.string() + ": only a scene has a subject to choose");
  const OrganManifest read = parse_manifest(read_bytes(manifest), manifest);
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
  organ.manifest = given;
  return organ;
}

std::filesystem::path without_subject(const std::filesystem::path& given) {
  return split_subject(given.string()).first;
}

std::filesystem::path find_organ(const std::string& name_or_path, const std::filesystem::path& assets) {
  const auto [name, subject] = split_subject(name_or_path);
  if (std::filesystem::is_regular_file(name)) {
    refuse_other_kinds(name);
    return name_or_path;
  }
  const std::filesystem::path folder = assets / "organs";
  for (const std::string_view suffix : {kOrganSuffix, kOrganSetSuffix}) {
    const std::filesystem::path shipped = folder / (name + std::string(suffix));
    if (std::filesystem::path(name).filename() == name && std::filesystem::is_regular_file(shipped))
      return shipped.string() + (subject.empty() ? "" : "#" + subject);
  }
  if (std::filesystem::is_directory(name)) throw InputError(name + ": is a folder" + organs_in(name));
  std::vector<std::string> names;
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(folder, missing)) {
    const std::string shipped = shipped_name(entry.path().filename().string());
    if (!shipped.empty()) names.push_back(shipped);
  }
  std::sort(names.begin(), names.end());
  for (std::size_t scene = 0; scene < names.size(); ++scene)  // the members of a scene come with it
    if (std::filesystem::exists(folder / (names[scene] + std::string(kOrganSetSuffix))))
      std::erase_if(names, [prefix = names[scene] + "-"](const std::string& one) { return one.starts_with(prefix); });
  std::string known;
  for (const std::string& one : names) known += (known.empty() ? "" : ", ") + one;
  throw InputError(name_or_path + ": neither a file nor an organ that ships (" + (known.empty() ? "none" : known) +
                   ")");
}

}  // namespace trocar
