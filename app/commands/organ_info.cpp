#include "app/commands/organ_info.h"

#include <ostream>

#include "app/commands/organ_report.h"
#include "tissue/mesh/organ_manifest.h"
#include "tissue/organ.h"

namespace trocar {

int organ_info(const OrganInfoOptions& options, std::ostream& out, std::ostream& err) {
  const Organ organ = load_organ(options.manifest);
  OrganManifest manifest = parse_manifest(read_bytes(options.manifest), options.manifest.string());
  manifest.mesh.topology = analyse_topology(organ.surface);
  manifest.mesh.self_intersections = count_self_intersections(organ.surface);
  if (manifest.mesh.self_intersections > 0) err << "warning: the surface cuts itself\n";
  out << (options.json ? organ_json(manifest, organ.surface.bounds()) : organ_text(manifest, organ.surface.bounds()));
  return 0;
}

}  // namespace trocar
