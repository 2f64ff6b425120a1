// Cuts the contact patch out of the surface: the triangles within kPatchRadius of the axes of shaft, jaws and held
// object, nearest first.
//
// Runs at the tissue rate. Of a surface too fine for the patch the nearest triangles are kept: `dropped` is then above
// 0 and `reach` says how near to the tool nothing is missing. Frame T. Thread: tissue task; allocates nothing once its
// buffer has grown.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "haptics/contact/tool_shape.h"
#include "haptics/exchange/contact_patch.h"
#include "haptics/exchange/solved_contacts.h"
#include "tissue/collision/surface_tree.h"

namespace trocar {

class PatchExtraction {
 public:
  /// @param surface in T; must outlive this object.
  /// @param material of each triangle, as an index into ContactPatch::material; empty: all 0. Must outlive this object.
  explicit PatchExtraction(const TriangleSurface& surface, std::span<const std::int32_t> material = {});

  /// The surface's vertices have moved.
  /// @param velocity of each vertex, m/s; empty: they stand. Must outlive the next extractions.
  void refit(std::span<const Vec3> velocity = {}) {
    tree_.refit();
    velocity_ = velocity;
  }

  /// Fills triangles, vertices, where those were in the last extraction (`previous`), count, dropped and reach; leaves
  /// stamp, topology, glide, material, grip and held object to the caller.
  /// @param patch its held object is part of the tool
  void extract(const Pose& X_TI, const ToolShape& tool, ContactPatch& patch, double jaw_opening_m = 0);

  /// Light tissue that a tool has held aside and lost for a tick goes millimetres in a step, through the tool: what it
  /// may meet there is told it before. Of each material of which `contacts` has none, the triangle nearest to each
  /// capsule becomes a contact without force: it pushes if the tissue comes to it.
  /// @param reach_m gap up to which. @param felt whether a triangle is a contact at all
  void look_ahead(const Pose& X_TI, const ToolCapsules& tool, double reach_m,
                  const std::function<bool(std::int32_t)>& felt, SolvedContacts& contacts);

 private:
  std::int32_t material_of(std::int32_t triangle) const {
    return material_.empty() ? 0 : material_[static_cast<std::size_t>(triangle)];
  }
  /// Place of the surface's vertex in the patch, which gets it when it has it not.
  std::int16_t place_vertex(std::int32_t vertex, ContactPatch& patch);

  SurfaceTree tree_;
  std::span<const std::int32_t> material_;
  std::span<const Vec3> velocity_;
  std::vector<SurfaceTree::Hit> hits_;
  // A sparse set (Briggs and Torczon 1993): nothing is cleared between patches.
  std::vector<std::int16_t> place_;                     ///< of each vertex of the surface, if source_ there names it
  std::array<std::int32_t, kMaxPatchVertices> source_;  ///< vertex of the surface behind each of the patch
  std::array<std::int32_t, kMaxPatchVertices> last_source_;  ///< the same of the extraction before
  std::int32_t count_ = 0, last_count_ = 0;
};

}  // namespace trocar
