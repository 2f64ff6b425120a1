// The scene of an organ's portrait: what `trocar organ render` draws.
//
// Frame T, metres, z up (anterior), as the patient lies on the back. Thread: any.
#pragma once

#include "app/picture/scene/scene_view.h"
#include "tissue/organ/organ.h"

namespace trocar {

/// The organ centred at the origin of T, the scope looking obliquely down on all of it, the instrument resting above it
/// for scale, and the organ's credit. @param organ surface in RAS patient axes, m, not empty.
SceneView organ_scene(const Organ& organ);

}  // namespace trocar
