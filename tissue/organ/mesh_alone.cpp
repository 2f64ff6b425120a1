#include "tissue/organ/mesh_alone.h"

namespace trocar {
namespace {

void leave_common_mesh(std::size_t organ, CompiledScene& scene) {
  for (SharedInterface& shared : scene.shared)
    if (shared.first == organ || shared.second == organ) shared.triangles.clear();
  std::erase_if(scene.attachments, [organ](const Attachment& attachment) { return attachment.organ == organ; });
}

}  // namespace

void mesh_alone_what_cuts_itself(const LabelMap& map, const std::vector<SceneRequest>& requests,
                                 const SceneOptions& options, CompiledScene& scene) {
  for (std::size_t n = 0; n < requests.size(); ++n) {
    const std::size_t cuts = scene.organs[n].facts.self_intersections;
    if (cuts == 0) continue;
    const SceneRequest& request = requests[n];
    CompiledOrgan fresh =
        compile_label(map.layers[request.layer], request.number, {request.triangles, options.parts, options.progress});
    if (fresh.facts.self_intersections >= cuts) continue;
    scene.notes.push_back(request.name + " cut itself in " + std::to_string(cuts) +
                          " places of the common mesh and was meshed alone: it lies against its neighbours, but shares "
                          "no triangles with them");
    scene.organs[n] = std::move(fresh);
    leave_common_mesh(n, scene);
  }
}

}  // namespace trocar
