// Draws all tissue: the organ in the middle, the organs round it, the bed of fat, the lining of the abdomen, and on
// them the marks (blood, char, whitening, wet) and the targets.
//
// Meshes are kept by surface at rest, so that an abdomen is sent to the GPU once and an organ that deforms only moves;
// occlusion counts all organs. Marked and targeted triangles are drawn once more over the plain ones, so that unmarked
// tissue costs nothing for them. Frame T, m. Thread: the one on which the context is current.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/picture/gl/gl_objects.h"
#include "app/picture/scene/object_painter.h"
#include "app/picture/scene/preset.h"
#include "app/picture/scene/scene_view.h"
#include "app/picture/scene/scope_optics.h"
#include "app/picture/scene/tissue_part.h"

namespace trocar {

/// The #define of assets/shaders/tissue.frag for a material: "LOOK_LIVER".
std::string tissue_look(const std::string& material);

class TissuePainter {
 public:
  /// Sends what is new to the GPU and forgets what is gone.
  void prepare(const SceneView& view, const PresetTraits& traits);
  bool empty() const { return !organ_; }
  /// Changes whenever what draw_still_shadows() draws does.
  int version() const { return version_; }
  /// Into the shadow map: what stands still, and the organs that move.
  void draw_still_shadows();
  void draw_moving_shadows();
  void draw(const ProgramBinder& bind, const SceneView& view, const ScopeOptics& optics);

 private:
  struct Decal {
    Vec3 centre_T;
    double radius_m;
    GlObject indices;
    int count;
  };

  bool built_for(const SceneView& view, const PresetTraits& traits) const;
  void build(const SceneView& view, const PresetTraits& traits);
  /// Takes every organ to where it is now. @param built anew.
  void follow(const SceneView& view, bool built);
  void light_still();
  void light_moving();
  void prepare_marks(const SceneView& view);
  void prepare_decals(const SceneView& view);
  std::vector<TissuePart*> parts();
  void draw_part(TissuePart& part, const ProgramBinder& bind, const SceneView& view, const ScopeOptics& optics);
  void draw_decals(const ProgramBinder& bind, const SceneView& view, const ScopeOptics& optics);

  std::optional<TissuePart> organ_, second_, fat_, wall_;  ///< second_: the part that is bound to the organ
  std::vector<TissuePart> adjacent_;
  std::vector<Decal> decals_;
  std::vector<TissueMark> marks_;
  GlObject mark_block_;
  Eigen::AlignedBox3d bounds_;  ///< of all organs at rest: wall and fat are made for it
  std::string built_preset_;
  int version_ = 0;
};

}  // namespace trocar
