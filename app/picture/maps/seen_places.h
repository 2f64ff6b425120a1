// Which place of the scene every pixel of a picture shows: surfaces drawn into a depth buffer by the CPU, with the
// scope's own optics.
//
// Frame T, m; pixels of the image, y down. Triangles with a corner outside the round field are left out. Thread: plain
// value.
#pragma once

#include <cstdint>
#include <vector>

#include "app/picture/scene/scene_view.h"
#include "app/picture/scene/scope_optics.h"

namespace trocar {

class SeenPlaces {
 public:
  enum class What : std::uint8_t { kNothing, kOrgan, kBoard, kOther };

  SeenPlaces(const Camera& camera, int width, int height);
  void add(const TriangleSurface& surface, What what);
  /// Organ, boards and organs beside of a scene.
  void add(const SceneView& view);

  int width() const { return width_; }
  int height() const { return height_; }
  What what(int x, int y) const { return what_[index(x, y)]; }
  const Vec3& place_T(int x, int y) const { return place_[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  struct Corner {
    Vec3 place_T;
    double x = 0, y = 0, away = 0;  ///< px; m along the view
  };
  void draw(const Corner& a, const Corner& b, const Corner& c, What what);

  ScopeOptics optics_;
  int width_, height_;
  std::vector<What> what_;
  std::vector<float> away_;
  std::vector<Vec3> place_;
};

/// The upper face of a board as a surface of small triangles.
TriangleSurface board_face(const SceneObject& board);

}  // namespace trocar
