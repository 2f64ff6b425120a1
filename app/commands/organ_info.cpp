#include "app/commands/organ_info.h"

#include <ostream>

#include "app/commands/organ_report.h"
#include "haptics/input_error.h"
#include "tissue/organ.h"
#include "tissue/organ_set.h"

namespace trocar {
namespace {

/// The manifest with what can be proved on the surface proved anew.
CompiledMember proved(const std::filesystem::path& path, std::ostream& err) {
  const Organ organ = load_organ(path);
  CompiledMember member{parse_manifest(read_bytes(path), path.string()), organ.surface};
  member.manifest.mesh.topology = analyse_topology(organ.surface);
  member.manifest.mesh.quality = mesh_quality(organ.surface);
  member.manifest.mesh.self_intersections = count_self_intersections(organ.surface);
  if (member.manifest.mesh.self_intersections > 0) err << "warning: " << organ.name << ": the surface cuts itself\n";
  return member;
}

}  // namespace

int organ_info(const OrganInfoOptions& options, std::ostream& out, std::ostream& err) {
  const std::filesystem::path path = without_subject(options.manifest);
  const std::string file = path.string();
  if (!file.ends_with(kOrganSetSuffix)) {
    const CompiledMember organ = proved(path, err);
    out << (options.json ? organ_json(organ.manifest, organ.surface.bounds()) : organ_text(organ.manifest, organ.surface.bounds()));
    return 0;
  }
  const OrganSet set = parse_organ_set(read_bytes(path), file);
  load_organ(path);  // every member is there and unchanged
  std::vector<CompiledMember> organs;
  for (const std::string& member : set.files) organs.push_back(proved(path.parent_path() / member, err));
  out << (options.json ? scene_report_json(set, organs) : scene_report_text(set, organs));
  return 0;
}

}  // namespace trocar
