// One mesh of the tissue on the GPU: scenery that stands still, or an organ that follows its surface.
//
// An organ is meshed, and its light baked, from its surface at rest. Afterwards only vertices move: texture, marks and
// targets lie at rest places, which stay an attribute. Fields that are shown, each 0 to 1 at every vertex of the
// surface: "blood", "char", "whitening", "wet". Frame T, m. Thread: the one on which the context is current.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/picture/gl/gl_objects.h"
#include "app/picture/models/curved_subdivision.h"
#include "app/picture/models/picture_mesh.h"
#include "tissue/surface_snapshot.h"
#include "tissue/tissue_frame.h"

namespace trocar {

class TissuePart {
 public:
  explicit TissuePart(PictureMesh scenery);
  /// An organ, undarkened by its neighbours. @param surface not empty.
  TissuePart(const SurfacePtr& surface, std::size_t max_triangles);

  /// Whether an organ's surface is this one, wherever it has moved to.
  bool made_from(const SurfacePtr& surface) const { return rest_.lock() == surface_at_rest(surface); }
  PictureMesh& mesh() { return mesh_; }  ///< at rest; changes are seen after send()
  const PictureMesh& mesh() const { return mesh_; }
  /// The light that it has by itself.
  void undarken();
  /// Takes light from where another organ stands close at rest. @see darken_beside
  void darken_by(const TissuePart& other);
  void send();

  /// Shows the surface as it is now, with its fields.
  void follow(const SurfacePtr& surface);
  /// Whether it has ever left its rest.
  bool moves() const { return moves_; }
  bool bears_fields() const { return !fields_.empty(); }
  const Eigen::AlignedBox3d& box() const { return box_; }  ///< of what is shown
  const Eigen::AlignedBox3d& box_at_rest() const { return rest_box_; }

  /// Bears marks from now on. Those of its triangles, and those with a field, are its marked ones.
  void mark(const std::vector<TissueMark>& marks);
  bool marked() const { return marked_count_ > 0; }
  void draw_marked() const { gpu_.draw_subset(marked_, marked_count_); }
  const GpuMesh& gpu() const { return gpu_; }

  std::string look = {};  ///< #define of assets/shaders/tissue.frag

 private:
  void keep_light();
  void show_fields(const SurfaceSnapshot& surface);
  void gather_marked();

  std::weak_ptr<const SurfaceSnapshot> rest_, shown_;
  std::optional<CurvedSubdivision> subdivision_;
  PictureMesh mesh_;
  std::vector<float> creases_, own_light_;
  std::shared_ptr<const SolidGrid> solid_;
  GpuMesh gpu_;
  Eigen::AlignedBox3d rest_box_, box_;
  bool moves_ = false;
  std::vector<std::array<std::uint8_t, 4>> fields_;
  std::vector<std::uint32_t> under_marks_;
  GlObject marked_;
  int marked_count_ = 0;
};

}  // namespace trocar
