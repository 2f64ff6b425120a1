// Scenes made by formula that show what the renderer can: an abdomen with liver, gallbladder, ducts, fat and stomach,
// and the fields that tissue may bear. For the start screen, `trocar picture`, the choice of a preset and tests.
// Scenery: nothing of it is felt.
//
// Frame T, m, z up. Same name and seed: same scene. Thread: any.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/picture/scene/scene_view.h"

namespace trocar {

/// Names that show_scene() knows: abdomen, blood, char, whitening, wet, smoke, fog, thirty-degree, board.
const std::vector<std::string>& show_scene_names();

/// @throws std::invalid_argument for an unknown name. Surfaces are built at each call (about half a second).
SceneView show_scene(const std::string& name, std::uint64_t seed = 1);

/// The same organs with other fields: cheap. @param abdomen of show_scene().
SceneView with_fields(const SceneView& abdomen, const std::string& name, std::uint64_t seed = 1);

}  // namespace trocar
