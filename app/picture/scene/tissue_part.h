// One mesh of the tissue on the GPU: scenery that stands still, or an organ that follows its surface.
//
// An organ is meshed from its surface at rest. Afterwards only vertices move: texture, marks and targets lie at rest
// places, which stay an attribute. Light is that of now: an organ's own folds and hollows, and what stands close.
// The walls of cuts are a sheet of their own with a sharp lip, drawn in their own look with what is close to the lip.
// Fields that are shown, each 0 to 1 at every vertex of the surface: "blood", "char", "whitening", "wet". Frame T, m.
// Thread: the one on which the context is current.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/picture/gl/gl_objects.h"
#include "app/picture/models/curved_subdivision.h"
#include "app/picture/models/cut_seams.h"
#include "app/picture/models/picture_mesh.h"
#include "tissue/surface_snapshot.h"
#include "tissue/tissue_frame.h"

namespace trocar {

class TissuePart {
 public:
  explicit TissuePart(PictureMesh scenery);
  /// An organ at rest. @param surface not empty, wherever it is now. @param part of it, where it has several
  TissuePart(const SurfacePtr& surface, std::size_t max_triangles, std::uint8_t part = 0);

  /// Whether an organ's surface is this one, wherever it has moved to.
  bool made_from(const SurfacePtr& surface) const { return rest_.lock() == surface_at_rest(surface); }
  /// Goes to where its surface is now, in its own light, and bears its fields. @return whether anything is new.
  bool follow(const SurfacePtr& surface);
  /// Whether it has ever left its rest.
  bool moves() const { return moves_; }
  bool bears_fields() const { return !fields_.empty(); }

  const PictureMesh& mesh() const { return mesh_; }             ///< at rest, in its own light
  std::vector<PictureVertex>& vertices() { return vertices_; }  ///< now; seen after send()
  const Eigen::AlignedBox3d& box() const { return box_; }       ///< now
  const Eigen::AlignedBox3d& box_at_rest() const { return rest_box_; }

  // Light: its own; the steady one, which of what stands still among still neighbours is the light beside them; and
  // that of now, in which it is seen after send().
  void take_own_light() { vertices_ = mesh_.vertices; }
  void keep_as_steady() { steady_ = vertices_; }
  void take_steady_light() { vertices_ = steady_; }
  /// Whether another organ is close enough to take light from it.
  bool beside(const TissuePart& other) const { return other.grid_ && box_.exteriorDistance(other.box_) < 0.02; }
  /// Takes what that one takes. @see darken_beside
  void darken_by(const TissuePart& other) { darken_beside(vertices_, *other.grid_); }
  void send() { gpu_.move(vertices_); }

  /// Bears marks from now on. Those of its triangles, and those with a field, are its marked ones, but
  /// for those that are drawn as a cut.
  void mark(const std::vector<TissueMark>& marks);
  bool marked() const { return marked_count_ > 0; }
  void draw_marked() const { gpu_.draw_subset(marked_, marked_count_); }
  bool bears_marks() const { return bears_fields() || !under_marks_.empty(); }
  bool cut() const { return cut_count_ > 0; }
  void draw_cut() const { gpu_.draw_subset(cut_, cut_count_); }
  const GpuMesh& gpu() const { return gpu_; }

  std::string look = {};       ///< #define of assets/shaders/tissue.frag
  bool beside_moving = false;  ///< its light of now is not the steady one

 private:
  void show_fields(const SurfaceSnapshot& surface);
  void gather_marked();
  void find_cuts(const std::vector<bool>& inside);
  /// Walls are darker the deeper they go; places near a cut know how far its lip is.
  void show_cuts(std::vector<PictureVertex>& vertices) const;

  /// Of values at the surface's vertices, those at its own.
  template <typename Value>
  std::vector<Value> own(const std::vector<Value>& values) const {
    if (own_vertices_.empty()) return values;
    std::vector<Value> out;
    for (const std::int32_t vertex : own_vertices_) out.push_back(values[static_cast<std::size_t>(vertex)]);
    return out;
  }

  std::weak_ptr<const SurfaceSnapshot> rest_, shown_;
  std::vector<std::int32_t> own_vertices_;  ///< of a surface of several parts; empty: all
  CutSeams seams_;
  std::optional<CurvedSubdivision> subdivision_;
  PictureMesh mesh_;
  std::vector<PictureVertex> steady_, vertices_;
  std::optional<SolidGrid> own_grid_, grid_;  // at rest, of the mesh; now, for neighbours
  GpuMesh gpu_;
  Eigen::AlignedBox3d rest_box_, box_;
  bool moves_ = false;
  std::vector<std::array<std::uint8_t, 4>> fields_;
  std::vector<std::uint32_t> under_marks_;
  std::vector<float> cut_places_;   ///< of each vertex of the mesh; empty: nothing is cut
  std::vector<bool> cut_triangle_;  ///< of each triangle of the mesh: drawn as a cut; empty: none is
  GlObject marked_, cut_;
  int marked_count_ = 0, cut_count_ = 0;
};

}  // namespace trocar
