// Draws the instruments: body and, where it has them, two jaws, each posed from its InstrumentView.
//
// Meshes are kept by kind and size of the shaft. Frame T, m. Thread: the one on which the context is current.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "app/picture/gl/gl_objects.h"
#include "app/picture/scene/object_painter.h"
#include "app/picture/scene/scene_view.h"

namespace trocar {

/// All instruments of a view, the first one first.
std::vector<InstrumentView> instruments_of(const SceneView& view);

class InstrumentPainter {
 public:
  /// Into the shadow map, with a bound depth program.
  void draw_shadows(Program& depth, const SceneView& view);
  void draw(const ProgramBinder& bind, const SceneView& view);

 private:
  struct Meshes {
    GpuMesh body, jaw;
  };
  void draw_parts(Program& program, const InstrumentView& instrument);
  std::map<std::array<long, 3>, Meshes> meshes_;
};

}  // namespace trocar
