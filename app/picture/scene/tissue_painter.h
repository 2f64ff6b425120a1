// Draws all tissue: the organ in the middle, the organs round it, the bed of fat, the lining of the abdomen, and on
// them the marks (blood, char, whitening, wet) and the targets.
//
// Meshes are kept by surface, so that an abdomen is sent to the GPU once; occlusion counts all organs. Marked and
// targeted triangles are drawn once more over the plain ones, so that unmarked tissue costs nothing for them. Frame T,
// m. Thread: the one on which the context is current.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/picture/gl/gl_objects.h"
#include "app/picture/scene/object_painter.h"
#include "app/picture/scene/preset.h"
#include "app/picture/scene/scene_view.h"
#include "app/picture/scene/scope_optics.h"

namespace trocar {

/// The #define of assets/shaders/tissue.frag for a material: "LOOK_LIVER".
std::string tissue_look(const std::string& material);

class TissuePainter {
 public:
  /// Sends what is new to the GPU and forgets what is gone.
  void prepare(const SceneView& view, const PresetTraits& traits);
  bool empty() const { return !organ_; }
  /// Changes whenever the meshes do.
  int version() const { return version_; }
  void draw_shadows();
  void draw(const ProgramBinder& bind, const SceneView& view, const ScopeOptics& optics);

 private:
  /// One mesh with its look, and those of its triangles that bear marks.
  struct Part {
    std::weak_ptr<const SurfaceSnapshot> source;
    std::string look;
    PictureMesh mesh;
    GpuMesh gpu;
    Eigen::AlignedBox3d box;
    std::shared_ptr<const SolidGrid> solid;
    GlObject marked;
    int marked_count = 0;
  };
  struct Decal {
    Vec3 centre_T;
    double radius_m;
    GlObject indices;
    int count;
  };

  bool built_for(const SceneView& view, const PresetTraits& traits) const;
  void build(const SceneView& view, const PresetTraits& traits);
  void bake_all();
  void prepare_marks(const SceneView& view);
  void prepare_decals(const SceneView& view);
  std::vector<Part*> parts();
  void draw_part(Part& part, const ProgramBinder& bind, const SceneView& view, const ScopeOptics& optics);
  void draw_decals(const ProgramBinder& bind, const SceneView& view, const ScopeOptics& optics);

  std::optional<Part> organ_, fat_, wall_;
  std::vector<Part> adjacent_;
  std::vector<Decal> decals_;
  std::vector<TissueMark> marks_;
  GlObject mark_block_;
  std::string built_preset_;
  int version_ = 0;
};

}  // namespace trocar
