// An organ that cuts itself in the common mesh of a scene is meshed alone: a clean surface goes before a shared one.
//
// RAS, metres. Same input, same bytes. Thread: any, not the tick.
#pragma once

#include <vector>

#include "tissue/organ/scene_compiler.h"

namespace trocar {

/// Replaces each organ that cuts itself, when it is cleaner by itself. It then shares no triangles: those of its
/// interfaces are emptied (their areas stay), its attachments, which name triangles of the common mesh, are dropped,
/// and a note says so.
/// @param requests as compile_scene had them
void mesh_alone_what_cuts_itself(const LabelMap& map, const std::vector<SceneRequest>& requests,
                                 const SceneOptions& options, CompiledScene& scene);

}  // namespace trocar
