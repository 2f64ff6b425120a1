// Draws the organs round the one in the middle, each with the look of its material.
//
// Meshes are kept by surface, so that an abdomen is sent to the GPU once. Frame T, m. Thread: the one on which the context is current.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/graphics/gl_objects.h"
#include "app/graphics/object_painter.h"
#include "app/graphics/scene_view.h"

namespace trocar {

/// The #define of assets/shaders/tissue.frag for a material: "LOOK_LIVER".
std::string tissue_look(const std::string& material);

class TissuePainter {
 public:
  /// Sends what is new to the GPU and forgets what is gone.
  void prepare(const std::vector<NeighbourView>& neighbours);
  void draw_shadows();
  void draw(const ProgramBinder& bind);

 private:
  struct Kept {
    std::weak_ptr<const TriangleSurface> source;
    std::string look;
    GpuMesh mesh;
  };
  std::vector<Kept> kept_;
};

}  // namespace trocar
