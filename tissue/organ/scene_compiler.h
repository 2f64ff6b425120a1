// Several labels of one segmentation as surfaces of one scene: neighbours share their interface, triangle by triangle.
//
// Each voxel corner of the working grid goes to the label whose smoothed field is largest there (argmax;
// tissue.md 6.1). The faces between two labels form one patch that both organs use, in opposite winding; where three
// labels meet, the patches end on one common curve. RAS, metres. Same input, same bytes. Thread: any, not the tick.
#pragma once

#include <string>
#include <vector>

#include "tissue/imaging/labels/label_map.h"
#include "tissue/mesh/surface/mesh_facts.h"
#include "tissue/organ/organ_compiler.h"

namespace trocar {

struct SceneRequest {
  std::size_t layer = 0;
  int number = 0;
  std::string name;      ///< for messages and notes
  int triangles = 3000;  ///< wanted; of organs that touch, the finer one decides on the interface
};

struct SceneOptions {
  PartsRule parts = {};
  Progress progress = {};
};

/// Triangles that two organs have in common: the same three points, wound the other way round.
struct SharedInterface {
  std::size_t first = 0, second = 0;  ///< organs, first < second
  double area_m2 = 0;
  std::vector<std::array<std::int32_t, 2>> triangles;  ///< number in the first, number in the second
};

/// Where an organ lies against a label that was not asked for (no farther than one voxel).
struct Attachment {
  std::size_t organ = 0;
  std::size_t layer = 0;
  int number = 0;      ///< of the label it touches
  double area_m2 = 0;  ///< of the organ's triangles that lie against it
  std::vector<std::int32_t> triangles;
};

struct CompiledScene {
  std::vector<CompiledOrgan> organs;  ///< in the order of the requests
  std::vector<SharedInterface> shared;
  std::vector<Attachment> attachments;
  std::vector<std::string> notes;  ///< what was decided for the scene as a whole
};

/// @throws InputError when a label is absent or too small to mesh, or asked for twice
CompiledScene compile_scene(const LabelMap& map, const std::vector<SceneRequest>& requests,
                            const SceneOptions& options);

/// Surfaces that came as such. Those that have triangles in common (the same corners to the bit, wound the other way
/// round), as segments that were smoothed together do, keep them in common; the others are compiled each for itself.
/// @param surfaces each as compile_surface() wants it
CompiledScene compile_surfaces(const std::vector<TriangleSurface>& surfaces, const CompileOptions& options);

}  // namespace trocar
