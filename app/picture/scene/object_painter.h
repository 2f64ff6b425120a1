// Draws scene objects: opaque ones with the scope's light and shadow, ghosts blended over them, furthest first.
//
// Meshes are kept by shape and size, so that a board of blocks costs a few hundred vertices once. Frame T, m.
// Thread: the one on which the context is current.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "app/picture/gl/gl_objects.h"
#include "app/picture/scene/scene_view.h"

namespace trocar {

/// Binds a program variant with the scene's common inputs.
using ProgramBinder =
    std::function<Program&(const std::string& vertex, const std::string& fragment, std::vector<std::string> defines)>;

class ObjectPainter {
 public:
  /// Into the shadow map, with a bound depth program.
  void draw_shadows(Program& depth, const SceneView& view);
  void draw_solids(const ProgramBinder& bind, const SceneView& view);
  void draw_ghosts(const ProgramBinder& bind, const SceneView& view);

 private:
  GpuMesh& mesh_of(const SceneObject& object);
  void draw(Program& program, const SceneObject& object);
  void draw_wire(Program& program, const WireView& wire);
  std::map<std::array<long, 4>, GpuMesh> meshes_;
};

/// The box trainer round a work space without an organ: a draped floor that rises to walls.
class TrainerBackdrop {
 public:
  void draw(const ProgramBinder& bind, const Eigen::AlignedBox3d& stage_T);

 private:
  Eigen::AlignedBox3d built_for_;
  GpuMesh mesh_;
};

}  // namespace trocar
